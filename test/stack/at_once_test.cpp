// How soon one robot stops or turns back, through its whole stack and with the real protocol.
#include <gtest/gtest.h>

#include <functional>

#include "fleet/protocol/commitment_protocol.h"
#include "planning/worlds.h"
#include "stack/robot_stack.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kTick_s = 0.01;
constexpr double kAtOnce_s = 0.15;  // until it brakes: an emergency's time, and a few ticks

ParameterTable schema(const std::string& node) {
  return ParameterTable::from_schema("config/" + node + ".yaml");
}

/// A robot with a perfect tracker in a hall, whose nodes run as often as config/ says.
class OneRobot {
 public:
  explicit OneRobot(const RobotModel& robot)
      : robot_(robot),
        reach_(Reach::from(schema("trajectory_broadcaster"), robot,
                           schema("local_replanner").number("horizon"))),
        protocol_(
            CommitmentOptions::from(schema("trajectory_broadcaster"), robot, reach_, "ugv1", 1)),
        stack_("ugv1", robot, {schema("global_planner"), schema("local_replanner"), reach_},
               protocol_) {
    run(3.0);  // listens first
  }

  RobotStack& stack() { return stack_; }
  double now_s() const { return 1.7e9 + kTick_s * ticks_; }

  RobotState state() const {
    if (stack_.committed().empty()) return {now_s(), {}, {0.0, 0.0}};
    const MotionState at = stack_.committed().at(now_s());
    return {now_s(), at.pose, {at.speed, at.yaw_rate}};
  }

  void go_to(const Vector2& goal) { stack_.take({Goal{goal, std::nullopt}}, now_s()); }

  /// Seconds until it is so; all of the limit where it never is.
  double run_until(const std::function<bool()>& is_so, double limit_s) {
    const double begin_s = now_s();
    while (now_s() < begin_s + limit_s && !is_so()) tick();
    return now_s() - begin_s;
  }
  void run(double time_s) {
    run_until([] { return false; }, time_s);
  }

  /// Drives along x until it is that fast.
  void reach_speed(double speed) {
    go_to({18.0, 0.0});
    run_until([&] { return state().twist.speed >= speed; }, 10.0);
    ASSERT_GE(state().twist.speed, speed);
  }

  /// From here to where it rests if it brakes along its promise after so long.
  double stopping_m(double after_s) const {
    const Motion& committed = stack_.committed();
    const Motion stop = with_brake(committed, now_s(), now_s() + after_s, robot_.braking());
    return distance_m(stop.end_pose().position);
  }

  double distance_m(const Vector2& place) const { return (state().pose.position - place).norm(); }

 private:
  void tick() {
    ++ticks_;
    stack_.tick(now_s());
    if (ticks_ % 5 == 0) stack_.pursue(now_s(), state(), {scene_.static_map, {}});
    if (ticks_ % 10 == 3 || stack_.step_is_due()) stack_.replan(now_s(), state(), scene());
  }

  LocalScene scene() const {
    LocalScene scene = scene_;
    scene.predicted_until_s = now_s();
    return scene;
  }

  const RobotModel robot_;
  const LocalScene scene_ = scene_of(free_grid({-8.0, -4.0}, {20.0, 4.0}));
  const Reach reach_;
  CommitmentProtocol protocol_;
  RobotStack stack_;
  int ticks_ = 0;
};

class AtOnce : public ::testing::Test {
 protected:
  /// Where a stop is asked for: what it takes until it rests.
  void expect_stop(OneRobot& robot, double limit_s) {
    const double allowed_m = robot.stopping_m(kAtOnce_s);
    const Vector2 place = robot.state().pose.position;
    const double took_s = robot.run_until([&] { return stands(robot.state()); }, 10.0);
    robot.run(5.0);
    RecordProperty("rests after [ms]", static_cast<int>(1e3 * took_s));
    RecordProperty("rests after [mm]", static_cast<int>(1e3 * robot.distance_m(place)));
    EXPECT_LT(took_s, limit_s);
    EXPECT_LT(robot.distance_m(place), allowed_m);
    EXPECT_TRUE(stands(robot.state()));
  }

  const RobotModel jackal_ = jackal();
};

