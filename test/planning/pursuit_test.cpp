#include "planning/pursuit.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

using Ending = Pursuit::Ending;

constexpr double kPeriod_s = 0.05;
constexpr double kAcceleration = 0.5;
constexpr double kLength_m = 6.0;

PursuitRules rules() {
  return PursuitRules::from(ParameterTable::from_schema("config/global_planner.yaml"));
}

/// A robot that stands, or is where its plan says, and a planner that finds what it is told to.
class PursuitTest : public ::testing::Test {
 protected:
  PursuitTest() { pursuit_.take({Goal{{kLength_m, 0.0}, std::nullopt}}, now_s_); }

  PlanResult answer(const PlanQuery& query) {
    asked_.push_back(query);
    PlanResult result;
    result.reason = reason_;
    result.goal = goal_.value_or(query.goal);
    const Pose from = query.committed.at(query.start_time_s).pose;
    if (reason_ == PlanReason::kSolved) {
      const Vector2 along = result.goal - from.position;
      result.motion =
          straight_drive(query.start_time_s, from.position, std::atan2(along.y(), along.x()),
                         along.norm(), speed_, kAcceleration);
    } else if (reason_ == PlanReason::kBackingOut) {
      result.motion = Motion(query.start_time_s, {StandPhase{from, 2.0}});
    }
    return result;
  }

  Pursuit::Output step() {
    now_s_ += kPeriod_s;
    state_.stamp_s = now_s_;
    return pursuit_.step(now_s_, state_, committed_,
                         {[this](const PlanQuery& query) { return answer(query); },
                          [this](const std::vector<Vector2>&) { return scene_; }});
  }

  /// The last step of so many that said anything; the number of plans asked for is in asked_.
  Pursuit::Output run(double time_s) {
    Pursuit::Output last;
    asked_.clear();
    said_.clear();
    for (const double end_s = now_s_ + time_s; now_s_ < end_s - 1e-6;) {
      Pursuit::Output output = step();
      if (output.request) said_.push_back(*output.request);
      if (output.planned || output.ending != Ending::kNone) last = std::move(output);
    }
    return last;
  }

  double now_s_ = 1.7e9;
  Pursuit pursuit_{rules(), kAcceleration,
                   RightOfWay({false, 0, "ugv5"}, rover(), default_rules())};
  PlanningScene scene_{terrain_of(free_grid({-5.0, -5.0}, {12.0, 5.0})), {}};
  RobotState state_;
  Motion committed_ = standing(now_s_, {0.0, 0.0}, 0.0);
  PlanReason reason_ = PlanReason::kSolved;
  std::optional<Vector2> goal_;  // where the plan leads instead
  double speed_ = 0.8;
  std::vector<PlanQuery> asked_;
  std::vector<WayRequest> said_;

  void stand_ahead(const std::string& name) {
    scene_.peers = {std::make_shared<PeerObstacle>(
        name, std::make_shared<const Motion>(standing(now_s_ - 5.0, {1.0, 0.0}, 0.0)), 0.3)};
  }

  /// Somebody asks for a way, now and for the time of a run of `time_s`.
  Pursuit::Output run_while_asked(const WayRequest& request, double time_s) {
    Pursuit::Output last;
    std::vector<PlanQuery> asked;
    std::vector<WayRequest> said;
    for (const double end_s = now_s_ + time_s; now_s_ < end_s - 1e-6;) {
      pursuit_.hear(request, now_s_);
      Pursuit::Output output = run(0.5);
      if (output.planned || output.ending != Ending::kNone) last = std::move(output);
      asked.insert(asked.end(), asked_.begin(), asked_.end());
      said.insert(said.end(), said_.begin(), said_.end());
    }
    asked_ = asked;
    said_ = said;
    return last;
  }

  static WayRequest way_of(const std::string& agent, std::vector<Vector2> way) {
    return {agent, 1, {false, 0, agent}, 0.3, 1.0, std::move(way)};
  }
};

