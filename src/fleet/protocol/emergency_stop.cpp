#include "fleet/protocol/emergency_stop.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace mocha {
namespace {

constexpr double kPeriod_s = 1.0;  // in which all that is known is sent again
constexpr double kSoon_s = 0.1;    // the same after a change, or where a robot knows less
constexpr int kRepeats = 4;        // soon after a change; a fifth of the datagrams may get lost
constexpr double kSameTime_s = 1e-5;

bool plain(char c) { return c >= ' ' && c <= '~'; }

void require_of_stops(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument("emergency stops: " + what);
}

}  // namespace

void validate(const FleetStops& message) {
  require_of_stops(!message.agent.empty(), "have no name of a robot");
  require_of_stops(message.stops.size() <= kMostStopsSaid, "are more than 8 in one message");
  for (const FleetStop& stop : message.stops) {
    require_of_stops(!stop.agent.empty(), "one has no name of a robot");
    require_of_stops(stop.released <= stop.ordered,
                     "more of " + stop.agent + " are released than ordered");
    require_of_stops(std::isfinite(stop.since_s), "the time of one is not finite");
    require_of_stops(stop.reason == plain_reason(stop.reason),
                     "a reason is too long or not plain ASCII");
  }
}

std::string plain_reason(const std::string& text, std::size_t most) {
  std::string reason;
  std::copy_if(text.begin(), text.end(), std::back_inserter(reason), plain);
  return reason.substr(0, most);
}

EmergencyStop::EmergencyStop(std::string agent, std::uint32_t epoch, StopRecord record)
    : agent_(std::move(agent)), epoch_(epoch), record_(std::move(record)) {}

void EmergencyStop::stop_robot(double now, const std::string& reason) {
  if (record_.robot) return;
  record_.robot = true;
  record_.since_s = now;
  record_.reason = reason;
  ++changes_;
}

void EmergencyStop::stop_fleet(double now, const std::string& reason) {
  FleetStop& own = record_.fleet[agent_];
  if (own.holds()) return;
  own = {agent_, own.ordered + 1, own.released, now, plain_reason(reason)};
  note_change(now);
}

void EmergencyStop::reset_robot() {
  record_.robot = false;
  ++record_.resets;
  ++changes_;
}

void EmergencyStop::reset_fleet(double now) {
  for (auto& [agent, stop] : record_.fleet) stop.released = stop.ordered;
  ++record_.resets;
  note_change(now);
}

void EmergencyStop::receive(const FleetStops& message, double now) {
  const bool was_stopped = fleet_stopped();
  bool newer = false;
  bool older = message.stops.empty() && !record_.fleet.empty();
  for (const FleetStop& heard : message.stops) {
    const News news = merge(heard);
    newer = newer || news == News::kNewer;
    older = older || news == News::kOlder;
  }
  if (was_stopped && !fleet_stopped()) ++record_.resets;
  if (newer) note_change(now);
  if (older) say_next_s_ = std::min(say_next_s_, said_s_ + kSoon_s);
}

EmergencyStop::News EmergencyStop::merge(const FleetStop& heard) {
  const auto found = record_.fleet.find(heard.agent);
  const FleetStop known = found == record_.fleet.end() ? FleetStop() : found->second;
  if (heard.ordered > known.ordered && heard.ordered - known.ordered > kMostNews) {
    ++refused_;
    return News::kNone;
  }
  const bool newer = heard.ordered > known.ordered || heard.released > known.released;
  const bool older = heard.ordered < known.ordered || heard.released < known.released;
  if (!newer) return older ? News::kOlder : News::kNone;
  if (found == record_.fleet.end() && heard.agent != agent_ && !make_room()) {
    ++refused_;
    return News::kNone;
  }
  FleetStop merged = heard.ordered > known.ordered ? heard : known;
  merged.released = std::max(heard.released, known.released);
  // Released, by its number, is another one, of before this robot lost its record.
  const bool another =
      heard.ordered > known.ordered || std::abs(heard.since_s - known.since_s) > kSameTime_s;
  if (heard.agent == agent_ && known.holds() && !merged.holds() && another)
    merged = {agent_, merged.ordered + 1, merged.released, known.since_s, known.reason};
  record_.fleet[heard.agent] = std::move(merged);
  return News::kNewer;
}

/// Makes room for one more robot, if need be by forgetting one whose orders are released: heard of
/// again, it would stop the fleet at worst.
bool EmergencyStop::make_room() {
  if (record_.fleet.size() < kMostAgents) return true;
  for (auto it = record_.fleet.begin(); it != record_.fleet.end(); ++it) {
    if (it->second.holds() || it->first == agent_) continue;
    record_.fleet.erase(it);
    return true;
  }
  return false;
}

void EmergencyStop::note_change(double now) {
  ++changes_;
  repeats_ = kRepeats;
  say_next_s_ = now;
}

std::vector<FleetStops> EmergencyStop::tick(double now) {
  if (now < say_next_s_) return {};
  said_s_ = now;
  say_next_s_ = now + (repeats_ > 0 ? kSoon_s : kPeriod_s);
  repeats_ = std::max(0, repeats_ - 1);
  std::vector<FleetStops> messages{{agent_, epoch_, {}}};
  for (const auto& [agent, stop] : record_.fleet) {
    if (messages.back().stops.size() == kMostStopsSaid) messages.push_back({agent_, epoch_, {}});
    messages.back().stops.push_back(stop);
  }
  return messages;
}

std::vector<FleetStop> EmergencyStop::holding() const {
  std::vector<FleetStop> holding;
  for (const auto& [agent, stop] : record_.fleet) {
    if (stop.holds()) holding.push_back(stop);
  }
  return holding;
}

}  // namespace mocha
