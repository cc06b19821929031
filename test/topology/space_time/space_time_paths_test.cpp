#include "topology/space_time/space_time_paths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "topology/shipped_options.h"
#include "topology/signatures/signature_sums.h"
#include "topology/space_time/space_time_scenes.h"

namespace mocha {
namespace {

using Outcome = SpaceTimePaths::Outcome;

constexpr double kNow_s = 1000.0;
constexpr double kMaxSpeed = 1.5;
constexpr double kRequired_m = 0.35;

SpaceTimeOptions rules_with(int classes = 4) {
  SpaceTimeOptions options = shipped_space_time_options(kMaxSpeed);
  options.required_clearance_m = kRequired_m;
  options.classes = classes;
  return options;
}

/// Five metres ahead in five seconds.
SpaceTimeQuery straight_ahead(std::vector<MovingThing> moving = {}) {
  return {{{-2.5, 0.0}, kNow_s}, {{2.5, 0.0}, kNow_s + 5.0}, std::move(moving), {}};
}

Vector2 position_at(const TimedPath& path, double t) {
  std::size_t i = 1;
  while (i + 1 < path.size() && path[i].time_s < t) ++i;
  const double share = (t - path[i - 1].time_s) / (path[i].time_s - path[i - 1].time_s);
  return path[i - 1].position + share * (path[i].position - path[i - 1].position);
}

/// All that is promised of every result.
void expect_sound(const SpaceTimePaths& found, const StaticMap& static_map,
                  const SpaceTimeQuery& query, const SpaceTimeOptions& options) {
  ASSERT_EQ(found.outcome == Outcome::kFound, !found.paths.empty());
  std::set<Signature> classes;
  double last_m = 0.0;
  for (const SpaceTimePath& path : found.paths) {
    expect_drivable(path.points, query, options.max_speed);
    const Room room =
        sampled_room(path.points, static_map, query.moving, options.required_clearance_m);
    EXPECT_GE(room.still_m, -1e-6);
    EXPECT_GE(room.moving_m, -1e-6);
    EXPECT_TRUE(classes.insert(path.signature).second);
    EXPECT_GE(path.length_m, last_m);
    last_m = path.length_m;
    EXPECT_GE(last_m, (query.goal.position - query.start.position).norm() - 1e-9);
  }
}

TEST(SpaceTimePaths, AreSoundInRandomScenes) {
  int paths = 0;
  for (int seed = 0; seed < 60; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < seed % 12; ++i) {
      const Circle circle{{uniform(random, -4.0, 4.0), uniform(random, -4.0, 4.0)}, 0.3};
      if (std::abs(std::abs(circle.centre.x()) - 2.5) > 1.0) obstacles.push_back(circle);
    }
    const PrimitiveStaticMap static_map = static_map_of(obstacles);
    SpaceTimeQuery query = straight_ahead();
    for (int i = 0; i < 1 + seed % 5; ++i) {
      const Vector2 meeting(uniform(random, -1.5, 1.5), uniform(random, -0.5, 0.5));
      const Vector2 velocity(uniform(random, -1.2, 1.2), uniform(random, -1.2, 1.2));
      const double until_s = kNow_s + uniform(random, 2.0, 6.0);
      query.moving.push_back(person(kNow_s, meeting - (meeting.x() + 2.5) * velocity, velocity,
                                    uniform(random, 0.2, 0.5), until_s));
    }
    SpaceTimeOptions options = rules_with(6);
    options.escape_radius_m = 0.0;
    options.seed = seed;
    const SpaceTimePaths found = find_space_time_paths(static_map, query, options);
    if (sampled_room({query.start, {query.start.position, kNow_s + 1e-3}}, static_map, query.moving,
                     kRequired_m)
            .moving_m < 0.0) {
      continue;  // one starts too close, which has a test of its own
    }
    expect_sound(found, static_map, query, options);
    paths += static_cast<int>(found.paths.size());
  }
  EXPECT_GT(paths, 60);
}

TEST(SpaceTimePaths, LeadBeforeAndBehindWhoCrosses) {
  const PrimitiveStaticMap static_map = static_map_of({});
  const SpaceTimeQuery query = straight_ahead({person(kNow_s, {0.0, -2.5}, {0.0, 1.0})});
  const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with());
  expect_sound(found, static_map, query, rules_with());
  ASSERT_EQ(found.paths.size(), 2u);
  std::set<int> turns;
  std::set<bool> before;
  for (const SpaceTimePath& path : found.paths) {
    ASSERT_EQ(path.signature.size(), 1u);
    turns.insert(path.signature[0]);
    // Where the way is when the person comes to its line.
    for (double t = kNow_s;; t += 0.01) {
      const Vector2 p = position_at(path.points, t);
      if (query.moving[0].obstacle->at(t).centre.y() < p.y()) continue;
      before.insert(p.x() > 0.0);
      break;
    }
    EXPECT_LT(path.length_m, 5.6);
  }
  EXPECT_EQ(turns.size(), 2u);
  EXPECT_EQ(before.size(), 2u);
}

