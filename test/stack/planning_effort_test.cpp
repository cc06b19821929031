#include "stack/planning_effort.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

PlanningEffort that_took(double time_s) {
  PlanningEffort effort;
  effort.took_s = time_s;
  return effort;
}

TEST(PlanningEffort, CountsAllCandidatesAndNamesTheParameterisationOfTheSelected) {
  PlanResult result;
  result.candidates.resize(3);
  for (int i = 0; i < 3; ++i) result.candidates[i].evaluations = 10 * (i + 1);
  result.candidates[0].parameterisation = Parameterisation::kCamouflage;
  result.candidates[1].parameterisation = Parameterisation::kWaypoints;
  EXPECT_EQ(PlanningEffort::of(result, 0.02).parameterisation, Parameterisation::kNone);
  result.candidates[1].selected = true;
  const PlanningEffort effort = PlanningEffort::of(result, 0.02);
  EXPECT_EQ(effort.took_s, 0.02);
  EXPECT_EQ(effort.classes, 3);
  EXPECT_EQ(effort.evaluations, 60);
  EXPECT_EQ(effort.parameterisation, Parameterisation::kWaypoints);
}

TEST(PlanningEffort, HasWhatTheSelectedFellBackOn) {
  Selection selection;
  selection.candidates.resize(2);
  selection.candidates[0].fallbacks = {{FallbackKind::kSharpBend, {1.0, 2.0}}};
  selection.candidates[1].selected = true;
  EXPECT_TRUE(PlanningEffort::of(selection, 0.0).fallbacks.empty());
  std::swap(selection.candidates[0], selection.candidates[1]);
  selection.candidates[0].selected = false;
  selection.candidates[1].selected = true;
  ASSERT_EQ(PlanningEffort::of(selection, 0.0).fallbacks.size(), 1u);
  EXPECT_EQ(PlanningEffort::of(selection, 0.0).fallbacks[0].kind, FallbackKind::kSharpBend);
}

TEST(PlanningRecord, CountsThePlansThatFellBack) {
  PlanningRecord record;
  PlanningEffort effort;
  record.add(effort);
  EXPECT_TRUE(record.fallbacks().empty());
  effort.fallbacks = {{FallbackKind::kSharpBend, {1.0, 2.0}}};
  record.add(effort);
  effort.fallbacks = {{FallbackKind::kSharpBend, {3.0, 4.0}},
                      {FallbackKind::kLatticePath, {5.0, 6.0}}};
  record.add(effort);
  effort.fallbacks = {{FallbackKind::kLatticePath, {7.0, 8.0}}};
  record.add(effort);
  ASSERT_EQ(record.fallbacks().size(), 2u);
  const FallbackCount& bends = record.fallbacks().at(FallbackKind::kSharpBend);
  EXPECT_EQ(bends.plans, 2);
  EXPECT_EQ(bends.place, Vector2(3.0, 4.0));
  EXPECT_FALSE(bends.in_last_plan);
  const FallbackCount& lattice = record.fallbacks().at(FallbackKind::kLatticePath);
  EXPECT_EQ(lattice.plans, 2);
  EXPECT_EQ(lattice.place, Vector2(7.0, 8.0));
  EXPECT_TRUE(lattice.in_last_plan);
}

TEST(PlanningRecord, HasTheLastTheMedianAndTheLongest) {
  PlanningRecord record;
  EXPECT_EQ(record.plans(), 0);
  EXPECT_EQ(record.quantile_s(0.5), 0.0);
  for (const double time_s : {0.5, 0.1, 0.4, 0.2, 0.3}) record.add(that_took(time_s));
  EXPECT_EQ(record.plans(), 5);
  EXPECT_EQ(record.last().took_s, 0.3);
  EXPECT_EQ(record.quantile_s(0.5), 0.3);
  EXPECT_EQ(record.quantile_s(0.0), 0.1);
  EXPECT_EQ(record.quantile_s(0.95), 0.5);
  EXPECT_EQ(record.quantile_s(1.0), 0.5);
}

TEST(PlanningRecord, ForgetsWhatIsLongAgo) {
  PlanningRecord record;
  record.add(that_took(9.0));
  for (int i = 0; i < 200; ++i) record.add(that_took(0.1));
  EXPECT_EQ(record.plans(), 201);
  EXPECT_EQ(record.quantile_s(1.0), 0.1);
}

}  // namespace
}  // namespace mocha
