#include "topology/paths/grid_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "topology/grid_world.h"
#include "topology/shipped_options.h"

namespace mocha {
namespace {

using Outcome = GridPath::Outcome;

constexpr double kFar_m = 100.0;

double length_m(const FoundGridPath& path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.points.size(); ++i)
    length += (path.points[i] - path.points[i - 1]).norm();
  return length;
}

/// The smallest proved distance to obstacles along the path, sampled every millimetre.
double clearance_m(const FoundGridPath& path, const DistanceField& field) {
  double least = field.distance_bound(path.points.front());
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Vector2 step = path.points[i] - path.points[i - 1];
    const int samples = 1 + static_cast<int>(step.norm() / 1e-3);
    for (int k = 0; k <= samples; ++k) {
      least = std::min(least, field.distance_bound(path.points[i - 1] + step * k / samples));
    }
  }
  return least;
}

void expect_ends(const FoundGridPath& path, const Vector2& start, const Vector2& goal) {
  ASSERT_EQ(path.outcome, Outcome::kFound);
  ASSERT_GE(path.points.size(), 2u);
  EXPECT_EQ(path.points.front(), start);
  EXPECT_EQ(path.points.back(), goal);
}

FoundGridPath search(const OccupancyGrid& grid, const Vector2& start, const Vector2& goal,
                     const std::vector<BlockedDisc>& blocked = {},
                     const TravelOptions& options = shipped_travel_options()) {
  return find_path_on_grid(occupied_field(grid), start, goal, blocked, options);
}

TEST(GridPath, IsStraightOnAnEmptyMap) {
  const OccupancyGrid grid = free_grid({-1.0, -1.0}, {9.0, 7.0});
  const Vector2 start(0.013, 0.171);
  const Vector2 goal(7.91, 5.33);
  const FoundGridPath path = search(grid, start, goal);
  expect_ends(path, start, goal);
  EXPECT_EQ(path.points.size(), 2u);
  EXPECT_NEAR(path.cost, (goal - start).norm(), 1e-9);
}

TEST(GridPath, RoundsAWallByTheShortestPath) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {4.05, 4.0});  // open above
  TravelOptions options = shipped_travel_options();
  options.preferred_clearance_m = options.required_clearance_m;  // length alone counts
  const Vector2 start(2.0, 2.0);
  const Vector2 goal(6.0, 2.0);
  const FoundGridPath path = search(grid, start, goal, {}, options);
  expect_ends(path, start, goal);
  // Tangents to the two corners' circles of the required clearance, the arcs between them and the 5
  // cm along the top.
  const double r = options.required_clearance_m;
  const double reach = std::hypot(2.0, 2.0);
  const double tangent = std::sqrt(reach * reach - r * r);
  const double arc = r * (0.75 * M_PI - std::acos(r / reach));
  const double shortest = 2.0 * (tangent + arc) + 0.05;
  EXPECT_GT(length_m(path), shortest - 0.01);
  EXPECT_LT(length_m(path), 1.01 * shortest);
  EXPECT_GE(clearance_m(path, *occupied_field(grid)), r - 0.01);
}

TEST(GridPath, PrefersRoomWhereThereIsAny) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {3.5, 2.6}, {4.5, 3.4});
  const Vector2 start(1.0, 3.0);
  const Vector2 goal(7.0, 3.0);
  TravelOptions tight = shipped_travel_options();
  tight.preferred_clearance_m = tight.required_clearance_m;
  TravelOptions wide = shipped_travel_options();
  wide.preferred_clearance_m = 1.0;
  const auto field = occupied_field(grid);
  const double near = clearance_m(search(grid, start, goal, {}, tight), *field);
  EXPECT_GT(clearance_m(search(grid, start, goal, {}, wide), *field), near + 0.1);
}

TEST(GridPath, EveryPointKeepsTheClearanceInRandomWorlds) {
  const Vector2 start(0.5, 0.5);
  const Vector2 goal(7.5, 5.5);
  const TravelOptions options = shipped_travel_options();
  int found = 0;
  for (int seed = 1; seed <= 60; ++seed) {
    const OccupancyGrid grid = random_world(seed, 28, start, goal, 0.4);
    const auto field = occupied_field(grid);
    const FoundGridPath path = find_path_on_grid(field, start, goal, {}, options);
    if (path.outcome != Outcome::kFound) continue;
    ++found;
    expect_ends(path, start, goal);
    EXPECT_GE(path.cost, length_m(path) - 1e-9);
    // Lines are sampled once a cell; between two samples the clearance may dip by what a corner
    // gives.
    EXPECT_GE(clearance_m(path, *field), options.required_clearance_m - 0.003) << "seed " << seed;
  }
  EXPECT_GT(found, 30);
}

