#include "planning/local/local_planner.h"

#include <gtest/gtest.h>

#include <map>

#include "planning/worlds.h"
#include "safety/certificate.h"
#include "trajectory/rover_braking.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kNow_s = 1.7e9;
constexpr double kPerson_m = 0.25;

/// The least distance to the centre of what moves, less its radius; at 1 ms.
double sampled_gap_m(const Motion& motion, const MovingObstacle& other, double until_s) {
  double least_m = std::numeric_limits<double>::infinity();
  for (double t = motion.start_time(); t < until_s; t += 1e-3) {
    const auto disc = other.at(t);
    least_m = std::min(least_m, (motion.at(t).pose.position - disc.centre).norm() - disc.radius_m);
  }
  return least_m;
}

/// The same place, speed, acceleration and heading a moment before and after: what is left of a
/// jump is what the robot does in that moment.
void expect_same(const MotionState& a, const MotionState& b) {
  EXPECT_LT((a.pose.position - b.pose.position).norm(), 1e-4);
  EXPECT_LT((a.velocity - b.velocity).norm(), 1e-3);
  EXPECT_LT((a.acceleration - b.acceleration).norm(), 5e-3);
  EXPECT_LT(std::abs(wrap_angle(a.pose.yaw_rad - b.pose.yaw_rad)), 1e-3);
}

class LocalPlannerTest : public ::testing::Test {
 protected:
  /// On a straight plan at full speed.
  LocalQuery query() const {
    EXPECT_FALSE(check_limits(ahead_, robot_.limits, kNow_s));
    const double start_s = kNow_s + 3.0;
    return {ahead_, start_s, ahead_, start_s, Motion()};
  }
  /// Where the plan is so long after the start.
  Vector2 planned(double after_s) const {
    return ahead_.at(query().start_time_s + after_s).pose.position;
  }
  using Things = std::vector<std::shared_ptr<const MovingObstacle>>;
  /// At `place` so long after the start.
  std::shared_ptr<const MovingObstacle> person(const Vector2& place, double after_s,
                                               const Vector2& velocity) const {
    return std::make_shared<PredictedDisc>("person", query().start_time_s + after_s, place,
                                           velocity, kPerson_m, 0.0);
  }
  LocalScene scene(Things moving) const {
    LocalScene scene = local_scene(open_, nullptr);
    scene.confident = std::move(moving);
    scene.predicted_until_s = query().start_time_s + 5.0;
    return scene;
  }

  void expect_sound(const LocalPlan& plan, const LocalQuery& query, const LocalScene& scene) const {
    ASSERT_EQ(plan.reason, PlanReason::kSolved) << plan.message;
    EXPECT_EQ(plan.motion.start_time(), query.start_time_s);
    const Violation limits = check_limits(plan.motion, robot_.limits, query.start_time_s);
    EXPECT_TRUE(!limits || limits.time_s >= plan.rejoins_s) << describe(limits);
    EXPECT_EQ(plan.met, RequirementName::kDetour);
    const Requirement required =
        Requirements(robot_)[RequirementName::kDetour].from(query.start_time_s);
    for (const MovingThing& thing : kept_apart(scene, required)) {
      const double until_s = std::min(plan.rejoins_s, thing.until_s);
      EXPECT_GE(sampled_gap_m(plan.motion, *thing.obstacle, until_s), thing.keep_m - 1e-3);
    }
    for (double t = query.start_time_s; t < plan.rejoins_s; t += 0.01) {
      EXPECT_GE(scene.static_map->field().distance_bound(plan.motion.at(t).pose.position),
                robot_.footprint.circumscribed_radius_m());
    }
    expect_continuous(plan, query);
    expect_back_on_the_plan(plan, query);
    int selected = 0;
    for (const PlanCandidate& candidate : plan.candidates) selected += candidate.selected;
    EXPECT_EQ(selected, 1);
  }

  static void expect_continuous(const LocalPlan& plan, const LocalQuery& query) {
    constexpr double kMoment_s = 1e-5;
    expect_same(query.committed.at(query.start_time_s - kMoment_s),
                plan.motion.at(query.start_time_s + kMoment_s));
    if (plan.rejoins_s < plan.motion.end_time() - 1e-3) {
      expect_same(plan.motion.at(plan.rejoins_s - kMoment_s),
                  plan.motion.at(plan.rejoins_s + kMoment_s));
    }
    EXPECT_LT((plan.motion.at(plan.rejoins_s).pose.position - plan.rejoin_point.place()).norm(),
              1e-4);
  }

