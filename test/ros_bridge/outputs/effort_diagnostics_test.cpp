#include "ros_bridge/outputs/effort_diagnostics.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace mocha {
namespace {

std::map<std::string, std::string> diagnosed(const PlanningRecord& record) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  diagnose_effort(record, status);
  std::map<std::string, std::string> values;
  for (const auto& entry : status.values) values[entry.key] = entry.value;
  return values;
}

std::string counted(FallbackKind kind) { return std::string("plans with ") + to_text(kind); }

TEST(EffortDiagnostics, SayWhatTheLastPlanFellBackOnAndHowManyDid) {
  PlanningRecord record;
  auto values = diagnosed(record);
  EXPECT_EQ(values["the last plan fell back on"], "nothing");
  for (const FallbackKind kind : kFallbackKinds) EXPECT_EQ(values.at(counted(kind)), "0");
  PlanningEffort effort;
  effort.parameterisation = Parameterisation::kWaypoints;
  effort.fallbacks = {{FallbackKind::kSharpBend, {1.0, 2.0}},
                      {FallbackKind::kLatticePath, {3.0, 4.0}}};
  record.add(effort);
  effort.fallbacks.pop_back();
  record.add(effort);
  values = diagnosed(record);
  EXPECT_EQ(values["plans made"], "2");
  EXPECT_EQ(values["parameterisation of the last plan"], "waypoints");
  EXPECT_EQ(values["the last plan fell back on"],
            "plain waypoints instead of camouflage: the path bends too sharply for a reference "
            "point, at (1.00, 2.00)");
  EXPECT_EQ(values.at(counted(FallbackKind::kSharpBend)), "2");
  EXPECT_EQ(values.at(counted(FallbackKind::kLatticePath)), "1");
  EXPECT_EQ(values.at(counted(FallbackKind::kCamouflageGivenUp)), "0");
}

}  // namespace
}  // namespace mocha
