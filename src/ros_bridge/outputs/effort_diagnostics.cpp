#include "ros_bridge/outputs/effort_diagnostics.h"

#include <string>
#include <vector>

#include "ros_bridge/messages/status_conversions.h"

namespace mocha {
namespace {

std::string listed(const std::vector<Fallback>& fallbacks) {
  std::string words;
  for (const Fallback& each : fallbacks) words += (words.empty() ? "" : "; ") + describe(each);
  return words.empty() ? "nothing" : words;
}

}  // namespace

void diagnose_effort(const PlanningRecord& record,
                     diagnostic_updater::DiagnosticStatusWrapper& status) {
  status.add("plans made", record.plans());
  status.add("planning time, last (s)", record.last().took_s);
  status.add("planning time, median (s)", record.quantile_s(0.5));
  status.add("planning time, 95 % (s)", record.quantile_s(0.95));
  status.add("planning time, longest (s)", record.quantile_s(1.0));
  status.add("classes of paths in the last plan", record.last().classes);
  status.add("evaluations in the last plan", record.last().evaluations);
  status.add("parameterisation of the last plan", to_text(record.last().parameterisation));
  status.add("the last plan fell back on", listed(record.last().fallbacks));
  for (const FallbackKind kind : kFallbackKinds) {
    const auto found = record.fallbacks().find(kind);
    const int plans = found == record.fallbacks().end() ? 0 : found->second.plans;
    status.add(std::string("plans with ") + to_text(kind), plans);
  }
}

}  // namespace mocha
