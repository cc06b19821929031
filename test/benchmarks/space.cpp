// Planning in space: a forest, a wall with two windows, a ring, and a building of two storeys. With
// a folder as argument, their maps are written there as OctoMap files, too. Prints JSON.

#include <octomap/octomap.h>
#ifdef MOCHA_WITH_DYNAMIC_EDT
#include <dynamicEDT3D/dynamicEDT3D.h>
#endif

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/median.h"
#include "planning/space/space_planner.h"
#include "world/distances/distance_transform.h"
#include "world/space_worlds.h"

namespace mocha {
namespace {

constexpr int kRuns = 11;

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void write_map(const VoxelGrid& grid, const std::string& path) {
  octomap::OcTree tree(grid.resolution_m);
  for (int z = 0; z < grid.size.z(); ++z) {
    for (int y = 0; y < grid.size.y(); ++y) {
      for (int x = 0; x < grid.size.x(); ++x) {
        const Eigen::Vector3d centre = grid.cell_centre(x, y, z);
        tree.updateNode(
            octomap::point3d(static_cast<float>(centre.x()), static_cast<float>(centre.y()),
                             static_cast<float>(centre.z())),
            grid.at(x, y, z) == VoxelGrid::kOccupied, true);
      }
    }
  }
  tree.updateInnerOccupancy();
  if (!tree.writeBinary(path)) std::fprintf(stderr, "%s cannot be written\n", path.c_str());
}

#ifdef MOCHA_WITH_DYNAMIC_EDT
/// The distances of dynamicEDT3D at the same corners of cells, from the same sites: those that
/// belong to a solid cell or to the rim, where ours are
/// not positive.
void measure_peer(const VoxelDistanceField& field) {
  const Eigen::Vector3i corners = field.size().array() + 1;
  constexpr double kRounding_m = 1e-5;
  const double cell_m = field.resolution_m();
  const auto ours_m = [&](int x, int y, int z) {
    return field.sample(field.bounds().min() + cell_m * Eigen::Vector3d(x, y, z)).distance_m;
  };
  std::vector<float> squared(static_cast<std::size_t>(corners.prod()), kNoSite);
  DynamicEDT3D peer(1 << 30);
  // It leaves the outermost cells out.
  peer.initializeEmpty(corners.x() + 2, corners.y() + 2, corners.z() + 2, true);
  std::size_t i = 0;
  for (int z = 0; z < corners.z(); ++z) {
    for (int y = 0; y < corners.y(); ++y) {
      for (int x = 0; x < corners.x(); ++x, ++i) {
        if (ours_m(x, y, z) > kRounding_m) continue;
        peer.occupyCell(x + 1, y + 1, z + 1);
        squared[i] = 0.0f;
      }
    }
  }
  double begin_s = now_s();
  peer.update(true);
  const double peer_s = now_s() - begin_s;
  begin_s = now_s();
  distance_transform_in_space(squared, corners.x(), corners.y(), corners.z());
  const double own_s = now_s() - begin_s;
  std::size_t overstated = 0;
  double most_cells = 0.0;
  for (int z = 0; z < corners.z(); ++z) {
    for (int y = 0; y < corners.y(); ++y) {
      for (int x = 0; x < corners.x(); ++x) {
        const double ours = ours_m(x, y, z) / cell_m;
        if (ours_m(x, y, z) <= kRounding_m) continue;
        const double more_cells = peer.getDistance(x + 1, y + 1, z + 1) - ours;
        overstated += more_cells > 1e-3;
        most_cells = std::max(most_cells, more_cells);
      }
    }
  }
  constexpr int kPeerBytes = 4 + 3 * 4 + 4 + 4;  // of a cell, as dynamicEDT3D.h has it, about
  std::printf(
      "\"field_one_side_s\": %.4g, \"peer_s\": %.4g, \"field_bytes\": %zu, \"peer_bytes\": %zu, "
      "\"peer_overstates\": %zu, \"peer_most_cells\": %.4g, ",
      own_s, peer_s, 4 * squared.size(), kPeerBytes * squared.size(), overstated, most_cells);
}
#else
void measure_peer(const VoxelDistanceField&) {}
#endif

void measure(const char* name, const SpaceWorld& world, bool is_first) {
  const double begin_s = now_s();
  const auto field = std::make_shared<VoxelDistanceField>(
      world.grid, VoxelDistanceField::Solid::kOccupiedOrUnknown);
  const double field_s = now_s() - begin_s;
  SpacePlanner planner(
      field, SpacePlannerOptions::from(ParameterTable::from_schema("config/space_planner.yaml")),
      now_s);
  const auto region = planner.region_of(world.start);
  const double map_s = now_s() - begin_s;
  std::vector<double> plan_s;
  SpacePlan plan;
  for (int run = 0; run < kRuns; ++run) {
    const double plan_begin_s = now_s();
    plan = planner.plan({world.start, world.goal});
    plan_s.push_back(now_s() - plan_begin_s);
  }
  const ObstacleCurves& found = region->curves();
  std::printf("%s\n  {\"world\": \"%s\", ", is_first ? "" : ",", name);
  measure_peer(*field);
  std::printf(
      "\"voxels\": %zu, \"field_s\": %.4g, \"map_s\": %.4g, "
      "\"curves\": %zu, \"bodies\": %d, \"surface_voxels\": %d, \"landmarks\": %zu, "
      "\"plan_s\": %.4g, \"candidates\": [",
      world.grid.cells.size(), field_s, map_s, found.curves.size(), found.bodies,
      found.surface_voxels, region->landmarks().nodes.size(), median(plan_s));
  for (const SpaceCandidate& candidate : plan.candidates) {
    std::printf("%s{\"certified\": %s, \"cost\": %.5g, \"duration_s\": %.5g, \"evaluations\": %d}",
                &candidate == &plan.candidates.front() ? "" : ", ",
                candidate.reason == PlanReason::kSolved ? "true" : "false", candidate.cost,
                candidate.curve.pieces() > 0 ? candidate.curve.duration() : 0.0,
                candidate.evaluations);
  }
  std::printf("]}");
}

void run(const std::string& folder) {
  std::printf("{\"rows\": [");
  bool is_first = true;
  for (const auto& [name, world] : space_worlds()) {
    measure(name.c_str(), world, is_first);
    is_first = false;
    if (!folder.empty()) write_map(world.grid, folder + "/" + name + ".bt");
  }
  std::printf("]}\n");
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { mocha::run(argc > 1 ? argv[1] : ""); }