TEST_F(PursuitTest, PlansAtOnceAndIsDoneWhereTheGoalIsReached) {
  const Pursuit::Output first = step();
  ASSERT_TRUE(first.planned);
  ASSERT_FALSE(first.plan.empty());
  EXPECT_DOUBLE_EQ(first.plan.start_time(), now_s_ + rules().planning_time_s);
  EXPECT_TRUE(asked_[0].driven.empty());
  state_.pose.position = {kLength_m, 0.1};
  EXPECT_EQ(step().ending, Ending::kReached);
  EXPECT_TRUE(pursuit_.idle());
  run(5.0);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(PursuitTest, SaysWhatIsMissing) {
  const auto no_map = pursuit_.step(now_s_, state_, committed_, {});
  ASSERT_TRUE(no_map.report);
  EXPECT_EQ(no_map.report->reason, PlanReason::kNoMap);
  committed_ = Motion();
  const auto no_motion = step();
  ASSERT_TRUE(no_motion.report);
  EXPECT_EQ(no_motion.report->reason, PlanReason::kNoPose);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(PursuitTest, ReplacesAPlanOnlyByOneThatIsMuchBetter) {
  speed_ = 0.3;
  step();
  const double end_s = pursuit_.plan().end_time();
  EXPECT_TRUE(run(3.0).plan.empty());  // as fast, but later
  EXPECT_EQ(asked_.size(), 3u);
  EXPECT_DOUBLE_EQ(asked_[0].driven.end_time(), end_s);
  EXPECT_DOUBLE_EQ(pursuit_.plan().end_time(), end_s);
  speed_ = 0.8;
  EXPECT_FALSE(run(1.0).plan.empty());
  EXPECT_LT(pursuit_.plan().end_time(), end_s);
}

TEST_F(PursuitTest, AFailureToImproveIsNoNews) {
  step();
  reason_ = PlanReason::kNotCertified;
  const auto output = run(1.0);
  ASSERT_TRUE(output.planned);
  EXPECT_FALSE(output.report);
  EXPECT_FALSE(pursuit_.plan().empty());
}

TEST_F(PursuitTest, AnswersARequestAtOnceButNoMoreOftenThanItCanPlan) {
  step();
  run(0.3);
  pursuit_.request();
  const auto asked = step();
  ASSERT_TRUE(asked.planned);
  EXPECT_FALSE(asked.plan.empty());  // better or not
  pursuit_.request();
  run(0.15);
  EXPECT_TRUE(asked_.empty());
  run(0.05);
  EXPECT_EQ(asked_.size(), 1u);
}

TEST_F(PursuitTest, PlansFromTheEndOfARetreat) {
  reason_ = PlanReason::kBackingOut;
  const auto retreat = step();
  ASSERT_FALSE(retreat.plan.empty());
  reason_ = PlanReason::kSolved;
  committed_ = retreat.plan;
  run(1.95);  // the retreat ends 2.5 s after it was planned
  EXPECT_TRUE(asked_.empty());
  EXPECT_FALSE(run(0.1).plan.empty());
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_GE(asked_[0].start_time_s, retreat.plan.end_time() - 1e-6);
  EXPECT_TRUE(asked_[0].driven.empty());
}

TEST_F(PursuitTest, GivesUpAGoalThatStaysOccupied) {
  reason_ = PlanReason::kGoalOccupied;
  committed_ = straight_drive(now_s_, {0.0, 0.0}, 0.0, 30.0, 0.8, kAcceleration);
  EXPECT_EQ(run(rules().occupied_goal_timeout_s - 0.5).ending, Ending::kNone);
  const auto given_up = run(1.0);
  EXPECT_EQ(given_up.ending, Ending::kGoalOccupied);
  EXPECT_TRUE(pursuit_.idle());
  ASSERT_FALSE(given_up.plan.empty());  // brakes along what it is bound to
  EXPECT_LT(given_up.plan.end_time(), now_s_ + 5.0);
}

TEST_F(PursuitTest, AGoalThatBecomesFreeIsNotGivenUp) {
  reason_ = PlanReason::kGoalOccupied;
  run(2.0);
  reason_ = PlanReason::kNoPath;
  run(2.0);
  reason_ = PlanReason::kGoalOccupied;
  EXPECT_EQ(run(2.0).ending, Ending::kNone);
}

TEST_F(PursuitTest, GivesUpWithoutProgress) {
  reason_ = PlanReason::kNoPath;
  EXPECT_EQ(run(rules().goals.timeout_s - 1.0).ending, Ending::kNone);
  EXPECT_EQ(run(2.0).ending, Ending::kNoProgress);
  EXPECT_TRUE(pursuit_.idle());
}

TEST_F(PursuitTest, FollowsASwerveThatLeadsToTheSameGoal) {
  step();
  const Motion plan = pursuit_.plan();
  pursuit_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, 3.0, 0.8, kAcceleration));
  EXPECT_DOUBLE_EQ(pursuit_.plan().end_time(), plan.end_time());
  pursuit_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, kLength_m + 0.2, 0.3, kAcceleration));
  EXPECT_GT(pursuit_.plan().end_time(), plan.end_time());
  EXPECT_FALSE(run(1.0).plan.empty());  // now the former one is much better
}