TEST_F(AtOnce, ACancelAtSpeed) {
  OneRobot robot(jackal_);
  robot.reach_speed(1.46);
  robot.stack().stop();
  expect_stop(robot, 1.3);
  EXPECT_TRUE(robot.stack().idle());
}

TEST_F(AtOnce, ACancelWhileItCruises) {
  RobotModel slower = jackal_;
  slower.limits.max_speed = 1.46;
  OneRobot robot(slower);
  robot.reach_speed(1.4);
  robot.run(1.0);
  robot.stack().stop();
  expect_stop(robot, 1.3);
}

TEST_F(AtOnce, ACancelAnyTimeAfterAGoalIsGivenToAStandingRobot) {
  for (double after_s = 0.0; after_s < 0.8; after_s += 0.03) {
    OneRobot robot(jackal_);
    const Vector2 place = robot.state().pose.position;
    robot.go_to({9.0, 1.0});
    robot.run(after_s);
    const bool stood = robot.state().twist.speed == 0.0;
    const double allowed_m = stood ? 0.0 : robot.distance_m(place) + robot.stopping_m(kAtOnce_s);
    robot.stack().stop();
    robot.run(3.0);
    EXPECT_LE(robot.distance_m(place), allowed_m + 1e-4) << after_s;
    EXPECT_TRUE(stands(robot.state())) << after_s;
  }
}

TEST_F(AtOnce, AGoalBehind) {
  OneRobot robot(jackal_);
  robot.reach_speed(1.46);
  const Vector2 place = robot.state().pose.position;
  const double allowed_m = robot.stopping_m(kAtOnce_s + 0.05);  // a step of the planner
  robot.go_to(place - Vector2(6.0, 0.0));
  double farthest_m = 0.0;
  const double took_s = robot.run_until(
      [&] {
        farthest_m = std::max(farthest_m, robot.distance_m(place));
        const UnicycleState twist = robot.state().twist;
        return twist.speed < 0.0 || (std::abs(twist.yaw_rate) > 0.1 && twist.speed < 0.1);
      },
      5.0);
  RecordProperty("turns back after [ms]", static_cast<int>(1e3 * took_s));
  RecordProperty("turns back after [mm]", static_cast<int>(1e3 * farthest_m));
  EXPECT_LT(took_s, 1.5);
  EXPECT_LT(farthest_m, allowed_m);
  robot.run_until([&] { return robot.stack().idle(); }, 30.0);
  EXPECT_LT(robot.distance_m(place - Vector2(6.0, 0.0)), 0.15);
}

TEST_F(AtOnce, AGoalAheadIsBentToWithoutAStop) {
  OneRobot robot(jackal_);
  robot.reach_speed(1.46);
  robot.go_to(robot.state().pose.position + Vector2(7.0, 2.0));
  double slowest = 9.0;
  robot.run_until(
      [&] {
        slowest = std::min(slowest, robot.state().twist.speed);
        return robot.state().pose.position.y() > 0.5;
      },
      10.0);
  EXPECT_GT(slowest, 0.7);
}

TEST_F(AtOnce, AnotherGoalForARobotThatIsAboutToSetOff) {
  for (double after_s = 0.0; after_s < 0.5; after_s += 0.05) {
    OneRobot robot(jackal_);
    robot.go_to({9.0, 0.0});
    robot.run(after_s);
    robot.go_to({-6.0, 0.0});
    double farthest_m = 0.0;
    robot.run_until(
        [&] {
          farthest_m = std::max(farthest_m, robot.state().pose.position.x());
          return robot.state().pose.position.x() < -1.0;
        },
        10.0);
    EXPECT_LT(farthest_m, after_s < 0.4 ? 0.01 : 0.15) << after_s;
    EXPECT_LT(robot.state().pose.position.x(), -0.9) << after_s;
  }
}

TEST_F(AtOnce, APauseAndItsEnd) {
  OneRobot robot(jackal_);
  robot.reach_speed(1.46);
  robot.stack().pause();
  expect_stop(robot, 1.3);
  EXPECT_FALSE(robot.stack().idle());
  robot.stack().resume();
  robot.run_until([&] { return robot.stack().idle(); }, 30.0);
  EXPECT_LT(robot.distance_m({18.0, 0.0}), 0.15);
}

}  // namespace
}  // namespace mocha