TEST(GridPath, KeepsTheClearanceFromAndToPlacesThatBarelyHaveIt) {
  const TravelOptions options = shipped_travel_options();
  int found = 0;
  for (int seed = 1; seed <= 400; ++seed) {
    const OccupancyGrid grid = random_world(seed % 40, 28, {0.5, 0.5}, {7.5, 5.5}, 0.4);
    const auto field = occupied_field(grid);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0.0, 8.0);
    std::uniform_real_distribution<double> y(0.0, 6.0);
    const auto barely_free = [&] {
      for (;;) {
        const Vector2 p(x(random), y(random));
        const double distance_m = field->distance_bound(p);
        if (distance_m > options.required_clearance_m &&
            distance_m < options.required_clearance_m + 0.02)
          return p;
      }
    };
    const Vector2 start = barely_free();
    const Vector2 goal = barely_free();
    const FoundGridPath path = find_path_on_grid(field, start, goal, {}, options);
    ASSERT_NE(path.outcome, Outcome::kStartBlocked) << seed;
    ASSERT_NE(path.outcome, Outcome::kGoalBlocked) << seed;
    if (path.outcome != Outcome::kFound) continue;
    ++found;
    EXPECT_TRUE(std::isfinite(path.cost)) << seed;
    EXPECT_GE(clearance_m(path, *field), options.required_clearance_m - 0.003) << "seed " << seed;
  }
  EXPECT_GT(found, 350);  // most of the rest is walled in
}

TEST(GridPath, DoesNotSlipThroughAGapBetweenTwoNodes) {
  // A diagonal wall with a diagonal gap, whose narrowest place is the middle of a cell or a corner.
  for (int shift = 0; shift < 4; ++shift) {
    OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        const bool on_wall = std::abs(x + y - 140) <= 1;
        const bool in_gap = std::abs(x - y - 20) <= 7 + shift;
        if (on_wall && !in_gap) grid.at(x, y) = OccupancyGrid::kOccupied;
      }
    }
    const auto field = occupied_field(grid);
    for (double required_m = 0.2; required_m < 0.45; required_m += 0.0037) {
      TravelOptions options = shipped_travel_options();
      options.required_clearance_m = required_m;
      const FoundGridPath path = find_path_on_grid(field, {2.0, 1.5}, {6.0, 5.0}, {}, options);
      if (path.outcome != Outcome::kFound) continue;
      EXPECT_GE(clearance_m(path, *field), required_m - 0.004) << required_m;
    }
  }
}

TEST(GridPath, CornersAreNotCutThroughForbiddenSpace) {
  // A lattice of single cells: nodes between them are fine, straight lines often are not.
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  for (double x = 1.0; x < 7.1; x += 1.0) {
    for (double y = 0.5; y < 6.0; y += 1.0) fill_box(grid, {x, y}, {x + 0.05, y + 0.05});
  }
  const auto field = occupied_field(grid);
  const TravelOptions options = shipped_travel_options();
  for (double y = 0.35; y < 5.6; y += 0.35) {
    const FoundGridPath path = find_path_on_grid(field, {0.5, y}, {7.6, 6.0 - y}, {}, options);
    ASSERT_EQ(path.outcome, Outcome::kFound) << y;
    EXPECT_GE(clearance_m(path, *field), options.required_clearance_m - 0.003) << y;
  }
}

TEST(GridPath, FindsANarrowGapThatIsJustWideEnough) {
  for (int gap_cells = 10; gap_cells <= 18; ++gap_cells) {
    OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
    fill_box(grid, {4.0, 0.0}, {4.2, 6.0});
    const double gap_m = 0.05 * gap_cells;
    fill_box(grid, {4.0, 2.0}, {4.2, 2.0 + gap_m}, OccupancyGrid::kFree);
    const FoundGridPath path = search(grid, {2.0, 3.0}, {6.0, 3.0});
    // The middle of an even number of cells is a node of the lattice; of an odd number half a cell
    // off.
    const double slack_m = gap_m - 2.0 * shipped_travel_options().required_clearance_m;
    if (slack_m < -1e-6) {
      EXPECT_EQ(path.outcome, Outcome::kNoPath) << gap_m;
    } else if (slack_m >= 0.05) {
      EXPECT_EQ(path.outcome, Outcome::kFound) << gap_m;
    }
  }
}

TEST(GridPath, SaysThatTheStartOrTheGoalIsBlocked) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_disc(grid, {6.0, 3.0}, 0.5, OccupancyGrid::kOccupied);
  EXPECT_EQ(search(grid, {1.0, 3.0}, {6.0, 3.0}).outcome, Outcome::kGoalBlocked);
  EXPECT_EQ(search(grid, {1.0, 3.0}, {6.0, 3.7}).outcome, Outcome::kGoalBlocked);  // too close
  EXPECT_EQ(search(grid, {6.0, 3.0}, {1.0, 3.0}).outcome, Outcome::kStartBlocked);
  EXPECT_TRUE(search(grid, {6.0, 3.0}, {1.0, 3.0}).points.empty());
}

