#include "fleet/model/explorer.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <unordered_set>
#include <utility>

#include "fleet/model/liveness_property.h"
#include "fleet/model/protocol_fingerprint.h"

namespace mocha::test {
namespace {

/// How a state was come to first.
struct Origin {
  std::uint32_t from;  // number of a state
  Action action;
  std::uint16_t depth;
};

struct Open {
  std::uint32_t number;
  ProtocolModel model;
};

std::string violation_of(const ProtocolModel& model, Action::Kind by) {
  if (!model.violation().empty()) return model.violation();
  // Within a step, the calm goes on as one of the choices there.
  return by == Action::Kind::kTimeGoesOn ? liveness_violation(model) : "";
}

std::vector<std::string> replay(ProtocolModel model, const std::vector<Origin>& origins) {
  std::vector<Action> actions;
  for (std::size_t number = origins.size() - 1; number > 0; number = origins[number].from)
    actions.push_back(origins[number].action);
  std::reverse(actions.begin(), actions.end());
  std::vector<std::string> lines;
  for (const Action& action : actions) {
    lines.push_back(model.describe(action));
    model.apply(action);
  }
  return lines;
}

}  // namespace

Exploration explore(const Scenario& scenario, std::size_t most_states) {
  const ProtocolModel start(std::make_shared<const Scenario>(scenario));
  std::unordered_set<Fingerprint> seen = {ProtocolFingerprint::of(start)};
  std::vector<Origin> origins = {{0, {}, 0}};
  std::deque<Open> open = {{0, start}};
  Exploration found;
  while (!open.empty() && found.violation.empty() && origins.size() < most_states) {
    const Open from = std::move(open.front());
    open.pop_front();
    for (const Action& action : from.model.actions()) {
      ++found.transitions;
      ProtocolModel next = from.model;
      next.apply(action);
      if (!seen.insert(ProtocolFingerprint::of(next)).second) continue;
      const auto number = static_cast<std::uint32_t>(origins.size());
      const std::uint16_t depth = origins[from.number].depth + 1;
      origins.push_back({from.number, action, depth});
      found.settled += next.any_settled();
      found.violation = violation_of(next, action.kind);
      if (!found.violation.empty()) break;
      open.push_back({number, std::move(next)});
    }
  }
  found.states = origins.size();
  found.depth = origins.back().depth;
  found.complete = open.empty() && found.violation.empty();
  if (!found.violation.empty()) found.counterexample = replay(start, origins);
  return found;
}

std::string to_text(const Exploration& found) {
  std::string text = std::to_string(found.states) + " states, " +
                     std::to_string(found.transitions) + " transitions, " +
                     std::to_string(found.settled) + " with a motion settled, depth " +
                     std::to_string(found.depth) + (found.complete ? ", complete" : "");
  if (!found.violation.empty()) text += "\n" + found.violation;
  for (const std::string& line : found.counterexample) text += "\n  " + line;
  return text;
}

}  // namespace mocha::test
