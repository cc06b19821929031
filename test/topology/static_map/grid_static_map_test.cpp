#include "topology/static_map/grid_static_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "topology/grid_world.h"
#include "topology/shipped_options.h"

namespace mocha {
namespace {

using Outcome = GridPath::Outcome;

std::vector<ObstacleGroup> groups_of(const OccupancyGrid& grid, double clearance_m = 0.3) {
  return GridStaticMap(occupied_field(grid)).groups(clearance_m);
}

/// Two boxes with a gap of so many cells.
OccupancyGrid gate(int cells, double resolution_m = 0.05) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {6.0, 4.0}, resolution_m);
  const double low = 1.0 + 1e-3;
  fill_box(grid, {2.0, 0.5}, {2.5, low});
  fill_box(grid, {2.0, low - 0.01 + cells * resolution_m}, {2.5, 3.5});
  return grid;
}

double winding_number(const std::vector<Vector2>& loop, const Vector2& about) {
  double sum = 0.0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vector2 a = loop[i] - about;
    const Vector2 b = loop[(i + 1) % loop.size()] - about;
    sum += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  }
  return sum / (2.0 * M_PI);
}

/// The groups whose circles are within half a millimetre of a corner of the map that is solid.
std::vector<int> groups_at(const std::vector<ObstacleGroup>& groups, const Vector2& corner) {
  std::vector<int> owners;
  for (std::size_t r = 0; r < groups.size(); ++r) {
    const auto& cover = groups[r].cover;
    if (std::any_of(cover.begin(), cover.end(),
                    [&](const Circle& circle) { return gap(corner, circle).distance_m < 5e-4; }))
      owners.push_back(static_cast<int>(r));
  }
  return owners;
}

TEST(GridStaticMap, ShowsItsField) {
  const auto field = occupied_field(free_grid({-1.0, -2.0}, {5.0, 4.0}));
  const GridStaticMap static_map(field);
  EXPECT_EQ(&static_map.field(), field.get());
  EXPECT_TRUE(static_map.bounds().min().isApprox(Vector2(-1.0, -2.0)));
  EXPECT_TRUE(static_map.bounds().max().isApprox(Vector2(5.0, 4.0)));
  EXPECT_DOUBLE_EQ(static_map.detail_m(), 0.025);
  EXPECT_TRUE(static_map.groups(0.3).empty());
}

TEST(GridStaticMap, JoinsWhatTheRobotCannotPassBetween) {
  for (const double resolution_m : {0.025, 0.05, 0.1}) {
    for (int cells = 1; cells * resolution_m < 1.0; ++cells) {
      const double gap_m = cells * resolution_m;
      const std::size_t groups = groups_of(gate(cells, resolution_m)).size();
      if (gap_m <= 0.6 - resolution_m) {
        EXPECT_EQ(groups, 1u) << gap_m;
      }
      if (gap_m >= 0.6 - 1e-9) {
        EXPECT_EQ(groups, 2u) << gap_m;
      }
    }
  }
}

TEST(GridStaticMap, PartsPostsThatTheRobotPassesBetweenOnCoarseMaps) {
  // Their corners are neighbours across a cell, 0.7 m apart.
  OccupancyGrid grid = free_grid({0.0, 0.0}, {6.0, 4.0}, 0.5);
  grid.at(4, 2) = OccupancyGrid::kOccupied;
  grid.at(6, 4) = OccupancyGrid::kOccupied;
  EXPECT_EQ(groups_of(grid, 0.3).size(), 2u);
  EXPECT_EQ(groups_of(grid, 0.4).size(), 1u);
}

TEST(GridStaticMap, RepresentsACurvedWallByTheWallItself) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 8.0});
  for (double angle = 0.7; angle < 2.0 * M_PI - 0.7; angle += 0.01) {
    const Vector2 on_wall = Vector2(4.0, 4.0) + 2.5 * Vector2(std::cos(angle), std::sin(angle));
    fill_disc(grid, on_wall, 0.08, OccupancyGrid::kOccupied);
  }
  const auto groups = groups_of(grid);
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_NEAR((groups[0].representative - Vector2(4.0, 4.0)).norm(), 2.5, 0.15);
  EXPECT_LE(occupied_field(grid)->sample(groups[0].representative).distance_m, 0.0);
}