TEST(SpaceTimePaths, OfTwoWhoCrossAreFour) {
  const PrimitiveStaticMap static_map = static_map_of({});
  const SpaceTimeQuery query = straight_ahead({person(kNow_s, {-0.8, -1.7}, {0.0, 1.0}, 0.25),
                                               person(kNow_s, {0.9, 3.4}, {0.0, -1.0}, 0.25)});
  const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with(8));
  expect_sound(found, static_map, query, rules_with(8));
  EXPECT_EQ(found.paths.size(), 4u);
  EXPECT_EQ(find_space_time_paths(static_map, query, rules_with(3)).paths.size(), 3u);
}

TEST(SpaceTimePaths, FollowInACorridor) {
  // Too narrow to pass, so one can only follow.
  const PrimitiveStaticMap static_map = static_map_of(corridor(0.8));
  SpaceTimeQuery query = straight_ahead({person(kNow_s, {-0.8, 0.0}, {0.9, 0.0})});
  const SpaceTimePaths behind = find_space_time_paths(static_map, query, rules_with());
  expect_sound(behind, static_map, query, rules_with());
  EXPECT_EQ(behind.paths.size(), 1u);
  query.moving = {person(kNow_s, {2.0, 0.0}, {-0.8, 0.0})};  // one that comes towards us blocks all
  EXPECT_EQ(find_space_time_paths(static_map, query, rules_with()).outcome, Outcome::kNoPath);
}

TEST(SpaceTimePaths, OvertakeOnBothSides) {
  const PrimitiveStaticMap static_map = static_map_of({});
  const SpaceTimeQuery query = straight_ahead({person(kNow_s, {-1.0, 0.0}, {0.3, 0.0}, 0.35)});
  const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with());
  expect_sound(found, static_map, query, rules_with());
  ASSERT_GE(found.paths.size(), 2u);
  std::set<bool> left;
  for (int i = 0; i < 2; ++i) {
    for (double t = kNow_s;; t += 0.01) {
      const Vector2 p = position_at(found.paths[i].points, t);
      if (p.x() < query.moving[0].obstacle->at(t).centre.x()) continue;
      left.insert(p.y() > 0.0);
      break;
    }
  }
  EXPECT_EQ(left.size(), 2u);
}

TEST(SpaceTimePaths, PassAPillarAndAPerson) {
  const PrimitiveStaticMap static_map = static_map_of({Circle{{-0.8, 0.0}, 0.2}});
  const SpaceTimeQuery query = straight_ahead({person(kNow_s, {1.0, -3.0}, {0.0, 0.9}, 0.25)});
  const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with(8));
  expect_sound(found, static_map, query, rules_with(8));
  EXPECT_GE(found.paths.size(), 4u);
  for (const SpaceTimePath& path : found.paths) EXPECT_EQ(path.signature.size(), 2u);
}

TEST(SpaceTimePaths, GiveWayToWhoComesFromBehind) {
  const PrimitiveStaticMap static_map = static_map_of({});
  SpaceTimeQuery query = straight_ahead({person(kNow_s, {-4.5, 0.0}, {2.5, 0.0}, 0.3)});
  const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with());
  expect_sound(found, static_map, query, rules_with());
  EXPECT_GE(found.paths.size(), 2u);  // it passes on the left or on the right
}

TEST(SpaceTimePaths, HaveTheStraightWayWhereItIsFree) {
  for (int seed = 1; seed <= 20; ++seed) {
    const PrimitiveStaticMap static_map = static_map_of(corridor(0.36));
    const SpaceTimeQuery query = straight_ahead();
    SpaceTimeOptions options = rules_with();
    options.seed = seed;
    options.samples = 10;
    const SpaceTimePaths found = find_space_time_paths(static_map, query, options);
    ASSERT_FALSE(found.paths.empty());
    EXPECT_EQ(found.paths.front().points.size(), 2u);
    EXPECT_DOUBLE_EQ(found.paths.front().length_m, 5.0);
  }
}

