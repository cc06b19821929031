#include "safety/certifier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "safety/circle_field.h"
#include "trajectory/random_motion.h"
#include "trajectory/rover_braking.h"
#include "trajectory/simple_motions.h"
#include "world/margin_budget.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using Name = RequirementName;

constexpr double kNow_s = 1.7e9;

std::shared_ptr<const CircleField> field(std::vector<CircleField::Circle> circles) {
  return std::make_shared<CircleField>(std::move(circles));
}

/// Along x at 0.9 m/s.
Motion ahead() { return straight_drive(kNow_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5); }

/// When it is there.
double time_at(const Motion& motion, double x) {
  double t = motion.start_time();
  while (motion.position(t).x() < x && t < motion.end_time()) t += 0.01;
  return t;
}

std::shared_ptr<const MovingObstacle> person(const Vector2& place, double radius_m = 0.25,
                                             const Vector2& velocity = {0.0, 0.0}) {
  return std::make_shared<PredictedDisc>("person", kNow_s, place, velocity, radius_m, 0.0);
}

std::shared_ptr<const MovingObstacle> peer(const Vector2& place) {
  const auto stands = std::make_shared<const Motion>(standing(kNow_s - 9.0, place, 0.0));
  return std::make_shared<PeerObstacle>("ugv2", stands, 0.3, test::kRoverBraking);
}

class CertifierTest : public ::testing::Test {
 protected:
  /// Nothing is near, and all is seen.
  static Scene open() {
    Scene scene;
    scene.obstacles = field({{{100.0, 0.0}, 1.0}});
    scene.unseen = scene.obstacles;
    scene.predicted_until_s = kNow_s + 20.0;
    return scene;
  }
  Violation certified(const Motion& motion, const Scene& scene, const Requirement& required) const {
    return certify(motion, robot_.footprint, scene, required);
  }

  const RobotModel robot_ = load_robot_model("config", "rover");
  const Requirements requirements_{robot_};
  const MarginBudget margins_ = MarginBudget::of(robot_);
  const Requirement promise_ = requirements_[Name::kPromise].from(kNow_s);
};

/// What violates one field of a requirement, and nothing else: with that field changed, nothing is
/// violated any more.
struct OneField {
  const char* field;
  Motion motion;
  Scene scene;
  ViolatedTerm term;
  std::function<void(Requirement&)> without;
};