  /// From the rejoin point on it is the plan, later by the delay.
  static void expect_back_on_the_plan(const LocalPlan& plan, const LocalQuery& query) {
    const double shift_s = plan.delay_s + query.start_time_s - query.progress_s;
    EXPECT_NEAR(plan.motion.end_time(), query.plan.end_time() + shift_s, 1e-5);
    for (double t = plan.rejoins_s; t < plan.motion.end_time(); t += 0.02) {
      const MotionState there = plan.motion.at(t);
      const MotionState planned = query.plan.at(t - shift_s);
      EXPECT_LT((there.pose.position - planned.pose.position).norm(), 1e-5);
      EXPECT_LT((there.velocity - planned.velocity).norm(), 1e-5);
      EXPECT_LT(std::abs(wrap_angle(there.pose.yaw_rad - planned.pose.yaw_rad)), 1e-4);
    }
  }

  const RobotModel robot_ = rover();
  const double keep_m_ = robot_.footprint.circumscribed_radius_m() +
                         MarginBudget::of(robot_).own_margin_m() + robot_.moving_clearance_m;
  const LocalOptions options_ = default_local_options();
  const LocalPlanner planner_{robot_, options_};
  const OccupancyGrid grid_ = free_grid({-2.0, -5.0}, {16.0, 5.0});
  const std::shared_ptr<const StaticMap> open_ = static_map_of(grid_);
  const Motion ahead_ = long_drive(kNow_s, 14.0);
};

TEST_F(LocalPlannerTest, LeavesThePlanForAPersonWhoCrossesAndComesBack) {
  for (const double speed : {0.3, 0.7, 1.2}) {
    for (const double meets_s : {1.8, 2.5, 3.5}) {
      const LocalScene around =
          scene({person(planned(meets_s), meets_s, speed * Vector2(0.2, 1.0))});
      ASSERT_LT(sampled_gap_m(ahead_, *around.confident[0], kNow_s + 9.0), keep_m_);
      SCOPED_TRACE(testing::Message() << speed << " m/s, meets after " << meets_s << " s");
      expect_sound(planner_.plan(query(), around), query(), around);
    }
  }
}

TEST_F(LocalPlannerTest, OutOfATurnOfThePlanToo) {
  // A quarter of a circle, driven at 0.7 m/s.
  PlanarMinco::State start;
  PlanarMinco::State end;
  start << Vector2(0.0, 0.0), Vector2::Zero(), Vector2(0.4, 0.0);
  end << Vector2(5.0, 5.0), Vector2::Zero(), Vector2(0.0, -0.4);
  PlanarMinco::Knots knots(2, 7);
  for (int i = 0; i < 7; ++i) {
    const double angle = (i + 1) / 8.0 * M_PI / 2.0;
    knots.col(i) = Vector2(5.0 * std::sin(angle), 5.0 - 5.0 * std::cos(angle));
  }
  PlanarMinco minco;
  minco.resize(8);
  Eigen::VectorXd durations = Eigen::VectorXd::Constant(8, 1.4);
  durations[0] = durations[7] = 2.2;
  minco.solve(start, end, knots, durations);
  const Motion bend(kNow_s, {DrivePhase{1, minco.curve()}});
  ASSERT_FALSE(check_limits(bend, robot_.limits, kNow_s));
  const LocalQuery turning{bend, kNow_s + 3.0, bend, kNow_s + 3.0, bend};
  const MotionState meets = bend.at(kNow_s + 5.5);
  const Vector2 across(-meets.velocity.y(), meets.velocity.x());
  const LocalScene around = scene({person(meets.pose.position, 2.5, across)});
  expect_sound(planner_.plan(turning, around), turning, around);
}

TEST_F(LocalPlannerTest, SaysWhenItTakesTooLong) {
  const LocalScene around = scene({person(planned(2.5), 2.5, {0.0, 0.6})});
  const LocalPlan plan = planner_.plan(query(), around);
  ASSERT_EQ(plan.reason, PlanReason::kSolved) << plan.message;
  // Of a drive to a rejoin point mu ahead; to a farther one it takes longer in any case.
  const double drive_s = options_.mu_s + plan.delay_s;
  for (const double spare_s : {-0.01, 0.01}) {
    LocalOptions options = options_;
    options.t_epsilon_s = drive_s + spare_s;
    EXPECT_EQ(LocalPlanner(robot_, options).plan(query(), around).late, spare_s < 0.0);
  }
}

