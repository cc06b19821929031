#include "planning/maneuvers/most_room.h"

#include <gtest/gtest.h>

#include "planning/maneuver_test.h"
#include "planning/maneuvers/brake.h"
#include "planning/maneuvers/sidestep.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class MostRoomTest : public ManeuverTest {
 protected:
  LocalScene with(const Vector2& place, const Vector2& velocity) const {
    LocalScene scene = scene_of(open_);
    scene.confident = {person(kNow_s, here() + place, velocity)};
    scene.predicted_until_s = kNow_s + 5.0;
    return scene;
  }
  Vector2 here() const { return ahead_.position(kNow_s); }

  /// Between the bodies, while the person walks on for ten seconds.
  double least_gap_m(const Motion& motion, const LocalScene& scene) const {
    double least_m = std::numeric_limits<double>::infinity();
    const double own_m = robot_.footprint.circumscribed_radius_m();
    for (double t = kNow_s; t < kNow_s + 10.0; t += 0.01) {
      const auto disc = scene.confident[0]->at(t);
      least_m =
          std::min(least_m, (motion.position(t) - disc.centre).norm() - disc.radius_m - own_m);
    }
    return least_m;
  }

  /// Whether any of the earlier rows of the ladder keeps clear.
  bool is_certified_otherwise(const LocalScene& scene) const {
    using Name = RequirementName;
    for (const Name required : {Name::kPromise, Name::kPromiseLikely}) {
      const Course course = required == Name::kPromise ? Course::kConfident : Course::kLikely;
      const ManeuverStart start = start_of(ahead_, scene, kNow_s, course);
      for (const auto& make : {brake_soon, brake_in_time, brake_in_time_at_once, sidesteps}) {
        if (first_certified(start, make(start), required)) return true;
      }
    }
    const ManeuverStart start = start_of(ahead_, scene, kNow_s);
    return first_certified(start, brake_hard(start), Name::kRenewal).has_value();
  }

  /// As the ladder ends: what keeps the most room, else the last resort; the committed motion where
  /// that is to go on.
  Choice least_bad(const Motion& committed, const LocalScene& scene) const {
    const ManeuverStart start = start_of(committed, scene, kNow_s, Course::kLikely);
    if (auto choice = first_certified(start, most_room(start), RequirementName::kEscape))
      return *choice;
    if (auto choice = first_certified(start, last_resort(start), RequirementName::kNone))
      return *choice;
    const Motion rest = rest_of(committed, start.emergency_s);
    return {whole(rest, start.emergency_s, false, "goes on"), rest};
  }
  Motion done(const Motion& committed, const Choice& choice) const {
    return splice(committed, kNow_s, choice.motion.start_time(), choice.motion).motion;
  }
  static bool swerves(const Choice& choice) {
    return choice.words().find("swerves") == 0 || choice.words().find("finds a way out") == 0;
  }

  /// On for 0.9 m, and then backward out of everybody's way.
  Motion drive_there_and_back() const {
    std::vector<Phase> phases = ahead_.phases_between(ahead_.start_time(), kNow_s);
    for (Phase& phase : brake_along(ahead_, kNow_s, Braking(0.45))) phases.push_back(phase);
    const Motion there(ahead_.start_time(), phases);
    const Motion back = straight_drive(0.0, there.end_pose().position, M_PI, 3.0, 0.9, 0.5);
    phases.push_back(DrivePhase{-1, std::get<DrivePhase>(back.phases().front()).path});
    return Motion(ahead_.start_time(), phases);
  }

  const OccupancyGrid open_ = free_grid({-8.0, -8.0}, {12.0, 8.0});
  const Motion ahead_ = straight_drive(kNow_s - 3.0, {-2.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
};

TEST_F(MostRoomTest, SwervesBeforeWhatComesTooFastToBrakeFor) {
  for (const double side : {-1.0, 1.0}) {
    const LocalScene scene = with({1.9, 0.35 * side}, {-1.0, 0.0});
    ASSERT_FALSE(is_certified_otherwise(scene));
    const Choice choice = least_bad(ahead_, scene);
    EXPECT_TRUE(swerves(choice)) << choice.words();
    EXPECT_TRUE(choice.maneuver.at_once);
    EXPECT_GT(least_gap_m(done(ahead_, choice), scene), 0.0);
    EXPECT_LT(side * choice.motion.end_pose().position.y(), -0.1);
  }
}

/// What comes so fast that the bodies may touch, whatever is done, is at least not waited for.
TEST_F(MostRoomTest, RatherGrazesThanIsRunOver) {
  for (const double ahead_m : {1.4, 1.5, 1.6}) {
    const LocalScene scene = with({ahead_m, 0.3}, {-1.0, 0.0});
    const Choice choice = least_bad(ahead_, scene);
    EXPECT_EQ(choice.words().find("brakes"), std::string::npos) << ahead_m;
    EXPECT_GT(least_gap_m(done(ahead_, choice), scene), -0.15) << ahead_m;
  }
}

/// Where a whole row of people may be in ten seconds is no reason to be run over now.
TEST_F(MostRoomTest, SwervesWhateverOthersMayDoMuchLater) {
  LocalScene scene = with({1.9, 0.35}, {-1.0, 0.0});
  for (double x = -4.0; x < 8.0; x += 0.6)
    scene.confident.push_back(person(kNow_s, here() + Vector2(x, 10.0), {0.0, -1.0}));
  const Choice choice = least_bad(ahead_, scene);
  EXPECT_TRUE(swerves(choice)) << choice.words();
  EXPECT_GT(least_gap_m(done(ahead_, choice), scene), 0.0);
}

TEST_F(MostRoomTest, DoesNotSwerveBesideAPeer) {
  LocalScene scene = with({1.9, 0.35}, {-1.0, 0.0});
  scene.peers = {peer(standing(kNow_s - 9.0, here() + Vector2(0.0, 4.0), 0.0))};
  const Choice choice = least_bad(ahead_, scene);
  EXPECT_FALSE(swerves(choice)) << choice.words();
  EXPECT_FALSE(choice.maneuver.at_once && choice.words().find("brakes") != 0u) << choice.words();
}

TEST_F(MostRoomTest, DoesNotSwerveIntoAWall) {
  OccupancyGrid walled = open_;
  fill_box(walled, {-8.0, 0.5}, {12.0, 8.0});
  fill_box(walled, {-8.0, -8.0}, {12.0, -0.5});
  LocalScene scene = scene_of(walled);
  scene.confident = with({1.9, 0.0}, {-1.0, 0.0}).confident;
  scene.predicted_until_s = kNow_s + 5.0;
  const Motion driven = done(ahead_, least_bad(ahead_, scene));
  for (double t = kNow_s; t < driven.end_time(); t += 0.02) {
    EXPECT_GE(scene.obstacles->distance_bound(driven.position(t)),
              robot_.footprint.circumscribed_radius_m());
  }
}

/// Straight back it would be followed, and sooner or later reached.
TEST_F(MostRoomTest, StepsOutOfTheWayNotAlongIt) {
  const Motion stands = standing(kNow_s - 1.0, {0.0, 0.0}, 0.0);
  LocalScene scene = scene_of(open_);
  scene.confident = {person(kNow_s, {1.6, 0.05}, {-0.4, 0.0})};
  scene.predicted_until_s = kNow_s + 5.0;
  const ManeuverStart start = start_of(stands, scene, kNow_s);
  const auto aside = first_certified(start, sidesteps(start), RequirementName::kPromise);
  ASSERT_TRUE(aside);
  for (const Choice& choice : {*aside, least_bad(stands, scene)})
    EXPECT_GT(least_gap_m(done(stands, choice), scene), 0.0) << choice.words();
}

TEST_F(MostRoomTest, KeepsMoreRoomThanWhatIsCommittedAndBraking) {
  int found = 0;
  for (double ahead_m = 1.2; ahead_m < 3.0; ahead_m += 0.2) {
    for (const double side_m : {-0.4, -0.1, 0.2}) {
      const LocalScene scene = with({ahead_m, side_m}, {-0.9, 0.2});
      const ManeuverStart start = start_of(ahead_, scene, kNow_s, Course::kLikely);
      const auto hard = first_certified(start, brake_hard(start), RequirementName::kNone);
      const double brake_m = least_gap_m(done(ahead_, *hard), scene);
      const double on_m = least_gap_m(ahead_, scene);
      for (const Maneuver& each : most_room(start)) {
        const auto onward = splice(ahead_, kNow_s, each.join_s, each.motion);
        ASSERT_TRUE(onward) << describe(onward.fault);
        EXPECT_GT(least_gap_m(onward.motion, scene), std::max(brake_m, on_m)) << each.words;
        ++found;
      }
    }
  }
  EXPECT_GT(found, 50);
}

TEST_F(MostRoomTest, TheLastResortBrakesUnlessGoingOnKeepsMoreRoom) {
  const LocalScene in_front = with({0.8, 0.0}, {0.0, 0.0});
  const ManeuverStart before_it = start_of(ahead_, in_front, kNow_s, Course::kLikely);
  const auto brakes = first_certified(before_it, last_resort(before_it), RequirementName::kNone);
  ASSERT_TRUE(brakes);
  EXPECT_EQ(brakes->words(), "brakes all the same");
  EXPECT_TRUE(brakes->maneuver.at_once);
  EXPECT_LT(brakes->motion.length_m(), 0.5);
  // It comes across where the robot would stop, and where it would be past by then.
  const LocalScene across = with({0.35, -1.5}, {0.0, 1.0});
  EXPECT_TRUE(last_resort(start_of(ahead_, across, kNow_s, Course::kLikely)).empty());
  const Motion stands = standing(kNow_s - 1.0, here(), 0.0);
  EXPECT_TRUE(last_resort(start_of(stands, in_front, kNow_s, Course::kLikely)).empty());
}

/// A team-mate that is to pass much later, where braking would leave the robot, is told of that and
/// brakes; what stands before the robot is not.
TEST_F(MostRoomTest, ForWhatATeamMateIsToDoNobodyDrivesIntoWhatPromisesNothing) {
  LocalScene scene = with({1.6, 0.0}, {0.0, 0.0});
  const Motion there_and_back = drive_there_and_back();
  scene.peers = {
      peer(straight_drive(kNow_s + 2.0, here() + Vector2(0.6, 5.0), -M_PI_2, 8.0, 0.9, 0.5))};
  const ManeuverStart start = start_of(there_and_back, scene, kNow_s, Course::kLikely);
  const auto brakes = first_certified(start, last_resort(start), RequirementName::kNone);
  ASSERT_TRUE(brakes);
  EXPECT_EQ(brakes->words(), "brakes all the same");
}

}  // namespace
}  // namespace mocha