std::vector<OneField> one_by_one(const Scene& open) {
  std::vector<OneField> cases;
  const auto add = [&](const char* name, const Motion& motion, ViolatedTerm term,
                       const std::function<void(Requirement&)>& without) -> Scene& {
    cases.push_back({name, motion, open, term, without});
    return cases.back().scene;
  };
  const double passes_s = time_at(ahead(), 4.0);
  add("limits", straight_drive(kNow_s, {0.0, 0.0}, 0.0, 8.0, 1.2, 0.5), ViolatedTerm::kSpeed,
      [](Requirement& r) { r.limits.reset(); });
  const Zone slow{"slow", Polygon{{{3.0, -1.0}, {5.0, -1.0}, {5.0, 1.0}, {3.0, 1.0}}}, 0.3};
  add("limits", ahead(), ViolatedTerm::kZoneSpeed, [](Requirement& r) {
    r.limits.reset();
  }).speed_zones = SpeedZones::of({slow}, load_robot_model("config", "rover"), kNow_s - 60.0);
  add("obstacle_margin", ahead(), ViolatedTerm::kClearance, [](Requirement& r) {
    r.obstacle_margin = 0.0;
  }).obstacles = field({{{4.0, 0.85}, 0.5}});
  add("unseen_margin", ahead(), ViolatedTerm::kUnseenSpace, [](Requirement& r) {
    r.unseen_margin = 0.0;
  }).unseen = field({{{4.0, 0.85}, 0.5}});
  add("unseen_margin", ahead(), ViolatedTerm::kUnseenSpace, [](Requirement& r) {
    r.unseen_margin.reset();
  }).unseen = field({{{4.0, 0.0}, 0.5}});
  add("leaving", slowed(straight_drive(kNow_s, {0.0, 0.0}, 0.0, 3.0, 0.8, 0.8), 10.0),
      ViolatedTerm::kClearance, [](Requirement& r) { r.leaving.way_m = 20.0; })
      .obstacles = field({{{0.0, 1000.32}, 1000.0}});
  add("peer_distance_m", ahead(), ViolatedTerm::kSeparation, [](Requirement& r) {
    r.peer_distance_m.reset();
  }).peers = {peer({4.0, 0.8})};
  // It follows so closely that it could not stop behind the robot any more.
  add("stops", ahead(), ViolatedTerm::kSeparation, [](Requirement& r) { r.stops.reset(); })
      .peers = {std::make_shared<PeerObstacle>(
      "ugv2",
      std::make_shared<const Motion>(straight_drive(kNow_s, {-1.0, 0.0}, 0.0, 8.0, 0.9, 0.5)), 0.3,
      test::kRoverBraking)};
  add("predicted_distance_m", ahead(), ViolatedTerm::kSeparation, [](Requirement& r) {
    r.predicted_distance_m.reset();
  }).confident = {person({4.0, 0.7})};
  Scene& unsure = add("course", ahead(), ViolatedTerm::kSeparation,
                      [](Requirement& r) { r.course = Course::kLikely; });
  unsure.confident = {person({4.0, 1.4}, 1.0)};
  unsure.likely = {person({4.0, 1.4})};
  Scene& soon_unknown = add("reserve_s", ahead(), ViolatedTerm::kSeparation,
                            [](Requirement& r) { r.reserve_s = 1.5; });
  soon_unknown.confident = {person({4.0, 0.7})};
  soon_unknown.predicted_until_s = passes_s;
  add("predicted_until_s", ahead(), ViolatedTerm::kSeparation, [=](Requirement& r) {
    r.from_s = passes_s + 2.0;
  }).confident = {person({4.0, 0.7})};
  add("from_s", ahead(), ViolatedTerm::kClearance, [=](Requirement& r) {
    r.from_s = passes_s + 1.0;
  }).obstacles = field({{{4.0, 0.85}, 0.5}});
  add("until_s", ahead(), ViolatedTerm::kClearance, [=](Requirement& r) {
    r.until_s = passes_s - 1.0;
  }).obstacles = field({{{4.0, 0.85}, 0.5}});
  add("until_s", ahead(), ViolatedTerm::kSeparation, [=](Requirement& r) {
    r.until_s = passes_s - 2.0;
  }).peers = {peer({4.0, 0.7})};
  add("limits_from_s", straight_drive(kNow_s, {0.0, 0.0}, 0.0, 8.0, 1.2, 0.5), ViolatedTerm::kSpeed,
      [](Requirement& r) { r.limits_from_s = kNow_s + 8.0; });
  return cases;
}

TEST_F(CertifierTest, EachFieldIsAskedForByItself) {
  EXPECT_FALSE(certified(ahead(), open(), promise_));
  for (const OneField& each : one_by_one(open())) {
    const Violation violation = certified(each.motion, each.scene, promise_);
    EXPECT_EQ(violation.term, each.term) << each.field << ": " << describe(violation);
    Requirement without = promise_;
    each.without(without);
    const Violation none = certified(each.motion, each.scene, without);
    EXPECT_FALSE(none) << each.field << ": " << describe(none);
  }
}

TEST_F(CertifierTest, WithoutAStretchOfTimeItIsAllOfTheMotion) {
  const Requirement& whole = requirements_[Name::kPromise];
  EXPECT_FALSE(certified(ahead(), open(), whole));
  for (const OneField& each : one_by_one(open()))
    EXPECT_EQ(certified(each.motion, each.scene, whole).term, each.term) << each.field;
}

TEST_F(CertifierTest, PredictionsThatNeverEndAreHeldForAWhile) {
  for (const double until_s : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    Scene scene = open();
    scene.predicted_until_s = until_s;
    scene.confident = {person({4.0, -3.0}, 0.25, {0.0, 0.6})};
    EXPECT_EQ(certified(ahead(), scene, promise_).term, ViolatedTerm::kSeparation);
    scene.confident = {person({4.0, -3.0}, 0.25, {0.0, -0.6})};
    EXPECT_FALSE(certified(ahead(), scene, promise_));
  }
}

