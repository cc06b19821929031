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
  result.took_s = 0.02;
  result.candidates.resize(3);
  for (int i = 0; i < 3; ++i) result.candidates[i].evaluations = 10 * (i + 1);
  result.candidates[0].parameterisation = Parameterisation::kCamouflage;
  result.candidates[1].parameterisation = Parameterisation::kWaypoints;
  EXPECT_EQ(PlanningEffort::of(result).parameterisation, Parameterisation::kNone);
  result.candidates[1].selected = true;
  const PlanningEffort effort = PlanningEffort::of(result);
  EXPECT_EQ(effort.took_s, 0.02);
  EXPECT_EQ(effort.classes, 3);
  EXPECT_EQ(effort.evaluations, 60);
  EXPECT_EQ(effort.parameterisation, Parameterisation::kWaypoints);
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