TEST(GridPath, OutsideTheFieldIsBlocked) {
  const OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const Vector2& outside : {Vector2(-0.1, 3.0), Vector2(8.1, 3.0), Vector2(4.0, 6.1),
                                 Vector2(1e300, 3.0), Vector2(kNan, 3.0), Vector2(4.0, -kNan)}) {
    EXPECT_EQ(search(grid, outside, {1.0, 3.0}).outcome, Outcome::kStartBlocked);
    EXPECT_EQ(search(grid, {1.0, 3.0}, outside).outcome, Outcome::kGoalBlocked);
  }
  EXPECT_EQ(search(grid, {0.0, 0.0}, {8.0, 6.0}).outcome,
            Outcome::kFound);  // the rim itself is inside
}

TEST(GridPath, SaysThatThereIsNoWay) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {4.2, 6.0});
  const FoundGridPath path = search(grid, {2.0, 3.0}, {6.0, 3.0});
  EXPECT_EQ(path.outcome, Outcome::kNoPath);
  EXPECT_TRUE(path.points.empty());
}

TEST(GridPath, StartAndGoalMayBeTheSameOrNearlyTheSame) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {4.2, 6.0});
  // In the open and beside the wall, where clearance is short and the straight line is not taken at
  // once.
  for (const Vector2& start : {Vector2(2.0, 3.0), Vector2(3.6, 3.0), Vector2(3.62, 3.01)}) {
    for (const Vector2& shift :
         {Vector2(0.0, 0.0), Vector2(0.004, 0.002), Vector2(0.02, 0.0), Vector2(0.0, 0.06)}) {
      const FoundGridPath path = search(grid, start, start + shift);
      expect_ends(path, start, start + shift);
      EXPECT_LT(path.cost, 0.3);
    }
  }
}

TEST(GridPath, GoesRoundBlockedDiscs) {
  const OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  const std::vector<BlockedDisc> blocked = {{{4.0, 3.0}, 1.0}, {{4.0, 1.2}, 1.0}};
  const FoundGridPath path = search(grid, {1.0, 3.0}, {7.0, 3.0}, blocked);
  expect_ends(path, {1.0, 3.0}, {7.0, 3.0});
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Vector2 step = path.points[i] - path.points[i - 1];
    for (double share = 0.0; share <= 1.0; share += 0.001) {
      for (const BlockedDisc& disc : blocked) {
        EXPECT_GE((path.points[i - 1] + share * step - disc.centre).norm(), disc.radius_m - 0.003);
      }
    }
  }
  EXPECT_GT(path.points[1].y(), 3.0);
  EXPECT_EQ(search(grid, {1.0, 3.0}, {4.2, 3.0}, blocked).outcome, Outcome::kGoalBlocked);
}

TEST(GridPath, WhoStandsInsideABlockedDiscMayLeaveItButNotGoDeeper) {
  const OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  const std::vector<BlockedDisc> blocked = {{{4.0, 3.0}, 1.0}};
  expect_ends(search(grid, {3.3, 3.0}, {1.0, 3.0}, blocked), {3.3, 3.0}, {1.0, 3.0});
  const FoundGridPath round = search(grid, {3.3, 3.0}, {7.0, 3.0}, blocked);
  expect_ends(round, {3.3, 3.0}, {7.0, 3.0});
  for (std::size_t i = 1; i < round.points.size(); ++i) {
    const Vector2 middle = 0.5 * (round.points[i] + round.points[i - 1]);
    EXPECT_GE((middle - blocked[0].centre).norm(), 0.69);
  }
}

TEST(GridPath, WhoStandsTooCloseToAWallMayLeaveItButNotComeCloser) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0});
  fill_box(grid, {4.0, 0.0}, {4.2, 6.0});
  const auto field = occupied_field(grid);
  const Vector2 start(3.85, 3.0);  // 15 cm from the wall, 30 are required
  const FoundGridPath away = search(grid, start, {1.0, 1.0});
  expect_ends(away, start, {1.0, 1.0});
  EXPECT_GE(clearance_m(away, *field), 0.149);
  // Along the wall only as far as one needs to get clear of it.
  const FoundGridPath along = search(grid, start, {3.6, 5.5});
  expect_ends(along, start, {3.6, 5.5});
  for (std::size_t i = 1; i < along.points.size(); ++i) {
    if ((along.points[i] - start).norm() < shipped_travel_options().escape_radius_m) continue;
    EXPECT_GE(field->distance_bound(along.points[i]),
              shipped_travel_options().required_clearance_m - 0.003);
  }
  EXPECT_EQ(search(grid, start, {3.85, 3.1}).outcome, Outcome::kFound);  // within the escape radius
  EXPECT_EQ(search(grid, start, {3.85, 5.0}).outcome, Outcome::kGoalBlocked);  // far beyond it
}