TEST_F(PursuitTest, FollowsNothingToANewGoalBeforeItIsPlannedTo) {
  pursuit_.follow(straight_drive(now_s_, {0.0, 0.0}, 0.0, kLength_m, 0.8, kAcceleration));
  EXPECT_TRUE(pursuit_.plan().empty());
}

TEST_F(PursuitTest, GoesToTheFreePlaceNearAnOccupiedGoal) {
  goal_ = Vector2(kLength_m - 0.3, 0.0);
  step();
  state_.pose.position = *goal_;
  EXPECT_EQ(step().ending, Ending::kReached);
}

/// As where a team-mate stood there when the goal was given.
TEST_F(PursuitTest, GoesToTheGoalItselfOnceThatIsFree) {
  goal_ = Vector2(kLength_m - 0.25, 0.0);
  run(0.2);
  goal_.reset();
  const double replan_s = rules().replan_period_s;
  const auto output = run(replan_s + 0.2);
  ASSERT_FALSE(output.plan.empty());
  EXPECT_NEAR(output.plan.end_pose().position.x(), kLength_m, 1e-6);
  goal_ = Vector2(kLength_m - 0.4, 0.0);  // occupied again: the plan at hand may still be driven
  EXPECT_TRUE(run(replan_s + 0.2).plan.empty());
  EXPECT_NEAR(pursuit_.plan().end_pose().position.x(), kLength_m, 1e-6);
}

TEST_F(PursuitTest, StopsAlongWhatIsInForce) {
  committed_ = long_drive(now_s_ - 4.0, 30.0);
  const Motion braking = pursuit_.stop(committed_, now_s_);
  ASSERT_FALSE(braking.empty());
  EXPECT_TRUE(pursuit_.idle());
  const double from_s = braking.start_time();
  EXPECT_NEAR(braking.at(from_s).speed, committed_.at(from_s).speed, 1e-3);
  EXPECT_LT(braking.end_time(), committed_.end_time());
  EXPECT_TRUE(pursuit_.stop(Motion(), now_s_).empty());
}

TEST_F(PursuitTest, NewRulesCountAtOnce) {
  step();
  PursuitRules faster = rules();
  faster.replan_period_s = 0.25;
  pursuit_.set_rules(faster, default_rules());
  run(1.0);
  EXPECT_EQ(asked_.size(), 4u);
}

