#include "planning/candidates/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

#include "planning/worlds.h"
#include "world/margin_budget.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using Name = RequirementName;

const std::function<bool()> kGoOn = [] { return false; };

/// Straight drives, certified as the test says: the n-th one as the n-th verdict, the last of which
/// stays.
class ToldRules : public CandidateRules {
 public:
  struct Verdict {
    Name met;
    Violation violation;
  };
  mutable std::deque<Verdict> verdicts;
  mutable std::vector<double> durations_s;  ///< of the drives that were certified
  bool mends = true;

  Name wanted() const override { return Name::kDetour; }
  EffortLadder ladder() const override { return {4, 20.0}; }
  DriveQuery drive(const Seed&, const StartManeuver& start_maneuver) const override {
    DriveQuery drive;
    drive.path = start_maneuver.path;
    drive.start = start_maneuver.state;
    drive.start_time_s = 0.0;
    drive.duration_cost = DurationCost::total(1.0);
    return drive;
  }
  bool assemble(const StartManeuver&, const PlanarPath& drive,
                PlanCandidate& candidate) const override {
    candidate.motion = Motion(0.0, {DrivePhase{1, drive}});
    return true;
  }
  void certify(PlanCandidate& candidate) const override {
    durations_s.push_back(candidate.motion.end_time());
    candidate.met = verdicts.front().met;
    candidate.violation = verdicts.front().violation;
    if (verdicts.size() > 1) verdicts.pop_front();
  }
  bool may_be_mended(const Violation&) const override { return mends; }
};

Violation violated(ViolatedTerm term, double value = 2.0, double limit = 1.0) {
  Violation violation;
  violation.term = term;
  violation.value = value;
  violation.limit = limit;
  return violation;
}

class PipelineTest : public ::testing::Test {
 protected:
  /// Straight ahead, from rest.
  Seed seed(double least_cost, bool driven, double length_m = 6.0) const {
    const StartManeuvers start_maneuvers(robot_.limits, 0.8);
    return {start_maneuvers.from_rest({}, {{0.0, 0.0}, 0.0}, {{0.0, 0.0}, {length_m, 0.0}}),
            {},
            {},
            least_cost,
            driven};
  }
  PlanCandidate found() const { return pipeline_.optimise_and_certify(seed(0.0, false), kGoOn); }

  const RobotModel robot_ = rover();
  const DriveOptimizer optimizer_{robot_, default_options(),
                                  MarginBudget::of(robot_).static_margin()};
  const PrimitiveField<2> open_{{}, 1.0};
  ToldRules rules_;
  const CandidatePipeline pipeline_{optimizer_, open_, rules_};
};

TEST_F(PipelineTest, TriesHarderUntilTheMotionIsCertified) {
  const Violation unclear = violated(ViolatedTerm::kClearance, 0.1, 0.2);
  rules_.verdicts = {{Name::kNone, unclear}, {Name::kNone, unclear}, {Name::kDetour, {}}};
  const PlanCandidate candidate = found();
  EXPECT_EQ(candidate.reason, PlanReason::kSolved);
  EXPECT_EQ(candidate.met, Name::kDetour);
  EXPECT_FALSE(candidate.violation);
  EXPECT_EQ(rules_.durations_s.size(), 3u);
}

TEST_F(PipelineTest, GivesUpAfterTheLadderWithTheReason) {
  rules_.verdicts = {{Name::kNone, violated(ViolatedTerm::kClearance, 0.1, 0.2)}};
  const PlanCandidate candidate = found();
  EXPECT_EQ(candidate.reason, PlanReason::kNotCertified);
  EXPECT_EQ(candidate.violation.term, ViolatedTerm::kClearance);
  EXPECT_EQ(rules_.durations_s.size(), 4u);
}

TEST_F(PipelineTest, TriesNoFurtherWhatCannotBeMended) {
  rules_.mends = false;
  rules_.verdicts = {{Name::kNone, violated(ViolatedTerm::kClearance, 0.1, 0.2)}};
  EXPECT_EQ(found().reason, PlanReason::kNotCertified);
  EXPECT_EQ(rules_.durations_s.size(), 1u);
}

TEST_F(PipelineTest, KeepsWhatMeetsLessWhereNothingMeetsMore) {
  const Violation near = violated(ViolatedTerm::kSeparation, 0.1, 0.2);
  rules_.verdicts = {{Name::kDetourLikely, near}, {Name::kNone, near}};
  const PlanCandidate candidate = found();
  EXPECT_EQ(candidate.met, Name::kDetourLikely);
  EXPECT_EQ(candidate.reason, PlanReason::kSolved);
  EXPECT_EQ(candidate.motion.end_time(), rules_.durations_s.front());
}

TEST_F(PipelineTest, DrivesALittleSlowerInsteadOfOptimisingAgain) {
  rules_.verdicts = {{Name::kNone, violated(ViolatedTerm::kSpeed, 1.02, 1.0)}, {Name::kDetour, {}}};
  const PlanCandidate candidate = found();
  EXPECT_EQ(candidate.reason, PlanReason::kSolved);
  ASSERT_EQ(rules_.durations_s.size(), 2u);
  EXPECT_NEAR(rules_.durations_s[1], 1.02 * 1.001 * rules_.durations_s[0], 1e-6);
  double sum = 0.0;
  for (const auto& [name, value] : candidate.terms) sum += value;
  EXPECT_NEAR(candidate.cost, sum, 1e-9) << "what it takes longer counts";
  EXPECT_GE(candidate.cost, candidate.motion.end_time());
}