TEST_F(LocalPlannerTest, ComesBackBeyondWhatStandsOnTheRejoinPoint) {
  const LocalScene around = scene({person(planned(options_.mu_s), 0.0, {0.0, 0.0})});
  const LocalPlan plan = planner_.plan(query(), around);
  expect_sound(plan, query(), around);
  EXPECT_GT(plan.rejoin_point.place().x(), planned(options_.mu_s).x() + kPerson_m + keep_m_ - 1e-3);
}

TEST_F(LocalPlannerTest, LosesLittleAroundWhoStandsAnywhere) {
  for (double ahead_s = 2.25; ahead_s < options_.mu_s + 1.5; ahead_s += 0.25) {
    for (const double aside_m : {-0.2, 0.05}) {
      const LocalScene around =
          scene({person(planned(ahead_s) + Vector2(0.0, aside_m), 0.0, {0.0, 0.0})});
      const LocalPlan plan = planner_.plan(query(), around);
      ASSERT_EQ(plan.met, RequirementName::kDetour) << ahead_s;
      EXPECT_LT(plan.delay_s, 0.5) << ahead_s << " s ahead, " << aside_m << " m aside";
    }
  }
}

/// What is in the way only after the rejoin point is for the plan to see to; it is told.
TEST_F(LocalPlannerTest, IsHeldToWhatIsAskedUpToTheAnchor) {
  OccupancyGrid walled = grid_;
  fill_box(walled, {12.0, -5.0}, {12.5, 5.0});
  LocalScene around = scene({person(planned(2.5), 2.5, {0.0, 0.6})});
  EXPECT_FALSE(planner_.plan(query(), around).beyond);
  around.static_map = static_map_of(walled);
  around.obstacles = occupied_field(walled);
  const LocalPlan plan = planner_.plan(query(), around);
  expect_sound(plan, query(), around);
  EXPECT_EQ(plan.beyond.term, ViolatedTerm::kClearance);
  EXPECT_GT(plan.beyond.time_s, plan.rejoins_s);
}

TEST_F(LocalPlannerTest, IsBesideThePlanAtItsEndWhereThatIsNear) {
  LocalQuery near_the_end = query();
  near_the_end.start_time_s = near_the_end.progress_s = ahead_.end_time() - 4.0;
  const double meets_s = near_the_end.start_time_s + 1.6;
  const LocalScene around = scene({std::make_shared<PredictedDisc>(
      "person", meets_s, ahead_.at(meets_s).pose.position, Vector2(0.0, 0.8), kPerson_m, 0.0)});
  const LocalPlan plan = planner_.plan(near_the_end, around);
  ASSERT_EQ(plan.reason, PlanReason::kSolved) << plan.message;
  EXPECT_LT((plan.motion.end_pose().position - ahead_.end_pose().position).norm(), 1e-4);
  EXPECT_EQ(plan.motion.end_time(), plan.rejoins_s);
}

TEST_F(LocalPlannerTest, TheCheapestOfSeveralClassesIsChosen) {
  const LocalScene around = scene({person(planned(2.5) + Vector2(0.0, 0.1), 0.0, {0.0, 0.0})});
  const LocalPlan plan = planner_.plan(query(), around);
  expect_sound(plan, query(), around);
  ASSERT_GE(plan.candidates.size(), 2u);
  double cheapest = std::numeric_limits<double>::infinity();
  int certified = 0;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const PlanCandidate& candidate = plan.candidates[i];
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NE(candidate.signature, plan.candidates[j].signature);
    if (candidate.reason != PlanReason::kSolved) continue;
    ++certified;
    cheapest = std::min(cheapest, candidate.cost);
    double sum = 0.0;
    for (const auto& term : candidate.terms) sum += term.second;
    EXPECT_NEAR(sum, candidate.cost, 1e-9 * (1.0 + sum));
  }
  EXPECT_GE(certified, 2);
  for (const PlanCandidate& candidate : plan.candidates) {
    EXPECT_TRUE(!candidate.selected || candidate.cost == cheapest);
  }
  EXPECT_LT(plan.motion.at(query().start_time_s + 2.5).pose.position.y(), 0.0);  // the nearer side
}

