#include "stack/robot_stack.h"

#include <gtest/gtest.h>

#include "fleet/protocol/motions.h"
#include "planning/late_answers.h"
#include "planning/worlds.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr Reach kAnyReach{1e6, 2.0, 1e6};

/// A rover with a perfect tracker, and peers of which the test makes what they promise.
class RobotStackTest : public ::testing::Test {
 protected:
  explicit RobotStackTest(const RobotModel& robot = rover())
      : stack_("ugv1", robot,
               {ParameterTable::from_schema("config/global_planner.yaml"),
                ParameterTable::from_schema("config/local_replanner.yaml"), kAnyReach},
               protocol_) {}

  RobotState state() const {
    if (stack_.committed().empty()) return {now_s_, {{0.0, 0.0}, 0.0}, {0.0, 0.0}};
    const MotionState at = stack_.committed().at(now_s_);
    return {now_s_, at.pose, {at.speed, at.yaw_rate}};
  }

  LocalScene scene() const {
    LocalScene scene = scene_;
    scene.predicted_until_s = now_s_;
    return scene;
  }

  void step() {
    now_s_ += 0.1;
    stack_.tick(now_s_);
    stack_.pursue(now_s_, state(), {scene_.static_map, {}});
    stack_.replan(now_s_, state(), scene());
  }

  /// Under way to a goal 9 m ahead, at full speed.
  void set_off() {
    stack_.take({Goal{{9.0, 0.0}, std::nullopt}}, now_s_);
    for (int i = 0; i < 40; ++i) step();
    ASSERT_GT(state().twist.speed, 0.5);
  }

  double now_s_ = 1.7e9;
  LocalScene scene_ = scene_of(free_grid({-2.0, -3.0}, {12.0, 3.0}));
  LateAnswers protocol_;
  RobotStack stack_;
};

RobotModel forward_rover() {
  RobotModel robot = rover();
  robot.limits.can_reverse = false;
  return robot;
}

class ForwardRobotStackTest : public RobotStackTest {
 protected:
  ForwardRobotStackTest() : RobotStackTest(forward_rover()) {}
};

TEST_F(RobotStackTest, DrivesToItsGoal) {
  set_off();
  for (int i = 0; i < 150 && !stack_.idle(); ++i) step();
  EXPECT_TRUE(stack_.idle());
  EXPECT_LT((state().pose.position - Vector2(9.0, 0.0)).norm(), 0.15);
  EXPECT_EQ(stack_.counts().lease_stops, 0);
}

TEST_F(ForwardRobotStackTest, TurnsToAGoalBehindAndNeverDrivesBackward) {
  set_off();
  stack_.take({Goal{{0.0, 0.0}, std::nullopt}}, now_s_);
  for (int i = 0; i < 300 && !stack_.idle(); ++i) {
    step();
    ASSERT_GE(state().twist.speed, 0.0);
  }
  EXPECT_LT((state().pose.position - Vector2(0.0, 0.0)).norm(), 0.15);
}

/// The newest map of the local replanner has a wall that the planner does not know of.
TEST_F(RobotStackTest, SaysWhyItsPlanIsNotDriven) {
  OccupancyGrid grid = free_grid({-2.0, -3.0}, {12.0, 3.0});
  fill_box(grid, {1.0, -3.0}, {1.2, 3.0});
  const auto map = scene_.static_map;
  scene_ = scene_of(grid);
  scene_.static_map = map;
  stack_.take({Goal{{9.0, 0.0}, std::nullopt}}, now_s_);
  std::string said;
  GoalExecutive::Ending ending = GoalExecutive::Ending::kNone;
  for (int i = 0; i < 800 && ending == GoalExecutive::Ending::kNone; ++i) {
    step();
    ending = stack_.pursued().ending;
    if (stack_.pursued().report) said = stack_.pursued().report->message;
  }
  EXPECT_EQ(ending, GoalExecutive::Ending::kNoProgress);
  EXPECT_EQ(said.find("no progress for 60 s: local replanner: clearance to obstacles"), 0u) << said;
}

TEST_F(RobotStackTest, BrakesWhereItIsNotReplannedAnyMore) {
  set_off();
  for (int i = 0; i < 30; ++i) {
    now_s_ += 0.1;
    stack_.tick(now_s_);
  }
  EXPECT_EQ(stack_.counts().lease_stops, 1);
  EXPECT_EQ(state().twist.speed, 0.0);
  EXPECT_LT(state().pose.position.x(), 6.0);
}

TEST_F(RobotStackTest, ABreachLeadsToAStepAtOnceWhichKnowsOfIt) {
  set_off();
  protocol_.breach = true;
  CommittedTrajectory across;
  across.agent = "ugv2";
  across.id = {1, 1};
  across.state = TrajectoryState::kEmergency;
  across.footprint_radius_m = 0.3;
  across.braking = test::kRoverBraking;
  const double x = state().pose.position.x() + 1.2;
  across.motion = test::shared(test::stand(now_s_, {x, 0.0}));
  stack_.hear(across, now_s_);
  ASSERT_TRUE(stack_.step_is_due());
  stack_.replan(now_s_, state(), scene());
  EXPECT_FALSE(stack_.step_is_due());
  EXPECT_TRUE(stack_.replanned().violation);
  EXPECT_TRUE(stack_.replanned().proposal);
  EXPECT_EQ(stack_.counts().breaches, 1);
}

TEST_F(RobotStackTest, GoesOnAfterItsLeaseHasEnded) {
  set_off();
  for (int i = 0; i < 10; ++i) {
    now_s_ += 0.1;
    stack_.tick(now_s_);
  }
  EXPECT_NO_THROW(step());
  for (int i = 0; i < 150 && !stack_.idle(); ++i) step();
  EXPECT_LT((state().pose.position - Vector2(9.0, 0.0)).norm(), 0.15);
}

}  // namespace
}  // namespace mocha