TEST_F(PipelineTest, SaysWhatItFellBackOn) {
  Violation unclear = violated(ViolatedTerm::kClearance, 0.1, 0.2);
  unclear.place = {3.0, 4.0};
  rules_.verdicts = {{Name::kNone, unclear}, {Name::kDetour, {}}};
  EXPECT_TRUE(found().fallbacks.empty()) << "camouflage is tried twice";
  rules_.verdicts = {{Name::kNone, unclear}, {Name::kNone, unclear}, {Name::kDetour, {}}};
  Seed of_lattice = seed(0.0, false);
  of_lattice.fallback = Fallback{FallbackKind::kLatticePath, {1.0, 2.0}};
  const auto fallbacks = pipeline_.optimise_and_certify(of_lattice, kGoOn).fallbacks;
  ASSERT_EQ(fallbacks.size(), 2u);
  EXPECT_EQ(fallbacks[0].kind, FallbackKind::kCamouflageGivenUp);
  EXPECT_EQ(fallbacks[0].place, Vector2(3.0, 4.0));
  EXPECT_EQ(fallbacks[1].kind, FallbackKind::kLatticePath);
  EXPECT_EQ(fallbacks[1].place, Vector2(1.0, 2.0));
}

TEST_F(PipelineTest, SaysThatItDrivesMuchSlowerThanOptimised) {
  for (const double excess : {1.02, 1.5}) {
    const Violation fast = violated(ViolatedTerm::kSpeed, excess, 1.0);
    rules_.durations_s.clear();
    rules_.verdicts = {{Name::kNone, fast},
                       {Name::kNone, fast},
                       {Name::kNone, fast},
                       {Name::kNone, fast},
                       {Name::kDetour, {}}};
    if (excess < 1.1) rules_.verdicts = {{Name::kNone, fast}, {Name::kDetour, {}}};
    const PlanCandidate candidate = found();
    ASSERT_EQ(candidate.reason, PlanReason::kSolved);
    const bool says =
        std::any_of(candidate.fallbacks.begin(), candidate.fallbacks.end(),
                    [](const Fallback& each) { return each.kind == FallbackKind::kSlowedDown; });
    EXPECT_EQ(says, excess > 1.1) << "a little slower is nothing to speak of";
  }
}

TEST_F(PipelineTest, WhatCannotWinIsStoppedUnlessItIsDriven) {
  rules_.verdicts = {{Name::kDetour, {}}};
  const auto raced =
      pipeline_.race({seed(0.0, false), seed(1e3, false), seed(1e3, true)}, {0.1, 0.0}, 1, kGoOn);
  EXPECT_EQ(raced[0].reason, PlanReason::kSolved);
  EXPECT_EQ(raced[1].reason, PlanReason::kCannotWin);
  EXPECT_EQ(raced[1].cost, 1e3);
  EXPECT_EQ(raced[2].reason, PlanReason::kSolved);
  EXPECT_TRUE(raced[2].driven);
}

TEST_F(PipelineTest, TriesNoHarderWhatIsTooDearUnlessItsSearchEndedEarly) {
  const auto is_too_dear = [](double cost) { return cost > 1.0; };
  PlannerOptions hasty = default_options();
  hasty.max_evaluations = 2;
  const DriveOptimizer hasty_optimizer(robot_, hasty, MarginBudget::of(robot_).static_margin());
  for (const bool converges : {true, false}) {
    rules_.durations_s.clear();
    rules_.verdicts = {{Name::kNone, violated(ViolatedTerm::kClearance, 0.1, 0.2)}};
    const CandidatePipeline pipeline(converges ? optimizer_ : hasty_optimizer, open_, rules_);
    const PlanCandidate candidate =
        pipeline.optimise_and_certify(seed(0.0, false), kGoOn, is_too_dear);
    EXPECT_EQ(candidate.reason, PlanReason::kNotCertified);
    EXPECT_EQ(candidate.violation.term, ViolatedTerm::kClearance);
    EXPECT_EQ(rules_.durations_s.size(), converges ? 1u : 4u);
  }
}

TEST_F(PipelineTest, OnlyWhatIsNotDrivenIsTooDear) {
  const Violation unclear = violated(ViolatedTerm::kClearance, 0.1, 0.2);
  for (const bool driven : {false, true}) {
    rules_.durations_s.clear();
    rules_.verdicts = {{Name::kDetour, {}}, {Name::kNone, unclear}};
    // One after the other: the second costs more than the first, which is certified.
    pipeline_.race({seed(0.0, false), seed(0.0, driven, 7.0)}, SwitchRule{0.0, 0.0}, 1, kGoOn);
    EXPECT_EQ(rules_.durations_s.size(), driven ? 5u : 2u);
  }
}

TEST_F(PipelineTest, SaysThatItWasStopped) {
  rules_.verdicts = {{Name::kDetour, {}}};
  const auto raced = pipeline_.race({seed(0.0, false)}, {0.1, 0.0}, 1, [] { return true; });
  EXPECT_EQ(raced[0].reason, PlanReason::kBudgetExhausted);
  EXPECT_TRUE(raced[0].motion.empty());
}

}  // namespace
}  // namespace mocha