TEST_F(LocalPlannerTest, AClassIsKeptUnlessAnotherIsCheaperByTheMargin) {
  LocalOptions options = options_;
  options.switch_gain = 0.0;
  const LocalPlanner planner(robot_, options);
  int kept = 0;
  int left = 0;
  for (const double aside_m : {0.02, 0.05, 0.1, 0.2, 0.35}) {
    const LocalScene around = scene({person(planned(2.5) + Vector2(0.0, aside_m), 0.0, {0, 0})});
    const LocalPlan first = planner.plan(query(), around);
    EXPECT_TRUE(first.switches_class) << "there was no class before";
    for (const PlanCandidate& other : first.candidates) {
      if (other.reason != PlanReason::kSolved || other.selected) continue;
      LocalQuery under_way = query();
      under_way.driven = other.motion;
      const LocalPlan second = planner.anew(under_way, around);
      ASSERT_EQ(second.reason, PlanReason::kSolved) << second.message;
      const auto driven = std::find_if(second.candidates.begin(), second.candidates.end(),
                                       [](const PlanCandidate& c) { return c.driven; });
      ASSERT_NE(driven, second.candidates.end()) << aside_m;
      EXPECT_EQ(driven->signature, other.signature);
      double cheapest = std::numeric_limits<double>::infinity();
      for (const PlanCandidate& candidate : second.candidates) {
        if (candidate.reason == PlanReason::kSolved) cheapest = std::min(cheapest, candidate.cost);
      }
      const bool stays = cheapest >= (1.0 - options.switch_margin) * driven->cost;
      EXPECT_EQ(driven->selected, stays) << aside_m;
      EXPECT_EQ(second.switches_class, !stays);
      EXPECT_EQ(planner.plan(under_way, around).switches_class, !stays);
      kept += stays;
      left += !stays;
    }
  }
  EXPECT_GT(kept, 0);
  EXPECT_GT(left, 0);
}

TEST_F(LocalPlannerTest, KeepsOnWithWhatIsDrivenAndLooksForNothingElse) {
  const LocalScene around = scene({person(planned(2.5) + Vector2(0.0, 0.1), 0.0, {0.0, 0.0})});
  EXPECT_TRUE(planner_.keep_on(query(), around).candidates.empty()) << "nothing is driven";
  for (const PlanCandidate& first : planner_.anew(query(), around).candidates) {
    if (first.met != RequirementName::kDetour) continue;
    LocalQuery under_way = query();
    under_way.driven = first.motion;
    const LocalPlan kept = planner_.keep_on(under_way, around);
    expect_sound(kept, under_way, around);
    ASSERT_EQ(kept.candidates.size(), 1u);
    EXPECT_FALSE(kept.switches_class);
    const double passes_s = query().start_time_s + 2.5;
    EXPECT_GT(kept.motion.position(passes_s).y() * first.motion.position(passes_s).y(), 0.0);
  }
}

TEST_F(LocalPlannerTest, TriesAgainOnThePathsThatCameToNothing) {
  int mended = 0;
  for (double meets_s = 1.0; meets_s < 2.5; meets_s += 0.1) {
    const LocalScene close = scene({person(planned(meets_s), 0.0, {-0.3, 0.1})});
    const LocalPlan failed = planner_.anew(query(), close);
    if (failed.met != RequirementName::kNone || failed.candidates.empty()) continue;
    LocalQuery harder = query();
    harder.wanted = RequirementName::kEmergencyDetour;
    const LocalPlan again = planner_.again(harder, close, failed);
    ASSERT_EQ(again.candidates.size(), failed.candidates.size());
    for (std::size_t i = 0; i < again.candidates.size(); ++i)
      EXPECT_EQ(again.candidates[i].signature, failed.candidates[i].signature);
    EXPECT_GE(again.met, RequirementName::kEmergencyDetour);
    mended += again.met == RequirementName::kEmergencyDetour;
  }
  EXPECT_GT(mended, 0);
}

