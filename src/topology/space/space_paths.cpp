#include "topology/space/space_paths.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "topology/paths/euclidean_shortcutting.h"
#include "topology/paths/taut_path.h"
#include "trajectory/polyline.h"

namespace mocha {
namespace {

constexpr int kSpare = 2;           // paths that are shortened, for each one that is kept
constexpr double kShortened = 0.8;  // what is left of a path when it is shortened, at least

/// The landmarks' nodes and edges, too; start and goal are joined to those that they see.
void add_landmarks(const Roadmap<3>& landmarks, const SampledSpace<3>& space, double reach_m,
                   Roadmap<3>& roadmap) {
  constexpr int kEnds = Roadmap<3>::kGoal + 1;
  const int shift = static_cast<int>(roadmap.nodes.size()) - kEnds;
  for (auto edge : landmarks.edges) {
    edge.from += shift;
    edge.to += shift;
    roadmap.edges.push_back(std::move(edge));
  }
  for (std::size_t i = kEnds; i < landmarks.nodes.size(); ++i) {
    const Eigen::Vector3d& place = landmarks.nodes[i].position;
    for (const int end : {Roadmap<3>::kStart, Roadmap<3>::kGoal}) {
      const double length_m = (place - roadmap.nodes[end].position).norm();
      if (length_m > reach_m) continue;
      const auto clearance_m = space.clearance_m(roadmap.nodes[end].position, place);
      if (!clearance_m) continue;
      roadmap.edges.push_back({end, static_cast<int>(i) + shift, {}, length_m, *clearance_m});
    }
    roadmap.nodes.push_back(landmarks.nodes[i]);
  }
}

/// Of each class the shortest, shortest first.
std::vector<SpacePath> shortest_of_each(std::vector<SpacePath> paths,
                                        const SpacePathOptions& options) {
  std::stable_sort(paths.begin(), paths.end(),
                   [](const SpacePath& a, const SpacePath& b) { return a.length_m < b.length_m; });
  std::vector<SpacePath> kept;
  for (SpacePath& path : paths) {
    if (has_class(kept, path.signature) ||
        path.length_m > options.longest_ratio * paths.front().length_m)
      continue;
    kept.push_back(std::move(path));
    if (static_cast<int>(kept.size()) == options.classes) break;
  }
  return kept;
}

}  // namespace

std::vector<SpacePath> find_space_paths(const VoxelDistanceField& field, const SpaceRegion& region,
                                        const Eigen::Vector3d& start, const Eigen::Vector3d& goal,
                                        const SpacePathOptions& options,
                                        const std::function<bool()>& should_stop) {
  const StaticSpace<3> space(field, region.cuts(), field.bounds(), start, options.clearance);
  Roadmap<3> roadmap = visibility_prm<3>(space, start, goal, options.roadmap);
  add_landmarks(region.landmarks(), space, options.roadmap.reach_m, roadmap);
  ClassSearchOptions search{kSpare * options.classes, options.longest_ratio / kShortened};
  search.should_stop = should_stop;
  const std::vector<ClassPath<3>> found = shortest_classes(roadmap, space, search);
  std::vector<SpacePath> paths(found.size());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    paths[i].points = found[i].points;
    if (!should_stop())
      paths[i].points = pulled_taut(with_shortcuts<3>(std::move(paths[i].points), space), space);
    paths[i].length_m = length_of<3>(paths[i].points);
    paths[i].signature = signature_of<3>(region.cuts(), paths[i].points);
  });
  return shortest_of_each(std::move(paths), options);
}

}  // namespace mocha