TEST_F(PursuitTest, AsksForItsWayWhereSomebodyStandsInIt) {
  reason_ = PlanReason::kNoPath;
  stand_ahead("ugv7");
  run(1.4);
  EXPECT_TRUE(said_.empty());
  run(2.0);
  ASSERT_GE(said_.size(), 3u);
  EXPECT_EQ(said_.back().agent, "ugv5");
  EXPECT_EQ(said_.back().rank.agent, "ugv5");
  EXPECT_FALSE(said_.back().rank.stuck);
  EXPECT_NEAR(said_.back().way.front().x(), 0.0, 1e-9);
  EXPECT_NEAR(said_.back().way.back().x(), kLength_m, 1e-9);
  pursuit_.stop(committed_, now_s_);
  run(0.1);
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_TRUE(said_.front().way.empty());  // it withdraws
  run(5.0);
  EXPECT_TRUE(said_.empty());
}

TEST_F(PursuitTest, AsksNobodyWhereNobodyIsInItsWay) {
  reason_ = PlanReason::kNoPath;
  run(10.0);
  EXPECT_TRUE(said_.empty());
}

TEST_F(PursuitTest, MakesRoomForAHigherOneAndGoesOnWhenItHasPassed) {
  step();
  const WayRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  pursuit_.hear(request, now_s_);
  const auto output = run_while_asked(request, 0.5);
  ASSERT_TRUE(output.planned);
  const Vector2 refuge = output.planned->goal.position;
  EXPECT_GT(std::abs(refuge.y()), 0.8);
  EXPECT_LT(refuge.norm(), 1.5);
  EXPECT_FALSE(output.plan.empty());
  state_.pose.position = refuge;
  committed_ = standing(now_s_, refuge, 0.0);
  run_while_asked(request, 10.0);  // it plans to the goal again and again, but drives nothing
  EXPECT_GT(asked_.size(), 5u);
  EXPECT_EQ(asked_.back().goal.x(), kLength_m);
  EXPECT_TRUE(said_.empty());
  EXPECT_NEAR((pursuit_.plan().end_pose().position - refuge).norm(), 0.0, 1e-6);
  const auto after =
      run_while_asked(way_of("ugv2", {{-3.0, 0.0}, {-4.0, 0.0}}), 1.0);  // it is past
  ASSERT_FALSE(pursuit_.plan().empty());
  EXPECT_NEAR(pursuit_.plan().end_pose().position.x(), kLength_m, 1e-6);
  EXPECT_EQ(after.ending, Ending::kNone);
}

TEST_F(PursuitTest, WaitingForOthersIsNoLackOfProgress) {
  step();
  const WayRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  const Vector2 refuge = run_while_asked(request, 0.5).planned->goal.position;
  state_.pose.position = refuge;
  committed_ = standing(now_s_, refuge, 0.0);
  EXPECT_EQ(run_while_asked(request, rules().goals.timeout_s + 5.0).ending, Ending::kNone);
  EXPECT_EQ(run(0.5).ending, Ending::kNone);
}

TEST_F(PursuitTest, DoesNotMoveForALowerOne) {
  reason_ = PlanReason::kNoPath;
  stand_ahead("ugv7");
  run_while_asked(way_of("ugv7", {{1.0, 0.0}, {-4.0, 0.0}}), 3.0);
  for (const PlanQuery& query : asked_) EXPECT_EQ(query.goal.x(), kLength_m);
  EXPECT_FALSE(said_.empty());
}

TEST_F(PursuitTest, StandsStillWhereItIsInNobodysWayButWouldGetThere) {
  state_.pose.position = {0.0, 3.0};
  committed_ = standing(now_s_, {0.0, 3.0}, 0.0);
  const auto output = run_while_asked(way_of("ugv2", {{3.0, -4.0}, {3.0, 4.0}}), 2.0);
  EXPECT_TRUE(pursuit_.plan().empty());
  ASSERT_TRUE(output.report);
  EXPECT_EQ(output.report->reason, PlanReason::kPeerConflict);
  EXPECT_NE(output.report->message.find("ugv2"), std::string::npos);
  run(3.0);  // lapsed
  EXPECT_FALSE(pursuit_.plan().empty());
}

