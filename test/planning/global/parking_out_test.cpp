#include "planning/global/parking_out.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "planning/candidates/path_drive.h"
#include "planning/global/global_planner.h"
#include "planning/worlds.h"
#include "safety/certificate.h"
#include "safety/certifier.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.7e9;
constexpr double kWall_m = 0.0;  // solid below
const Vector2 kGoal{3.0, 3.0};

RobotModel own() {
  RobotModel robot = rover();
  robot.footprint = Footprint::rectangle(0.9, 0.6);
  return robot;
}

RobotModel model(const std::string& name) {
  return name == "own" ? own() : load_robot_model("config", name);
}

class ParkingOut : public ::testing::TestWithParam<std::string> {
 protected:
  ParkingOut() { fill_box(grid_, {-6.0, -1.0}, {6.0, kWall_m}); }

  /// The body so far from the wall.
  Pose beside_wall(double yaw_rad, double gap_m) const {
    double below_m = 0.0;
    for (const Vector2& corner : robot_.footprint.corners())
      below_m = std::max(below_m, -turned(corner, {std::cos(yaw_rad), std::sin(yaw_rad)}).y());
    return {{0.0, kWall_m + below_m + gap_m}, yaw_rad};
  }

  PlanQuery from(const Pose& pose) const {
    PlanQuery query;
    query.start_time_s = kStart_s;
    query.committed = standing(kStart_s - 1.0, pose.position, pose.yaw_rad);
    query.goal = kGoal;
    return query;
  }

  void expect_leaves(const Pose& pose, const std::string& name) const {
    const PlanningScene scene{static_map_of(grid_), {}};
    const PlanResult result = planner_.plan(from(pose), scene);
    ASSERT_EQ(result.reason, PlanReason::kSolved) << name << ": " << result.message;
    const Motion& motion = result.motion;
    EXPECT_LT((motion.at(kStart_s).pose.position - pose.position).norm(), 1e-6) << name;
    EXPECT_LT((motion.end_pose().position - kGoal).norm(), 1e-6) << name;
    EXPECT_FALSE(check_limits(motion, robot_.limits, kStart_s)) << name;
    const double kept_m =
        std::min(true_gap_m(pose), MarginBudget::of(robot_).static_margin().still_m);
    for (double t = kStart_s; t < motion.end_time(); t += 0.02) {
      ASSERT_GE(true_gap_m(motion.at(t).pose), kept_m - 0.012)
          << name << " at " << t - kStart_s << " s";
    }
  }

  PlanResult plan_seeing(const Pose& pose, const OccupancyGrid& seen) const {
    const PlanningScene scene{static_map_of(grid_), {}, [&] { return unseen_field(seen); }};
    return planner_.plan(from(pose), scene);
  }

  /// Between the true body and the true walls.
  double true_gap_m(const Pose& pose) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const Vector2& corner : robot_.footprint.corners()) {
      const Vector2 place =
          pose.position + turned(corner, {std::cos(pose.yaw_rad), std::sin(pose.yaw_rad)});
      least_m = std::min({least_m, place.y() - kWall_m, place.x() - left_wall_m_});
    }
    return least_m;
  }

  const RobotModel robot_ = model(GetParam());
  const GlobalPlanner planner_{robot_, default_options()};
  OccupancyGrid grid_ = free_grid({-6.0, -1.0}, {6.0, 6.0});
  double left_wall_m_ = -std::numeric_limits<double>::infinity();  // solid beyond
};

// So close and along a wall, hardly anything is left of the gap but what the cover takes.
bool is_too_close(double gap_m, int heading) { return gap_m < 0.03 && heading % 12 == 0; }

TEST_P(ParkingOut, HeadingsLeaveAWall) {
  for (const double gap_m : {0.02, 0.05, 0.1, 0.15, 0.25}) {
    for (int i = 0; i < 24; ++i) {
      if (is_too_close(gap_m, i)) continue;
      const std::string name = std::to_string(gap_m) + " m, " + std::to_string(15 * i) + " degrees";
      expect_leaves(beside_wall(i * M_PI / 12.0, gap_m), name);
    }
  }
}

TEST_P(ParkingOut, HeadingsLeaveACorner) {
  for (const double gap_m : {0.05, 0.1}) {
    for (int i = 0; i < 24; ++i) {
      const Pose pose = beside_wall(i * M_PI / 12.0, gap_m);
      double left_m = 0.0;
      const Vector2 ahead(std::cos(pose.yaw_rad), std::sin(pose.yaw_rad));
      for (const Vector2& corner : robot_.footprint.corners())
        left_m = std::max(left_m, -turned(corner, ahead).x());
      OccupancyGrid walls = grid_;
      left_wall_m_ = -std::ceil((left_m + gap_m) / 0.05) * 0.05;
      fill_box(grid_, {-6.0, -1.0}, {left_wall_m_, 6.0});
      expect_leaves({{0.0, pose.position.y()}, pose.yaw_rad},
                    std::to_string(gap_m) + " m, " + std::to_string(15 * i) + " degrees");
      grid_ = walls;
    }
  }
}