TEST(GridPath, TheLatticeIsNeverFinerThanTheMap) {
  const OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0}, 0.2);
  const FoundGridPath path = find_path_on_grid(occupied_field(grid), {1.0, 1.0}, {7.0, 5.0}, {},
                                               shipped_travel_options(), 0.01);
  EXPECT_EQ(path.outcome, Outcome::kFound);
}

TEST(GridPath, ACoarseLatticeOnAFineMapStillKeepsTheClearance) {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {8.0, 6.0}, 0.025);
  for (double y = 0.3; y < 6.0; y += 0.9) fill_disc(grid, {4.0, y}, 0.1, OccupancyGrid::kOccupied);
  const auto field = occupied_field(grid);
  const FoundGridPath path =
      find_path_on_grid(field, {2.0, 3.0}, {6.0, 3.1}, {}, shipped_travel_options(), 0.2);
  ASSERT_EQ(path.outcome, Outcome::kFound);
  EXPECT_GE(clearance_m(path, *field), shipped_travel_options().required_clearance_m - 0.003);
}

TEST(GridPath, OneCellIsAMap) {
  const OccupancyGrid grid = free_grid({0.0, 0.0}, {0.05, 0.05});
  EXPECT_EQ(search(grid, {0.01, 0.01}, {0.04, 0.04}).outcome, Outcome::kFound);
}

/// A room with a door at (3, 1) in the wall at x = 3.
OccupancyGrid two_rooms() {
  OccupancyGrid grid = free_grid({0.0, 0.0}, {6.0, 6.0});
  fill_box(grid, {3.0, 0.0}, {3.05, 0.5});
  fill_box(grid, {3.0, 1.5}, {3.05, 6.0});
  return grid;
}

GridPath nearest(const OccupancyGrid& grid, const Vector2& start, double most_m,
                 const std::function<bool(const Vector2&)>& suits) {
  const GridStaticMap static_map(occupied_field(grid));
  const TravelCost cost(static_map, start, {}, shipped_travel_options());
  return find_nearest_place(static_map, start, cost, 0.1, most_m, suits);
}

TEST(NearestPlace, IsNearestByTheWayNotThroughTheWall) {
  const Vector2 start(2.6, 4.0);
  const auto suits = [](const Vector2& p) { return p.x() > 3.3 || p.y() > 5.4; };
  const GridPath path = nearest(two_rooms(), start, kFar_m, suits);
  ASSERT_EQ(path.outcome, Outcome::kFound);
  EXPECT_EQ(path.points.front(), start);
  EXPECT_GT(path.points.back().y(), 5.4);
  EXPECT_LT(path.points.back().y(), 5.55);
  EXPECT_LT(path.points.back().x(), 3.0);
}

TEST(NearestPlace, GoesThroughTheDoorWhereOnlyThatSuits) {
  const GridPath path =
      nearest(two_rooms(), {2.0, 4.0}, kFar_m, [](const Vector2& p) { return p.x() > 3.5; });
  ASSERT_EQ(path.outcome, Outcome::kFound);
  for (const Vector2& place : path.points) {
    if (std::abs(place.x() - 3.0) < 0.2) {
      EXPECT_LT(std::abs(place.y() - 1.0), 0.3);
    }
  }
  EXPECT_EQ(
      nearest(two_rooms(), {2.0, 4.0}, 2.0, [](const Vector2& p) { return p.x() > 3.5; }).outcome,
      Outcome::kNoPath);
}

TEST(NearestPlace, IsTheStartWhereThatSuits) {
  const GridPath path =
      nearest(two_rooms(), {1.03, 1.07}, kFar_m, [](const Vector2&) { return true; });
  ASSERT_EQ(path.points.size(), 1u);
  EXPECT_EQ(path.points.front(), Vector2(1.03, 1.07));
  EXPECT_EQ(nearest(two_rooms(), {3.02, 4.0}, kFar_m, [](const Vector2&) { return true; }).outcome,
            Outcome::kStartBlocked);
}

TEST(NearestPlace, AsksForPlacesInTheOrderOfTheirDistance) {
  const Vector2 start(2.0, 3.0);
  double last_m = 0.0;
  int asked = 0;
  nearest(free_grid({0.0, 0.0}, {4.0, 6.0}), start, 1.2, [&](const Vector2& place) {
    const double apart_m = (place - start).norm();
    EXPECT_GT(apart_m, last_m - 0.15);  // of the lattice's eight directions
    last_m = std::max(last_m, apart_m);
    ++asked;
    return false;
  });
  EXPECT_GT(asked, 300);
  EXPECT_LT(asked, 600);
}

}  // namespace
}  // namespace mocha