TEST(GridStaticMap, SeesTheDoorOfARoom) {
  for (const double door_m : {0.4, 0.9}) {
    OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 8.0});
    fill_box(grid, {2.0, 2.0}, {6.0, 6.0});
    fill_box(grid, {2.1, 2.1}, {5.9, 5.9}, OccupancyGrid::kFree);
    fill_box(grid, {3.5, 1.9}, {3.5 + door_m, 2.2}, OccupancyGrid::kFree);
    fill_box(grid, {4.0, 4.5}, {4.2, 4.7});
    EXPECT_EQ(groups_of(grid).size(), 2u) << "the room and what stands in it";
    fill_box(grid, {3.5, 5.8}, {3.5 + door_m, 6.1}, OccupancyGrid::kFree);
    EXPECT_EQ(groups_of(grid).size(), door_m < 0.6 ? 2u : 3u) << "two halves behind two doors";
  }
}

TEST(GridStaticMap, EveryRepresentativeIsSolidAndEveryGroupIsCovered) {
  for (int seed = 1; seed <= 20; ++seed) {
    const OccupancyGrid grid = random_world(seed, 30, {0.5, 0.5}, {7.5, 5.5}, 0.3);
    const auto field = occupied_field(grid);
    for (const ObstacleGroup& group : GridStaticMap(field).groups(0.3)) {
      EXPECT_LT(field->sample(group.representative).distance_m, 1e-9);
      EXPECT_FALSE(group.cover.empty());
    }
  }
}

// What homotopy_paths.cpp assumes.
constexpr double kMostCircleError_m = 0.12;

TEST(GridStaticMap, CoversTheRimAndLittleElse) {
  for (const double resolution_m : {0.01, 0.0167, 0.025, 0.05, 0.1, 0.2}) {
    OccupancyGrid grid = free_grid({0.0, 0.0}, {4.0, 3.0}, resolution_m);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 12; ++i) {
      const Vector2 centre(4.0 * share(random), 3.0 * share(random));
      fill_disc(grid, centre, 0.05 + 0.4 * share(random), OccupancyGrid::kOccupied);
    }
    const auto field = occupied_field(grid);
    const auto groups = GridStaticMap(field).groups(0.3);
    ASSERT_FALSE(groups.empty());
    for (int y = 0; y < field->rows(); ++y) {
      for (int x = 0; x < field->columns(); ++x) {
        if (field->at_corner(x, y) != 0.0) continue;
        EXPECT_EQ(groups_at(groups, field->corner(x, y)).size(), 1u) << x << " " << y;
      }
    }
    for (const ObstacleGroup& group : groups) {
      for (const Circle& circle : group.cover) {
        for (double angle = 0.0; angle < 2.0 * M_PI; angle += 0.1) {
          const Vector2 rim =
              circle.centre + circle.radius_m * Vector2(std::cos(angle), std::sin(angle));
          EXPECT_LT(field->sample(rim).distance_m, kMostCircleError_m) << resolution_m;
        }
      }
    }
  }
}

/// Whether the same circles cover both corners.
bool same_group(const std::vector<ObstacleGroup>& groups, const Vector2& a, const Vector2& b) {
  const auto owners = groups_at(groups, a);
  return !owners.empty() && owners == groups_at(groups, b);
}

/// A loop of a possible path winds about all parts of a group alike.
void expect_not_parted(const OccupancyGrid& grid, const std::vector<Vector2>& loop,
                       const std::vector<ObstacleGroup>& groups, int seed) {
  for (std::size_t r = 0; r < groups.size(); ++r) {
    const double turns = winding_number(loop, groups[r].representative);
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        if (grid.at(x, y) != OccupancyGrid::kOccupied) continue;
        const Vector2 corner = grid.cell_centre(x, y) - Vector2::Constant(0.5 * grid.resolution_m);
        if (!same_group(groups, corner, groups[r].representative)) continue;
        EXPECT_NEAR(winding_number(loop, corner), turns, 1e-6) << seed;
      }
    }
  }
}