TEST_P(ParkingOut, SetsOffOverGroundThatWasSeen) {
  // Nose to the wall: it has to back off before it can turn.
  const Pose pose = beside_wall(-0.5 * M_PI, 0.04);
  const double tail_m = 2.0 * pose.position.y() - 0.04;
  const double margin_m = MarginBudget::of(robot_).static_margin().still_m;
  const auto plan_seeing_up_to = [&](double seen_m) {
    OccupancyGrid seen = grid_;
    fill_box(seen, {-6.0, seen_m}, {6.0, 6.0}, OccupancyGrid::kUnknown);
    return plan_seeing(pose, seen);
  };
  const PlanResult blind = plan_seeing_up_to(tail_m + margin_m + 0.01);
  EXPECT_EQ(blind.reason, PlanReason::kNotCertified) << blind.message;
  EXPECT_EQ(blind.violation.term, ViolatedTerm::kUnseenSpace) << blind.message;
  const double turning_m = 2.0 * robot_.footprint.circumscribed_radius_m() + 2.0 * margin_m + 0.1;
  const PlanResult seeing = plan_seeing_up_to(turning_m);
  EXPECT_EQ(seeing.reason, PlanReason::kSolved) << seeing.message;
}

TEST_P(ParkingOut, TurnsOverGroundThatWasSeen) {
  // Where it stands, its tail would swing over unseen ground half way round.
  constexpr double kSeen_m = -0.4;
  const SpeedMargin margin = MarginBudget::of(robot_).static_margin();
  Pose pose = beside_wall(-0.5 * M_PI, 1.5);
  pose.position.x() = kSeen_m + robot_.footprint.circumscribed_radius_m() + margin.still_m - 0.01;
  OccupancyGrid seen = grid_;
  fill_box(seen, {-6.0, -1.0}, {kSeen_m, 6.0}, OccupancyGrid::kUnknown);
  const PlanResult result = plan_seeing(pose, seen);
  ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
  double turned_s = kStart_s;
  for (const Phase& phase : result.motion.phases()) {
    turned_s += duration_s(phase);
    if (std::holds_alternative<TurnPhase>(phase)) break;
  }
  const Violation unseen = check_clearance(result.motion, robot_.footprint, *unseen_field(seen),
                                           margin, kStart_s, turned_s);
  EXPECT_FALSE(unseen) << unseen.value << " m";
}

INSTANTIATE_TEST_SUITE_P(Models, ParkingOut, ::testing::Values("jackal", "waveshare_rover", "own"),
                         [](const auto& model) { return model.param; });

/// Closed at its end, and too narrow for the longest robot to turn in.
TEST_P(ParkingOut, BacksOutOfALongCorridor) {
  constexpr double kLength_m = 20.0;
  OccupancyGrid grid = free_grid({-3.0, -3.0}, {kLength_m + 1.0, 3.0});
  fill_box(grid, {0.0, 0.475}, {kLength_m + 0.2, 3.0});
  fill_box(grid, {0.0, -3.0}, {kLength_m + 0.2, -0.475});
  fill_box(grid, {kLength_m, -0.5}, {kLength_m + 0.2, 0.5});
  PlanQuery query = from({{kLength_m - 0.8, 0.0}, 0.0});
  query.goal = {-2.0, 2.0};
  const PlanningScene scene{static_map_of(grid), {}};
  const PlanResult result = planner_.plan(query, scene);
  ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
  EXPECT_LT((result.motion.end_pose().position - query.goal).norm(), 1e-6);
  EXPECT_LT(result.motion.length_m(), kLength_m + 5.0);
}

TEST(PathDrive, DrivesAPathAsItIs) {
  const std::vector<Vector2> path = {{0.0, 0.0}, {0.4, 0.0}, {0.8, 0.1}, {1.2, 0.3}};
  MotionLimits slow = rover().limits;
  slow.max_speed = 0.3;
  const auto drive = drive_along(
      path, {1, Vector2::UnitX(), Vector2(2.0, 1.0).normalized(), 0.1, slow}, rover().limits);
  ASSERT_TRUE(drive);
  const Motion motion(0.0, {*drive});
  EXPECT_LT((motion.end_pose().position - path.back()).norm(), 1e-9);
  for (double t = 0.0; t < motion.end_time(); t += 0.01) {
    EXPECT_LE(motion.velocity(t).norm(), 0.3 + 1e-3);
    double off_m = 1.0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      const Vector2 near = nearest_on_segment(motion.position(t), path[i], path[i + 1]);
      off_m = std::min(off_m, (motion.position(t) - near).norm());
    }
    EXPECT_LT(off_m, 0.02);
  }
}

}  // namespace
}  // namespace mocha