/// What is said to be met is held against samples, for people ever nearer that may be ever farther
/// from where they are expected.
TEST_F(LocalPlannerTest, WhatIsMetIsKept) {
  const MotionLimits hard = robot_.emergency_limits();
  std::map<RequirementName, int> seen;
  for (double meets_s = 0.9; meets_s < 2.6; meets_s += 0.1) {
    for (const double unsure_m : {0.05, 0.4, 0.8}) {
      const auto expected = person(planned(meets_s), meets_s, {-0.3, 0.5});
      const auto grown =
          std::make_shared<PredictedDisc>("person", kNow_s, expected->at(kNow_s).centre,
                                          Vector2(-0.3, 0.5), kPerson_m + unsure_m, 0.0);
      LocalScene around = scene({grown});
      around.likely = {expected};
      const LocalPlan plan = planner_.plan(query(), around);
      ++seen[plan.met];
      EXPECT_EQ(plan.reason == PlanReason::kSolved, plan.met != RequirementName::kNone);
      if (plan.met == RequirementName::kNone) continue;
      const double until_s = std::min(plan.rejoins_s, around.predicted_until_s);
      EXPECT_GE(sampled_gap_m(plan.motion, *expected, until_s), keep_m_ - 1e-3);
      const bool kept = sampled_gap_m(plan.motion, *grown, until_s) >= keep_m_ - 1e-3;
      const auto within = [&plan](const Violation& violation) {
        return !violation || violation.time_s >= plan.rejoins_s;
      };
      const double start_s = query().start_time_s;
      const bool gentle = within(check_limits(plan.motion, robot_.limits, start_s));
      EXPECT_TRUE(within(check_limits(plan.motion, hard, start_s)));
      EXPECT_TRUE(plan.met != RequirementName::kDetour || (kept && gentle));
      EXPECT_TRUE(plan.met != RequirementName::kDetourLikely || gentle);
    }
  }
  EXPECT_GT(seen[RequirementName::kDetour], 0);
  EXPECT_GT(seen[RequirementName::kDetourLikely], 0);
  EXPECT_GT(seen[RequirementName::kNone], 0);
}

TEST_F(LocalPlannerTest, AvoidsPeersOnTheirPromises) {
  const double meets_s = query().start_time_s + 2.5;
  const Vector2 meets = ahead_.at(meets_s).pose.position;
  const auto crossing = std::make_shared<const Motion>(
      straight_drive(meets_s - 4.5, meets - Vector2(0.0, 3.0), M_PI / 2.0, 6.0, 0.9, 0.5));
  const auto peer = std::make_shared<PeerObstacle>("ugv2", crossing, 0.3, test::kRoverBraking);
  LocalScene around = scene({});
  around.peers = {peer};
  ASSERT_LT(sampled_gap_m(ahead_, *peer, meets_s + 3.0), distance_to_peers_m(robot_));
  expect_sound(planner_.plan(query(), around), query(), around);
}

TEST_F(LocalPlannerTest, SeveralAtOnce) {
  for (int seed = 0; seed < 6; ++seed) {
    Things moving;
    for (int i = 0; i < 4; ++i) {
      const double meets_s = 1.8 + 0.8 * i;
      const double speed = (i + seed) % 2 == 0 ? 0.8 : -0.6;
      moving.push_back(person(planned(meets_s) + Vector2(0.0, 0.1 * seed), meets_s, {0.1, speed}));
    }
    const LocalScene around = scene(moving);
    const LocalPlan plan = planner_.plan(query(), around);
    SCOPED_TRACE(seed);
    if (plan.reason == PlanReason::kSolved) expect_sound(plan, query(), around);
  }
}