TEST(GridStaticMap, NoPathPassesBetweenTwoPartsOfAGroup) {
  TravelOptions options = shipped_travel_options();
  options.preferred_clearance_m = options.required_clearance_m;  // the narrowest gaps are worth it
  int loops = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    for (const double resolution_m : {0.05, 0.2, 0.5}) {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> share(0.0, 1.0);
      OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0}, resolution_m);
      for (int i = 0; i < 60; ++i) {
        const Vector2 centre(1.0 + 6.0 * share(random), 1.0 + 4.0 * share(random));
        fill_box(grid, centre - Vector2::Constant(0.5 * resolution_m),
                 centre + Vector2::Constant(0.5 * resolution_m));
      }
      const auto field = occupied_field(grid);
      const auto groups = GridStaticMap(field).groups(options.required_clearance_m);
      // Out and back along two paths, one of which is kept from the other's middle.
      const Vector2 start(0.4, 0.4 + 5.2 * share(random));
      const Vector2 goal(7.6, 0.4 + 5.2 * share(random));
      const FoundGridPath there = find_path_on_grid(field, start, goal, {}, options);
      if (there.outcome != Outcome::kFound || there.points.size() < 3) continue;
      const Vector2 middle = there.points[there.points.size() / 2];
      const FoundGridPath other = find_path_on_grid(field, start, goal, {{middle, 0.2}}, options);
      if (other.outcome != Outcome::kFound) continue;
      ++loops;
      std::vector<Vector2> loop = there.points;
      loop.insert(loop.end(), other.points.rbegin(), other.points.rend());
      expect_not_parted(grid, loop, groups, seed);
    }
  }
  EXPECT_GT(loops, 40);
}

TEST(GridStaticMap, KeepsUpWithLargeMaps) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {20.0, 20.0});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> share(0.0, 20.0);
  for (int i = 0; i < 400; ++i) {
    const Vector2 centre(share(random), share(random));
    fill_disc(grid, centre, 0.1 + 0.01 * share(random), OccupancyGrid::kOccupied);
  }
  ASSERT_EQ(grid.width, 400);
  const auto groups = groups_of(grid);
  std::size_t circles = 0;
  for (const ObstacleGroup& group : groups) circles += group.cover.size();
  EXPECT_GT(groups.size(), 10u);
  // Far fewer than the corners of solid cells, so that a roadmap on them is quick.
  EXPECT_LT(circles, 9000u);
}

TEST(GridStaticMap, SeesOnlyTheWindow) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {10.0, 10.0});
  // A fork whose prongs meet outside of the window, and something else.
  fill_box(grid, {2.0, 2.0}, {2.3, 8.0});
  fill_box(grid, {5.0, 2.0}, {5.3, 8.0});
  fill_box(grid, {2.0, 2.0}, {5.3, 2.3});
  fill_disc(grid, {9.0, 9.0}, 0.4, OccupancyGrid::kOccupied);
  const GridStaticMap static_map(occupied_field(grid));
  EXPECT_EQ(static_map.groups(0.3).size(), 2u);
  const Eigen::AlignedBox2d window(Vector2(1.0, 4.0), Vector2(7.0, 9.0));
  const auto groups = static_map.groups_within(window, 0.3);
  ASSERT_EQ(groups.size(), 2u);
  for (const ObstacleGroup& group : groups) {
    EXPECT_TRUE(window.contains(group.representative));
    EXPECT_LE(static_map.field().sample(group.representative).distance_m, 0.0);
    for (const Circle& circle : group.cover) EXPECT_LT(window.exteriorDistance(circle.centre), 0.2);
  }
  EXPECT_GT(std::abs(groups[0].representative.x() - groups[1].representative.x()), 2.5);
  const Vector2 far(1e300, 1e300);
  EXPECT_EQ(static_map.groups_within({-far, far}, 0.3).size(), 2u);
  EXPECT_TRUE(static_map.groups_within({far, far}, 0.3).empty());
  EXPECT_TRUE(static_map.groups_within({Vector2(5.6, 0.0), Vector2(8.0, 8.0)}, 0.3).empty());
}

}  // namespace
}  // namespace mocha
