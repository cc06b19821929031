#include "stack/local_replanning.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

/// A rover under way along x, on a promise with the number 3.
class LocalReplanningTest : public ::testing::Test {
 protected:
  LocalReplanningTest() { replanning_.set_committed({2, 3}, drive_); }

  LocalKnowledge all_known() const {
    const MotionState at = drive_.at(kNow_s);
    LocalKnowledge known;
    known.measured = RobotState{kNow_s, at.pose, {at.speed, at.yaw_rate}};
    known.map_age_s = known.fleet_age_s = known.prediction_age_s = 0.0;
    known.scene = [this](const Vector2&) { return scene_; };
    return known;
  }

  /// It brakes along its motion, at once, and says why.
  void expect_blind_stop(const LocalKnowledge& known, PlanReason reason, const std::string& words) {
    const auto output = replanning_.step(kNow_s, known);
    EXPECT_EQ(output.row, Row::kStopBlind);
    EXPECT_EQ(output.reason, reason);
    EXPECT_EQ(output.message, words);
    EXPECT_FALSE(output.lease);
    EXPECT_FALSE(output.scene);
    ASSERT_TRUE(output.proposal);
    EXPECT_TRUE(output.proposal->emergency);
  }

  const Motion drive_ = straight_drive(kNow_s - 3.0, {0.0, 0.0}, 0.0, 8.0, 0.9, 0.5);
  LocalScene scene_ = scene_of(free_grid({-2.0, -3.0}, {12.0, 3.0}));
  LocalReplanning replanning_{
      rover(),
      ParameterTable::from_schema("config/local_replanner.yaml"),
      1e6,
      {"/ugv1/map", "/ugv1/fleet/trajectories", "/ugv1/predicted_obstacles"}};
};

TEST_F(LocalReplanningTest, RenewsTheLeaseOfTheMotionInForce) {
  const auto output = replanning_.step(kNow_s, all_known());
  ASSERT_TRUE(output.lease);
  EXPECT_EQ(output.lease->id, (MotionId{2, 3}));
  EXPECT_DOUBLE_EQ(output.lease->end_s, kNow_s + 0.5);
  EXPECT_TRUE(output.scene);
}

TEST_F(LocalReplanningTest, StopsWithoutAPose) {
  LocalKnowledge known = all_known();
  known.measured.reset();
  known.no_pose = "no odometry";
  expect_blind_stop(known, PlanReason::kNoPose, "no odometry");
}

TEST_F(LocalReplanningTest, StopsWithoutAMap) {
  LocalKnowledge known = all_known();
  known.map_age_s = LocalKnowledge::kNever_s;
  expect_blind_stop(known, PlanReason::kNoMap, "map: none on /ugv1/map yet");
}

TEST_F(LocalReplanningTest, StopsOnAnOldMap) {
  LocalKnowledge known = all_known();
  known.map_age_s = 1.25;
  expect_blind_stop(known, PlanReason::kNoMap, "map: the newest on /ugv1/map is 1.25 s old");
}

/// A dead perception makes neither maps nor predictions: the older lack is not hidden by the newer.
TEST_F(LocalReplanningTest, NamesAllThatIsMissing) {
  LocalKnowledge known = all_known();
  known.map_age_s = known.prediction_age_s = 1.25;
  expect_blind_stop(known, PlanReason::kNoMap,
                    "map: the newest on /ugv1/map is 1.25 s old; people: no usable word from "
                    "perception on /ugv1/predicted_obstacles for more than 0.50 s");
}

TEST_F(LocalReplanningTest, StopsWithoutWordOfTheFleet) {
  LocalKnowledge known = all_known();
  known.fleet_age_s = 1.21;
  expect_blind_stop(known, PlanReason::kBraking,
                    "fleet: no word from trajectory_broadcaster on /ugv1/fleet/trajectories for "
                    "more than 1.20 s");
}

TEST_F(LocalReplanningTest, StopsWithoutPredictions) {
  LocalKnowledge known = all_known();
  known.prediction_age_s = LocalKnowledge::kNever_s;
  expect_blind_stop(known, PlanReason::kBraking,
                    "people: no usable word from perception on /ugv1/predicted_obstacles for more "
                    "than 0.50 s");
}

TEST_F(LocalReplanningTest, StopsWhereASensorLies) {
  LocalKnowledge known = all_known();
  known.sensor_fault = "the scan is frozen";
  expect_blind_stop(known, PlanReason::kBraking, "sensors: the scan is frozen");
}

TEST_F(LocalReplanningTest, AnEmergencyStopComesFirst) {
  LocalKnowledge known = all_known();
  known.stop = "the button";
  known.map_age_s = LocalKnowledge::kNever_s;
  const auto stopped = replanning_.step(kNow_s, known);
  EXPECT_EQ(stopped.row, Row::kEmergencyStop);
  EXPECT_EQ(stopped.reason, PlanReason::kEmergencyStop);
  EXPECT_EQ(stopped.message, "the button");
  EXPECT_TRUE(stopped.proposal);
  EXPECT_FALSE(stopped.lease);
  known.measured.reset();
  known.no_pose = "no odometry";
  const auto blind = replanning_.step(kNow_s, known);
  EXPECT_EQ(blind.message, "the button; no odometry");
  EXPECT_FALSE(blind.proposal);
}

TEST_F(LocalReplanningTest, AStepIsDueAtOnceWhereThePromiseIsBreached) {
  EXPECT_FALSE(replanning_.step_is_due());
  replanning_.hear({Answer::Kind::kSettled, 3, ""});
  replanning_.hear({Answer::Kind::kRefused, 4, "too late"});
  EXPECT_FALSE(replanning_.step_is_due());
  replanning_.hear({Answer::Kind::kBreached, 3, "meets ugv2"});
  EXPECT_TRUE(replanning_.step_is_due());
  replanning_.step(kNow_s, all_known());
  EXPECT_FALSE(replanning_.step_is_due());
}

TEST_F(LocalReplanningTest, AStepIsDueAtOnceWhereThereIsNothingToDriveTo) {
  replanning_.set_plan(drive_);
  EXPECT_FALSE(replanning_.step_is_due());
  replanning_.set_plan(Motion());
  EXPECT_TRUE(replanning_.step_is_due());
  const auto output = replanning_.step(kNow_s, all_known());
  EXPECT_EQ(output.row, Row::kStop);
  EXPECT_TRUE(output.proposal);
  EXPECT_FALSE(replanning_.step_is_due());
}

TEST_F(LocalReplanningTest, CountsRefusalsAndRemembersTheLast) {
  replanning_.hear({Answer::Kind::kRefused, 4, "too late"});
  replanning_.hear({Answer::Kind::kRefused, 5, "meets ugv2"});
  EXPECT_EQ(replanning_.refused(), 2);
  EXPECT_EQ(replanning_.refusal(), "meets ugv2");
}

}  // namespace
}  // namespace mocha