TEST_F(PursuitTest, AsksInTheNameOfWhomItMakesRoomFor) {
  step();
  reason_ = PlanReason::kNoPath;
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      if (x == 0.0 && y == 0.0) continue;
      scene_.peers.push_back(std::make_shared<PeerObstacle>(
          "ugv7", std::make_shared<const Motion>(standing(now_s_ - 5.0, {x, y}, 0.0)), 0.3));
    }
  }
  run_while_asked(way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}}), 4.0);
  ASSERT_FALSE(said_.empty());
  EXPECT_EQ(said_.back().agent, "ugv5");
  EXPECT_EQ(said_.back().rank.agent, "ugv2");
}

TEST_F(PursuitTest, LooksForAnotherRefugeWhereTheFirstIsOutOfReach) {
  step();
  const WayRequest request = way_of("ugv2", {{9.0, 0.0}, {-4.0, 0.0}});
  const Vector2 first = run_while_asked(request, 0.5).planned->goal.position;
  reason_ = PlanReason::kPeerConflict;  // somebody came in between, and stays
  scene_.peers = {std::make_shared<PeerObstacle>(
      "ugv7", std::make_shared<const Motion>(standing(now_s_ - 5.0, first, 0.0)), 0.3)};
  pursuit_.request();
  const Vector2 next = run_while_asked(request, 1.5).planned->goal.position;
  EXPECT_GT((next - first).norm(), 0.5);
  EXPECT_GT(std::abs(next.y()), 0.8);
}

TEST_F(PursuitTest, WhoCannotGetOutOfTheWaySaysSo) {
  OccupancyGrid grid = free_grid({-0.6, -0.6}, {12.0, 0.6});  // a dead end, the way out ahead
  scene_.terrain = terrain_of(grid);
  step();
  reason_ = PlanReason::kNoPath;
  stand_ahead("ugv2");
  run_while_asked(way_of("ugv2", {{9.0, 0.0}, {-0.3, 0.0}}), 4.0);
  ASSERT_FALSE(said_.empty());
  EXPECT_TRUE(said_.back().rank.stuck);
  EXPECT_EQ(said_.back().rank.agent, "ugv5");
  EXPECT_NEAR(said_.back().way.back().x(), kLength_m, 1e-9);
}

TEST_F(PursuitTest, MakesRoomWhereItIsParkedButNotWhereItWasToldToStop) {
  state_.pose.position = {kLength_m, 0.0};
  committed_ = standing(now_s_, {kLength_m, 0.0}, 0.0);
  ASSERT_EQ(step().ending, Ending::kReached);
  const WayRequest request = way_of("ugv9", {{9.0, 0.0}, {-4.0, 0.0}});
  const auto output = run_while_asked(request, 1.0);
  ASSERT_TRUE(output.planned);
  EXPECT_EQ(output.ending, Ending::kNone);
  const Vector2 refuge = output.planned->goal.position;
  EXPECT_GT(std::abs(refuge.y()), 0.8);
  state_.pose.position = refuge;
  run_while_asked(request, 3.0);
  EXPECT_TRUE(asked_.empty());  // it stays there
  pursuit_.stop(committed_, now_s_);
  state_.pose.position = {kLength_m, 0.0};
  run_while_asked(request, 3.0);
  EXPECT_TRUE(asked_.empty());
}

TEST_F(PursuitTest, ForgetsItsGoalsWhereSomethingElseStopsIt) {
  run(1.0);
  pursuit_.drop();
  EXPECT_TRUE(pursuit_.idle());
  EXPECT_TRUE(pursuit_.plan().empty());
  const WayRequest request = way_of("ugv9", {{9.0, 0.0}, {-4.0, 0.0}});
  EXPECT_TRUE(run_while_asked(request, 3.0).plan.empty());
  EXPECT_TRUE(asked_.empty());
  pursuit_.take({Goal{{0.0, 0.0}, std::nullopt}}, now_s_);
  ASSERT_EQ(step().ending, Ending::kReached);  // and is parked there
  pursuit_.drop();
  EXPECT_TRUE(run_while_asked(request, 3.0).plan.empty()) << "makes room";
  EXPECT_TRUE(asked_.empty());
}

}  // namespace
}  // namespace mocha
