// Plans along the way of an order of passing, by team-mates that stay where they come to rest.
#include <gtest/gtest.h>

#include "planning/global/global_planner.h"
#include "planning/worlds.h"
#include "safety/requirement.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;

class InTurnPlansTest : public ::testing::Test {
 protected:
  InTurnPlansTest() {
    scene_.static_map = static_map_of(free_grid({-3.0, -3.0}, {9.0, 3.0}));
    query_.start_time_s = kNow_s;
    query_.committed = standing(kNow_s - 5.0, {0.0, 0.0}, 0.0);
    query_.along = {{0.0, 0.0}, {3.0, 0.0}, {6.0, 0.0}};
    query_.goal = {6.0, 0.0};
  }

  void add_peer(Motion motion) {
    scene_.peers.push_back(std::make_shared<PeerObstacle>(
        "ugv2", std::make_shared<const Motion>(std::move(motion)), 0.3, test::kRoverBraking));
  }

  PlanResult plan() const { return GlobalPlanner(robot_, default_options()).plan(query_, scene_); }

  /// From the centre of the last team-mate, where it rests, to the nearest place of the motion.
  double least_gap_m(const Motion& motion) const {
    const auto& peer = *scene_.peers.back();
    double least_m = 1e9;
    for (double t = motion.start_time(); t < motion.end_time(); t += 0.01)
      least_m = std::min(least_m, (motion.position(t) - peer.at(peer.rest_time()).centre).norm());
    return least_m;
  }

  const RobotModel robot_ = rover();
  const double keep_m_ = *Requirements(robot_)[RequirementName::kPromise].peer_distance_m;
  PlanningScene scene_;
  PlanQuery query_;
};

TEST_F(InTurnPlansTest, KeepAsFarFromWhoStandsBesideTheWayAsPromisesDo) {
  for (const double beside_m : {0.02, 0.0, -0.05}) {
    scene_.peers.clear();
    add_peer(standing(kNow_s - 9.0, {3.0, 0.3 + keep_m_ + beside_m}, 0.0));
    const PlanResult result = plan();
    ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message << ", " << beside_m;
    EXPECT_GE(least_gap_m(result.motion), 0.3 + keep_m_ - 1e-3) << beside_m;
  }
}

TEST_F(InTurnPlansTest, ThereIsNoneToWhereATeamMateStands) {
  query_.along = {{0.0, 0.0}, {3.0, 0.0}};
  query_.goal = {3.0, 0.0};
  add_peer(standing(kNow_s - 9.0, {3.0, -0.1}, 0.0));
  const PlanResult result = plan();
  EXPECT_NE(result.reason, PlanReason::kSolved);
  EXPECT_TRUE(result.motion.empty());
}

TEST_F(InTurnPlansTest, WhoIsUnderWayMayHaveGoneOnLater) {
  query_.along = {{0.0, 0.0}, {3.0, 0.0}};
  query_.goal = {3.0, 0.0};
  add_peer(straight_drive(kNow_s - 1.0, {3.0, -2.0}, M_PI / 2.0, 1.9, 0.8, 0.5));
  const PlanResult result = plan();
  for (double t = kNow_s; t < std::min(kNow_s + 10.0, result.motion.end_time()); t += 0.01) {
    const Vector2 apart = result.motion.position(t) - Vector2(3.0, -0.1);
    EXPECT_GE(apart.norm(), 0.3 + keep_m_ - 1e-3);
  }
}

TEST_F(InTurnPlansTest, WhoDrivesAwayIsInNobodysWay) {
  add_peer(straight_drive(kNow_s - 1.0, {3.0, 0.0}, M_PI / 2.0, 2.5, 0.8, 0.5));
  EXPECT_EQ(plan().reason, PlanReason::kSolved);
}

TEST_F(InTurnPlansTest, ComeOutBackwardWhereTheWayLeadsBack) {
  query_.committed = standing(kNow_s - 5.0, {0.0, 0.0}, 3.0);
  const PlanResult result = plan();
  ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
  ASSERT_EQ(result.motion.phases().size(), 1u) << "no turn in place";
  EXPECT_EQ(std::get<DrivePhase>(result.motion.phases()[0]).direction, -1);
  query_.along.clear();
  EXPECT_GE(plan().motion.phases().size(), 2u) << "where nobody waits, it turns";
}

TEST_F(InTurnPlansTest, AreDrivenForwardWhereTheRobotDoesNotSeeBehind) {
  query_.committed = standing(kNow_s - 5.0, {0.0, 0.0}, 3.0);
  RobotModel looks_ahead = robot_;
  looks_ahead.lidar.field_of_view_rad = 4.7;
  RobotModel forward_only = robot_;
  forward_only.limits.can_reverse = false;
  for (const RobotModel& robot : {looks_ahead, forward_only}) {
    const PlanResult result = GlobalPlanner(robot, default_options()).plan(query_, scene_);
    ASSERT_EQ(result.reason, PlanReason::kSolved) << result.message;
    EXPECT_EQ(std::get<DrivePhase>(result.motion.phases().back()).direction, 1);
  }
}

TEST_F(InTurnPlansTest, WhoStandsCloserAlreadyCanLeave) {
  add_peer(standing(kNow_s - 9.0, {-0.6, 0.0}, 0.0));
  const PlanResult result = plan();
  EXPECT_EQ(result.reason, PlanReason::kSolved) << result.message;
}

}  // namespace
}  // namespace mocha