TEST_F(CertifierTest, LimitsHoldFromWhereTheMotionJoins) {
  // 1.2 m/s from about 2 s to 7 s on.
  const Motion fast = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 8.0, 1.2, 0.5);
  for (const double join_s : {1.0, 3.0, 4.5}) {
    const Violation violation = certified(fast, open(), promise_.joining_at(kNow_s + join_s));
    EXPECT_EQ(violation.term, ViolatedTerm::kSpeed) << join_s;
    EXPECT_GE(violation.time_s, kNow_s + join_s - 1e-6);
  }
}

TEST_F(CertifierTest, OfSeveralViolationsItIsTheEarliest) {
  // Each in its turn is the first.
  const double places[] = {2.0, 3.5, 5.0, 6.5};
  std::vector<int> order = {0, 1, 2, 3};
  const ViolatedTerm terms[] = {ViolatedTerm::kClearance, ViolatedTerm::kUnseenSpace,
                                ViolatedTerm::kSeparation, ViolatedTerm::kSeparation};
  const char* peers[] = {"", "", "ugv2", "person"};
  // A stop is in the way earlier than a drive.
  Requirement required = promise_;
  required.stops.reset();
  do {
    Scene scene = open();
    const auto beside = [&](int kind) { return Vector2(places[order[kind]], 0.6); };
    scene.obstacles = field({{beside(0), 0.25}});
    scene.unseen = field({{beside(1), 0.25}});
    scene.peers = {peer(beside(2))};
    scene.confident = {person(beside(3))};
    const Violation violation = certified(ahead(), scene, required);
    const int first = static_cast<int>(std::find(order.begin(), order.end(), 0) - order.begin());
    EXPECT_EQ(violation.term, terms[first]);
    EXPECT_EQ(violation.peer, peers[first]);
    EXPECT_LT(violation.place.x(), places[0] + 0.01);
  } while (std::next_permutation(order.begin(), order.end()));
  // Too fast at once.
  Scene scene = open();
  scene.obstacles = field({{{2.0, 0.6}, 0.25}});
  const Motion hasty = straight_drive(kNow_s, {0.0, 0.0}, 0.0, 8.0, 0.9, 1.5);
  EXPECT_EQ(certified(hasty, scene, promise_).term, ViolatedTerm::kAcceleration);
}

TEST_F(CertifierTest, SpaceThatWasNeverSeenHasTheStaticMargin) {
  const auto passing = [](double gap_m) {
    Scene scene = open();
    scene.unseen = field({{{4.0, 0.3 + gap_m + 0.5}, 0.5}});
    return scene;
  };
  const double speed = ahead().velocity(time_at(ahead(), 4.0)).norm();
  const double margin_m = margins_.static_margin().at(speed);
  const double in_force_m = margins_.without_map().at(speed);
  EXPECT_FALSE(certified(ahead(), passing(margin_m + 0.002), promise_));
  EXPECT_EQ(certified(ahead(), passing(margin_m - 0.005), promise_).term,
            ViolatedTerm::kUnseenSpace);
  const Requirement renewal = requirements_[Name::kRenewal].from(kNow_s);
  EXPECT_FALSE(certified(ahead(), passing(in_force_m + 0.002), renewal));
  EXPECT_TRUE(certified(ahead(), passing(in_force_m - 0.005), renewal));
}

TEST_F(CertifierTest, APromiseInForceMayUseUpTheMarginOfTheMap) {
  const auto beside = [](double gap_m) {
    Scene scene = open();
    scene.obstacles = field({{{4.0, 0.3 + gap_m + 0.5}, 0.5}});
    return scene;
  };
  const double speed = ahead().velocity(time_at(ahead(), 4.0)).norm();
  const double margin_m = margins_.static_margin().at(speed);
  const double in_force_m = margins_.without_map().at(speed);
  const Requirement renewal = requirements_[Name::kRenewal].from(kNow_s);
  EXPECT_FALSE(certified(ahead(), beside(margin_m + 0.002), promise_));
  EXPECT_TRUE(certified(ahead(), beside(margin_m - 0.02), promise_));
  EXPECT_FALSE(certified(ahead(), beside(margin_m - 0.02), renewal));
  EXPECT_TRUE(certified(ahead(), beside(in_force_m - 0.005), renewal));
}

