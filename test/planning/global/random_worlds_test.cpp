#include <gtest/gtest.h>

#include <string>

#include "planning/global/global_planner.h"
#include "planning/worlds.h"
#include "topology/shipped_options.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kStart_s = 1.7e9;
const Vector2 kStart(0.6, 0.6);
const Vector2 kGoal(7.4, 5.4);
constexpr double kCreeping_mps = 0.1;

/// Plans through random worlds and checks whatever is called solved by the certificate itself.
class RandomWorlds : public ::testing::Test {
 protected:
  void use(const RobotModel& robot) {
    robot_ = robot;
    planner_ = std::make_unique<GlobalPlanner>(robot, default_options());
    margin_ = MarginBudget::of(robot).static_margin();
  }

  /// Is there a path on which a disc of this radius keeps the margin of the speed?
  bool has_path(const std::shared_ptr<const DistanceField>& field, const Vector2& from,
                const Vector2& to, double radius_m, double speed) const {
    TravelOptions options = shipped_travel_options();
    options.required_clearance_m = radius_m + margin_.at(speed) + 0.01;
    return find_path_on_grid(field, from, to, {}, options).outcome == GridPath::Outcome::kFound;
  }

  /// Plans and counts; what is called solved must be proved, joined and at its goal.
  PlanResult plan(const PlanQuery& query, const std::shared_ptr<const DistanceField>& field,
                  const std::string& name) {
    const PlanResult result = planner_->plan(query, {static_map_of(field), {}});
    const MotionState start = query.committed.at(query.start_time_s);
    // Narrower ones may end where the body cannot bend with them.
    const bool is_wide =
        has_path(field, start.pose.position, query.goal, half_of_body_m(), robot_.limits.max_speed);
    const bool is_narrow = !is_wide && has_path(field, start.pose.position, query.goal,
                                                half_of_body_m(), kCreeping_mps);
    paths_ += is_wide;
    narrow_ += is_narrow;
    if (result.reason != PlanReason::kSolved) {
      EXPECT_TRUE(result.motion.empty()) << name;
      EXPECT_FALSE(result.message.empty()) << name;
      return result;
    }
    solved_ += is_wide;
    narrow_solved_ += is_narrow;
    const Motion& motion = result.motion;
    const Violation limits = check_limits(motion, robot_.limits, query.start_time_s);
    EXPECT_FALSE(limits) << name << ": " << describe(limits);
    const Violation clearance =
        check_clearance(motion, robot_.footprint, *field, margin_, query.start_time_s);
    EXPECT_FALSE(clearance) << name << ": " << describe(clearance);
    EXPECT_LT((motion.end_pose().position - query.goal).norm(), 1e-6) << name;
    const MotionState joined = motion.at(query.start_time_s);
    EXPECT_LT((joined.pose.position - start.pose.position).norm(), 1e-6) << name;
    EXPECT_LT((joined.velocity - start.velocity).norm(), 1e-6) << name;
    if (start.at_rest) return result;
    EXPECT_LT((joined.acceleration - start.acceleration).norm(), 1e-5) << name;
    return result;
  }

  /// Radius of a disc that holds the front half of the body, or its rear one.
  double half_of_body_m() const {
    if (robot_.footprint.is_disc()) return robot_.footprint.inscribed_radius_m();
    const Vector2 corner = robot_.footprint.corners().front().cwiseAbs();
    return std::hypot(0.5 * corner.x(), corner.y());
  }

  PlanQuery from_standing(std::mt19937& random) const {
    PlanQuery query;
    query.start_time_s = kStart_s;
    const double yaw_rad = std::uniform_real_distribution<double>(-M_PI, M_PI)(random);
    query.committed = standing(kStart_s - 1.0, kStart, yaw_rad);
    query.goal = kGoal;
    return query;
  }

  void plan_through(int worlds, int discs, double least_share) {
    for (int seed = 1; seed <= worlds; ++seed) {
      const auto field = occupied_field(random_world(seed, discs, kStart, kGoal, 0.6));
      std::mt19937 random(seed);
      const PlanResult result = plan(from_standing(random), field, "world " + std::to_string(seed));
      const bool has_one =
          has_path(field, kStart, kGoal, robot_.footprint.inscribed_radius_m(), 0.0);
      EXPECT_EQ(result.reason == PlanReason::kNoPath, !has_one) << seed;
    }
    expect_share(worlds / 2, least_share);
  }

  void expect_share(int least_paths, double least_share) {
    RecordProperty("paths", paths_);
    RecordProperty("solved", solved_);
    RecordProperty("narrow", narrow_);
    RecordProperty("narrow_solved", narrow_solved_);
    EXPECT_GT(paths_, least_paths);
    EXPECT_GE(solved_, least_share * paths_) << solved_ << " of " << paths_;
    EXPECT_GE(narrow_solved_, 0.85 * narrow_) << narrow_solved_ << " of " << narrow_;
  }

  RobotModel robot_;
  std::unique_ptr<GlobalPlanner> planner_;
  SpeedMargin margin_ = 0.0;
  int paths_ = 0;
  int solved_ = 0;
  int narrow_ = 0;  // with a path that has to be driven slowly, where the body can bend with it
  int narrow_solved_ = 0;
};

TEST_F(RandomWorlds, RoverFindsItsWayAndItIsProved) {
  use(rover());
  plan_through(200, 26, 0.98);
}

TEST_F(RandomWorlds, JackalFindsItsWayAndItIsProved) {
  use(jackal());
  plan_through(100, 30, 0.98);
}

TEST_F(RandomWorlds, UnderWayToOtherGoals) {
  use(jackal());
  for (int seed = 1; seed <= 40; ++seed) {
    const auto field = occupied_field(random_world(seed, 22, kStart, kGoal, 0.6));
    std::mt19937 random(seed);
    const PlanQuery query = from_standing(random);
    const Motion first = planner_->plan(query, {static_map_of(field), {}}).motion;
    if (first.empty()) continue;
    std::uniform_real_distribution<double> share(0.05, 0.95);
    for (int k = 0; k < 3; ++k) {
      PlanQuery other = query;
      other.committed = first;
      const double when_s =
          first.start_time() + share(random) * (first.end_time() - first.start_time());
      other.start_time_s = first.switch_time(when_s);
      other.goal = {8.0 * share(random), 6.0 * share(random)};
      if (field->distance_bound(other.goal) < 0.6) other.goal = k == 0 ? kStart : kGoal;
      plan(other, field, "world " + std::to_string(seed));
    }
  }
  expect_share(60, 0.95);
}

}  // namespace
}  // namespace mocha
