#include "benchmarks/leaving_run.h"

#include <algorithm>
#include <cmath>

#include "benchmarks/lidar_robot.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kStanding_s = 3.0;  // it listens first, and looks about
constexpr double kLongest_s = 60.0;
constexpr double kAway_m = 0.5;
constexpr double kAtGoal_m = 0.2;
// Standing for so long after a goal, it will not leave: planning in vain takes the most time.
constexpr double kStuck_s = 10.0;

/// Since when a robot has not moved.
class StandingSince {
 public:
  StandingSince(double now_s, const Pose& pose) : since_s_(now_s), pose_(pose) {}

  double look(double now_s, const Pose& pose) {
    constexpr double kMoved_m = 0.02;
    constexpr double kMoved_rad = 0.1;
    if ((pose.position - pose_.position).norm() > kMoved_m ||
        std::abs(wrap_angle(pose.yaw_rad - pose_.yaw_rad)) > kMoved_rad) {
      since_s_ = now_s;
      pose_ = pose;
    }
    return now_s - since_s_;
  }

 private:
  double since_s_;
  Pose pose_;
};

}  // namespace

LeavingRun run_leaving(const World& world, std::uint64_t seed) {
  using Ending = GoalExecutive::Ending;
  const WorldRobot& setup = world.robots.at(0);
  LidarRobot robot(world, seed);
  const SimulatedRobot& truth = robot.truth();
  for (int i = 0; i < std::lround(kStanding_s / LidarRobot::kTick_s); ++i) robot.tick();
  const double begin_s = robot.now_s();
  robot.go_to(setup.goal->position);
  LeavingRun run;
  run.clearance_m = truth.clearance_m;
  const auto off_m = [&](const Vector2& from) {
    return (truth.vehicle.pose().position - from).norm();
  };
  StandingSince standing(begin_s, setup.start);
  while (run.took_s < kLongest_s && robot.ending() == Ending::kNone && !run.contact &&
         standing.look(robot.now_s(), truth.vehicle.pose()) < kStuck_s) {
    robot.tick();
    run.took_s = robot.now_s() - begin_s;
    run.clearance_m = std::min(run.clearance_m, truth.clearance_m);
    run.contact = truth.contacts > 0;
    if (!run.left_s && off_m(setup.start.position) > kAway_m) run.left_s = run.took_s;
  }
  run.arrived =
      robot.ending() == Ending::kReached && !run.contact && off_m(setup.goal->position) < kAtGoal_m;
  run.slowest_plan_s = robot.slowest_plan_s();
  run.words = robot.words();
  return run;
}

}  // namespace mocha