TEST_F(LocalPlannerTest, SaysWhyThereIsNoWay) {
  // A row of people from wall to wall, all standing.
  Things row;
  for (double y = -7.0; y <= 7.0; y += 0.5)
    row.push_back(person(planned(2.5) + Vector2(0.0, y), 0.0, {0.0, 0.0}));
  OccupancyGrid walled = grid_;
  fill_box(walled, {-2.0, 3.0}, {16.0, 5.0});
  fill_box(walled, {-2.0, -5.0}, {16.0, -3.0});
  LocalScene blocked = scene(row);
  blocked.static_map = static_map_of(walled);
  blocked.obstacles = occupied_field(walled);
  const LocalPlan plan = planner_.plan(query(), blocked);
  EXPECT_EQ(plan.reason, PlanReason::kNoPath);
  EXPECT_FALSE(plan.message.empty());
  EXPECT_TRUE(plan.motion.empty());

  LocalQuery ended = query();
  ended.progress_s = ahead_.end_time();
  EXPECT_EQ(planner_.plan(ended, scene({})).reason, PlanReason::kNoPath);

  // A person steps before it: no path can be certified, and it says what is violated.
  const LocalPlan close = planner_.plan(query(), scene({person(planned(0.7), 0.0, {-0.9, 0.0})}));
  EXPECT_NE(close.reason, PlanReason::kSolved);
  EXPECT_TRUE(close.motion.empty());
  EXPECT_FALSE(close.message.empty());
  EXPECT_NE(close.message, "no violation");
}

TEST_F(LocalPlannerTest, IsTheSameForAnyNumberOfThreads) {
  const LocalScene around = scene({person(planned(2.5), 2.5, {0.0, 0.8}),
                                   person(planned(3.5) + Vector2(0.0, 0.4), 0.0, {0.0, 0.0})});
  const LocalPlan expected = planner_.plan(query(), around);
  for (const int threads : {1, 2, 7, 0}) {
    LocalOptions options = options_;
    options.threads = threads;
    const LocalPlan plan = LocalPlanner(robot_, options).plan(query(), around);
    ASSERT_EQ(plan.candidates.size(), expected.candidates.size());
    for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
      EXPECT_EQ(plan.candidates[i].cost, expected.candidates[i].cost);
      EXPECT_EQ(plan.candidates[i].signature, expected.candidates[i].signature);
    }
    ASSERT_EQ(plan.reason, PlanReason::kSolved);
    for (double t = plan.motion.start_time(); t < plan.motion.end_time(); t += 0.1)
      EXPECT_EQ(plan.motion.at(t).pose.position, expected.motion.at(t).pose.position);
  }
}

TEST_F(LocalPlannerTest, ValuesThatAreNotFiniteComeToNothing) {
  const LocalScene around = scene({person(planned(2.5), 2.5, {0.0, 0.8})});
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::nan(""), infinity, -infinity}) {
    LocalQuery broken = query();
    broken.start_time_s = bad;
    EXPECT_NO_THROW(EXPECT_NE(planner_.plan(broken, around).reason, PlanReason::kSolved)) << bad;
    broken = query();
    broken.progress_s = bad;
    LocalPlan plan;
    EXPECT_NO_THROW(plan = planner_.plan(broken, around)) << bad;
    EXPECT_TRUE(bad < 0.0 || plan.reason != PlanReason::kSolved) << bad;
    LocalScene with = around;
    with.predicted_until_s = bad;
    EXPECT_NO_THROW(plan = planner_.plan(query(), with)) << bad;
    if (!(bad < 0.0)) expect_sound(plan, query(), with);
  }
}

TEST_F(LocalPlannerTest, FromAStateThatNoRobotHasThereIsAReasonAndNoPlan) {
  const LocalScene around = scene({person(planned(2.5), 2.5, {0.0, 0.8})});
  for (const double speed : {30.0, 1e3, 1e6, 1e9}) {
    const double start_s = query().start_time_s;
    const Motion hasty =
        straight_drive(start_s - 2.5, {-2.0 * speed + ahead_.position(start_s).x(), 0.0}, 0.0,
                       4.0 * speed, speed, speed);
    const LocalQuery wild{hasty, start_s, ahead_, start_s, Motion()};
    LocalPlan plan;
    ASSERT_NO_THROW(plan = planner_.plan(wild, around)) << speed;
    EXPECT_NE(plan.reason, PlanReason::kSolved) << speed;
    EXPECT_TRUE(plan.motion.empty());
    EXPECT_FALSE(plan.message.empty());
  }
}

TEST_F(LocalPlannerTest, WithoutAPlanThereIsNowhereToComeBackTo) {
  LocalQuery nowhere = query();
  nowhere.plan = Motion();
  const LocalPlan plan = planner_.plan(nowhere, scene({person(planned(2.5), 2.5, {0.0, 0.8})}));
  EXPECT_EQ(plan.reason, PlanReason::kNoPath);
  EXPECT_FALSE(plan.message.empty());
}

}  // namespace
}  // namespace mocha