TEST(SpaceTimePaths, KeepTheClassThatIsDriven) {
  const PrimitiveStaticMap static_map = static_map_of({});
  SpaceTimeQuery query = straight_ahead({person(kNow_s, {0.3, -2.5}, {0.0, 1.0})});
  const SpaceTimePaths all = find_space_time_paths(static_map, query, rules_with());
  ASSERT_EQ(all.paths.size(), 2u);
  SpaceTimeOptions options = rules_with(1);
  options.samples = 0;
  for (const SpaceTimePath& path : all.paths) {
    EXPECT_FALSE(path.driven);
    // It began earlier, ends a little elsewhere and later than the goal, and has a gap.
    query.driven = {{{-3.5, 0.1}, kNow_s - 1.0}};
    for (double t = kNow_s + 0.1; t < kNow_s + 4.2; t += 0.2) {
      query.driven.push_back({position_at(path.points, t), t});
    }
    query.driven.push_back({{2.7, 0.2}, kNow_s + 5.5});
    const SpaceTimePaths found = find_space_time_paths(static_map, query, options);
    expect_sound(found, static_map, query, options);
    ASSERT_EQ(found.paths.size(), 1u);
    EXPECT_TRUE(found.paths[0].driven);
    EXPECT_EQ(found.paths[0].signature, path.signature);
    EXPECT_LT(found.paths[0].length_m, 1.02 * path.length_m);
    // Among several, it is marked, however many are asked for.
    int driven = 0;
    for (const SpaceTimePath& each :
         find_space_time_paths(static_map, query, rules_with(1)).paths) {
      driven += each.driven;
      EXPECT_EQ(each.driven, each.signature == path.signature);
    }
    EXPECT_EQ(driven, 1);
  }
}

TEST(SpaceTimePaths, DropTheClassThatIsDrivenWhereItIsBlocked) {
  const PrimitiveStaticMap static_map = static_map_of({});
  SpaceTimeQuery query = straight_ahead({person(kNow_s, {0.0, -2.5}, {0.0, 1.0})});
  query.driven = {query.start, query.goal};  // through it
  SpaceTimeOptions options = rules_with();
  options.samples = 0;
  EXPECT_EQ(find_space_time_paths(static_map, query, options).outcome, Outcome::kNoPath);
}

TEST(SpaceTimePaths, LeaveWhoIsTooClose) {
  const PrimitiveStaticMap static_map = static_map_of({});
  for (const double apart_m : {0.3, 0.5, 0.7}) {
    const Vector2 aside(-0.6 * apart_m, 0.8 * apart_m);
    const SpaceTimeQuery query =
        straight_ahead({person(kNow_s, Vector2(-2.5, 0.0) + aside, {0.1, 0.0})});
    const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with());
    ASSERT_EQ(found.outcome, Outcome::kFound) << apart_m;
    for (const SpaceTimePath& path : found.paths) {
      expect_drivable(path.points, query, kMaxSpeed);
      const double now_m = apart_m - 0.25 - 0.5;
      double regained_s = 1e18;
      for (double t = kNow_s; t < kNow_s + 5.0; t += 0.01) {
        const auto disc = query.moving[0].obstacle->at(t);
        const double room_m =
            (position_at(path.points, t) - disc.centre).norm() - disc.radius_m - 0.5;
        const double least_m = now_m - 0.0031 + 0.1 * kMaxSpeed * (t - kNow_s);
        ASSERT_GE(room_m, std::min(least_m, 0.0) - 1e-6) << apart_m << " " << t - kNow_s;
        if (room_m >= 0.0) regained_s = std::min(regained_s, t);
      }
      EXPECT_LT(regained_s, kNow_s + 5.0);
    }
  }
}

TEST(SpaceTimePaths, OutcomesSayWhatIsBlocked) {
  const PrimitiveStaticMap static_map =
      static_map_of({Circle{{-2.5, 5.0}, 1.0}, Circle{{9.0, 0.0}, 1.0}});
  const SpaceTimeOptions options = rules_with();
  const auto outcome = [&](const Vector2& start, const Vector2& goal, double duration_s = 5.0) {
    const SpaceTimeQuery query = {{start, kNow_s}, {goal, kNow_s + duration_s}, {}, {}};
    const SpaceTimePaths found = find_space_time_paths(static_map, query, options);
    EXPECT_EQ(found.paths.empty(), found.outcome != Outcome::kFound);
    return found.outcome;
  };
  EXPECT_EQ(outcome({-2.5, 0.0}, {2.5, 0.0}), Outcome::kFound);
  EXPECT_EQ(outcome({-2.5, 5.0}, {2.5, 0.0}), Outcome::kStartBlocked);
  EXPECT_EQ(outcome({-25.0, 0.0}, {-19.0, 0.0}), Outcome::kStartBlocked);
  EXPECT_EQ(outcome({6.5, 0.0}, {8.0, 0.0}), Outcome::kGoalBlocked);
  EXPECT_EQ(outcome({-2.5, 0.0}, {2.5, 0.0}, 3.0), Outcome::kNoPath);  // too fast
  EXPECT_EQ(outcome({-2.5, 0.0}, {-2.5, 0.0}), Outcome::kFound);       // stand
  EXPECT_EQ(outcome({-2.5, 0.0}, {2.5, 0.0}, 0.0), Outcome::kNoPath);
  EXPECT_EQ(outcome({-2.5, 0.0}, {2.5, 0.0}, -1.0), Outcome::kNoPath);
  // Just in time, for which rounding is allowed.
  EXPECT_EQ(outcome({-2.5, 0.0}, {2.5, 0.0}, 5.0 / kMaxSpeed), Outcome::kFound);
}