TEST_F(CertifierTest, NothingAllowsABaseThatCannotReverseToDriveBackward) {
  RobotModel forward = robot_;
  forward.limits.can_reverse = false;
  const Motion back = within(random_drive(1, 5, -1), {0.95, 0.78, 1.45}, kNow_s);
  for (const Name name :
       {Name::kPlan, Name::kDetour, Name::kDetourLikely, Name::kEmergencyDetour, Name::kPromise,
        Name::kPromiseLikely, Name::kRenewal, Name::kEmergency, Name::kEscape}) {
    EXPECT_FALSE(certified(back, open(), requirements_[name])) << to_text(name);
    EXPECT_EQ(certified(back, open(), Requirements(forward)[name]).term,
              ViolatedTerm::kSpeedBackward)
        << to_text(name);
  }
}

/// What is promised today holds tomorrow: on all of its way, a promise is renewed in the same
/// scene.
TEST_F(CertifierTest, APromiseIsRenewedOnAllOfItsWay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto place = [&]() -> Vector2 { return 5.0 * Vector2(unit(random), unit(random)); };
  int certified_ones = 0;
  int leaving = 0;  // of these, they begin closer to something than they should
  for (int seed = 0; seed < 4000; ++seed) {
    const Motion motion =
        within(random_drive(seed, 5, seed % 3 == 0 ? -1 : 1), {0.95, 0.78, 1.45}, kNow_s);
    // Of peers, nothing is asked that is farther ahead; no promise reaches that far.
    if (motion.end_time() > kNow_s + 9.5) continue;
    Scene scene = open();
    std::vector<CircleField::Circle> circles;
    for (int i = 0; i < 5; ++i) circles.push_back({place(), 0.3});
    const Vector2 course = motion.velocity(kNow_s + 0.1).normalized();
    if (seed % 2 == 0)
      circles.push_back({-0.6 * course - (0.05 + 0.05 * unit(random)) * course, 0.3});
    scene.obstacles = field(circles);
    circles.push_back({place(), 0.6});
    scene.unseen = field(circles);
    scene.peers = {peer(place()), std::make_shared<PeerObstacle>(
                                      "ugv3",
                                      std::make_shared<const Motion>(straight_drive(
                                          kNow_s, place(), 3.0 * unit(random), 4.0, 0.9, 0.5)),
                                      0.3, test::kRoverBraking)};
    for (int i = 0; i < 2; ++i) {
      const Vector2 centre = place();
      const Vector2 velocity = 0.2 * place();
      scene.confident.push_back(person(centre, 0.4, velocity));
      scene.likely.push_back(person(centre, 0.25, velocity));
    }
    scene.predicted_until_s = kNow_s + 5.0;
    if (certified(motion, scene, promise_)) continue;
    ++certified_ones;
    leaving += scene.obstacles->distance_bound({0.0, 0.0}) < 0.3 + margins_.static_margin_m();
    for (double t = kNow_s; t < motion.end_time() + 1.0; t += 0.1) {
      const Violation violation = certified(motion, scene, requirements_[Name::kRenewal].from(t));
      EXPECT_FALSE(violation) << seed << ", after " << t - kNow_s << " s: " << describe(violation);
      if (violation) break;
    }
  }
  EXPECT_GT(certified_ones, 150);
  EXPECT_GT(leaving, 15);
}

TEST_F(CertifierTest, ARectangleNeedsAGapOfItsWidthAndItsMargins) {
  const RobotModel jackal = load_robot_model("config", "jackal");
  const Requirement promise = Requirements(jackal)[Name::kPromise].from(kNow_s);
  const double needed_m = 0.43 + 2.0 * MarginBudget::of(jackal).static_margin_m();
  const auto through = [&](double gap_m) {
    const auto side = [gap_m](double sign) {
      const double near = 0.5 * sign * gap_m;
      return Polygon{{{3.0, near}, {3.3, near}, {3.3, 9.0 * sign}, {3.0, 9.0 * sign}}};
    };
    Scene scene = open();
    scene.obstacles =
        std::make_shared<PrimitiveField<2>>(std::vector<Obstacle>{side(1.0), side(-1.0)}, 1.0);
    return certify(ahead(), jackal.footprint, scene, promise);
  };
  const Violation wide = through(needed_m + 0.02);
  EXPECT_FALSE(wide) << describe(wide);
  EXPECT_EQ(through(needed_m - 0.01).term, ViolatedTerm::kClearance);
}

}  // namespace
}  // namespace mocha
