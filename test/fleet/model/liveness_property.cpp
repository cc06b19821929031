#include "fleet/model/liveness_property.h"

namespace mocha::test {
namespace {

constexpr int kEnoughSteps = 8;  // to find each other, know the clocks, ask and answer

bool has_enough_time(const ProtocolModel& model, int i) {
  const auto& pending = model.robot(i).pending;
  return pending && pending->start_s >= model.now(i) + kEnoughSteps * kStep_s;
}

bool any_pending(const ProtocolModel& model) {
  for (int i = 0; i < model.scenario().size(); ++i) {
    if (model.robot(i).pending) return true;
  }
  return false;
}

ProtocolModel calmed(ProtocolModel model) {
  model.calm_down();
  constexpr int kLongest = 40;  // steps; more than any motion of a script is ahead
  for (int k = 0; k < kLongest && any_pending(model); ++k) model.calm_step();
  return model;
}

}  // namespace

std::string liveness_violation(const ProtocolModel& model) {
  if (!any_pending(model)) return "";
  const ProtocolModel end = calmed(model);
  bool could_win = false;
  for (int i = 0; i < model.scenario().size(); ++i) {
    if (end.robot(i).pending) return "the proposal of " + name_of_robot(i) + " never ends";
    if (!has_enough_time(model, i)) continue;
    could_win = true;
    if (end.robot(i).fate == Fate::kInVain)
      return "the proposal of " + name_of_robot(i) + " waits in vain";
  }
  if (could_win && model.undisturbed() && !end.any_settled()) return "nobody wins";
  return "";
}

}  // namespace mocha::test