TEST(SpaceTimePaths, StandValuesThatAreNotFinite) {
  const PrimitiveStaticMap static_map = static_map_of({});
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
    for (int which = 0; which < 8; ++which) {
      SpaceTimeQuery query = straight_ahead({person(kNow_s, {0.0, -2.5}, {0.0, 1.0})});
      query.driven = {query.start, {{0.5, 1.0}, kNow_s + 2.0}, query.goal};
      if (which == 0) query.start.position.x() = bad;
      if (which == 1) query.start.time_s = bad;
      if (which == 2) query.goal.position.y() = bad;
      if (which == 3) query.goal.time_s = bad;
      if (which == 4) query.moving[0].keep_m = bad;
      if (which == 5) query.moving[0].until_s = bad;
      if (which == 6) query.driven[1].position.x() = bad;
      if (which == 7) query.driven[1].time_s = bad;
      const Outcome outcome = find_space_time_paths(static_map, query, rules_with()).outcome;
      if (bad == 1e300) continue;  // finite, but rounding leaves no sense in it
      EXPECT_EQ(outcome == Outcome::kFound, which >= 5) << bad << " " << which;
    }
  }
  SpaceTimeOptions options = rules_with();
  for (const double bad : {std::nan(""), 0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    options.max_speed = bad;
    EXPECT_THROW(find_space_time_paths(static_map, straight_ahead(), options),
                 std::invalid_argument);
  }
  EXPECT_THROW(find_space_time_paths(static_map, straight_ahead(), rules_with(0)),
               std::invalid_argument);
}

TEST(SpaceTimePaths, IgnoreAThousandFarAway) {
  const PrimitiveStaticMap static_map = static_map_of({});
  SpaceTimeQuery query = straight_ahead({person(kNow_s, {0.0, -2.5}, {0.0, 1.0})});
  const SpaceTimePaths alone = find_space_time_paths(static_map, query, rules_with());
  for (int i = 0; i < 1000; ++i) {
    query.moving.push_back(person(kNow_s, {30.0 + i, 15.0}, {0.5, 0.2}));
  }
  const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with());
  ASSERT_EQ(found.paths.size(), alone.paths.size());
  for (std::size_t i = 0; i < found.paths.size(); ++i) {
    EXPECT_EQ(found.paths[i].length_m, alone.paths[i].length_m);
    EXPECT_EQ(found.paths[i].signature.size(), 1001u);
  }
}

TEST(SpaceTimePaths, AreTheSameEveryTime) {
  const PrimitiveStaticMap static_map = static_map_of({Circle{{-0.8, 0.0}, 0.2}});
  const SpaceTimeQuery query = straight_ahead({person(kNow_s, {1.0, -3.0}, {0.0, 0.9})});
  const SpaceTimePaths first = find_space_time_paths(static_map, query, rules_with());
  const SpaceTimePaths second = find_space_time_paths(static_map, query, rules_with());
  ASSERT_EQ(first.paths.size(), second.paths.size());
  for (std::size_t i = 0; i < first.paths.size(); ++i) {
    ASSERT_EQ(first.paths[i].points.size(), second.paths[i].points.size());
    for (std::size_t k = 0; k < first.paths[i].points.size(); ++k)
      EXPECT_EQ(first.paths[i].points[k].position, second.paths[i].points[k].position);
  }
}

TEST(SpaceTimePaths, AreFreeOnceAPredictionEnds) {
  const PrimitiveStaticMap static_map = static_map_of({});
  const SpaceTimeQuery query =
      straight_ahead({person(kNow_s, {1.5, -3.5}, {0.0, 0.9}, 0.5, kNow_s + 2.0)});
  const SpaceTimePaths found = find_space_time_paths(static_map, query, rules_with());
  ASSERT_EQ(found.outcome, Outcome::kFound);
  EXPECT_EQ(found.paths.front().points.size(), 2u);  // straight through where it would have been
}

}  // namespace
}  // namespace mocha
