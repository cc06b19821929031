#include "planning/local/local_rules.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

constexpr double kSmoothStart_rad = 0.8;

class LocalRulesTest : public ::testing::Test {
 protected:
  /// Three seconds into a straight drive, which is the plan, too.
  LocalRulesTest() {
    query_.committed = query_.plan = straight_drive(0.0, {0.0, 0.0}, 0.0, 8.0, 0.8, 0.5);
    query_.start_time_s = query_.progress_s = 3.0;
    back_ = return_to(*find_rejoin_point(query_.plan, 3.0, 4.0), query_, robot_.limits);
  }
  Seed seed_towards(const Vector2& aside) const {
    const Vector2 from = query_.committed.position(query_.start_time_s);
    const SpaceTimePath path{
        {{from, 3.0}, {from + aside, 5.0}, {back_.rejoin_point.place(), 8.0}}, 0.0, {1}, true};
    return seed_of(path, query_, robot_.limits, kSmoothStart_rad);
  }
  Violation violated(ViolatedTerm term, double value, double limit) const {
    Violation violation;
    violation.term = term;
    violation.value = value;
    violation.limit = limit;
    return violation;
  }

  const RobotModel robot_ = rover();
  const Requirements requirements_{robot_};
  const LocalOptions options_ = default_local_options();
  const LocalScene scene_ = scene_of(free_grid({-2.0, -4.0}, {12.0, 4.0}));
  LocalQuery query_;
  Return back_{};
  const LocalRules rules_{requirements_, robot_.footprint, options_, query_, scene_, back_};
};

TEST_F(LocalRulesTest, ASeedKeepsTheTimesOfItsPath) {
  const Seed seed = seed_towards({2.0, 0.5});
  EXPECT_EQ(seed.times_s, (std::vector<double>{0.0, 2.0, 5.0}));
  EXPECT_TRUE(seed.driven);
  EXPECT_EQ(seed.signature, Signature{1});
  ASSERT_EQ(seed.start_maneuvers.size(), 1u);
  EXPECT_TRUE(seed.start_maneuvers[0].phases.empty()) << "it goes on as it drives";
}

TEST_F(LocalRulesTest, BrakesAndTurnsWhereThePathTurnsAway) {
  const Seed seed = seed_towards({-2.0, 0.5});
  ASSERT_GE(seed.start_maneuvers.size(), 1u);
  EXPECT_GE(seed.start_maneuvers[0].phases.size(), 2u);
  EXPECT_EQ(seed.start_maneuvers[0].path.front(), seed.start_maneuvers[0].state.col(0));
}

TEST_F(LocalRulesTest, WhoIsSlowerThanThePlanIsBackLater) {
  EXPECT_NEAR(back_.earliest_s, back_.rejoin_point.drive_s, 1e-9);
  query_.committed = standing(0.0, query_.plan.position(3.0), 0.0);
  const Return later = return_to(back_.rejoin_point, query_, robot_.limits);
  EXPECT_GT(later.earliest_s, back_.earliest_s + 0.2);
}

TEST_F(LocalRulesTest, MeetsThePlanAgainInTheTimeOfThePlan) {
  const Seed seed = seed_towards({2.0, 0.5});
  const DriveQuery drive = rules_.drive(seed, seed.start_maneuvers[0]);
  ASSERT_TRUE(drive.rejoin);
  EXPECT_EQ(drive.rejoin->col(0), back_.rejoin_point.place());
  EXPECT_EQ(drive.duration_cost.value(back_.earliest_s), 0.0);
  EXPECT_GT(drive.duration_cost.value(back_.earliest_s + 1.0), 0.0);
}

TEST_F(LocalRulesTest, GoesOnAlongThePlanAndIsCertifiedUpToThere) {
  const double rejoins_s = back_.rejoin_point.plan_time_s;
  const auto& plan = std::get<DrivePhase>(query_.plan.phases()[0]).path;
  PlanCandidate candidate;
  // The plan itself is a drive back to it.
  const PlanarPath part = plan.slice(3.0, rejoins_s);
  ASSERT_TRUE(rules_.assemble({}, part, candidate));
  EXPECT_NEAR(candidate.drive_ends_s, rejoins_s, 1e-9);
  EXPECT_NEAR(candidate.motion.end_time(), query_.plan.end_time(), 1e-6);
  rules_.certify(candidate);
  EXPECT_EQ(candidate.met, RequirementName::kDetour) << describe(candidate.violation);
}

TEST_F(LocalRulesTest, IsNoMotionWhereItComesMuchTooLate) {
  const auto& plan = std::get<DrivePhase>(query_.plan.phases()[0]).path;
  PlanCandidate candidate;
  const StartManeuver waits{{}, 2.0 * options_.mu_s, 1, {}, {}};
  EXPECT_FALSE(rules_.assemble(waits, plan.slice(3.0, back_.rejoin_point.plan_time_s), candidate));
  EXPECT_TRUE(candidate.motion.empty());
}

TEST_F(LocalRulesTest, MoreEffortIsForWhatIsNearlyKept) {
  EXPECT_TRUE(rules_.may_be_mended(violated(ViolatedTerm::kSeparation, 0.5, 0.6)));
  EXPECT_FALSE(rules_.may_be_mended(violated(ViolatedTerm::kSeparation, 0.3, 0.6)));
  EXPECT_TRUE(rules_.may_be_mended(violated(ViolatedTerm::kSpeed, 1.05, 1.0)));
  EXPECT_FALSE(rules_.may_be_mended(violated(ViolatedTerm::kSpeed, 1.2, 1.0)));
  EXPECT_TRUE(rules_.may_be_mended(violated(ViolatedTerm::kClearance, 0.0, 0.1)));
}

}  // namespace
}  // namespace mocha
