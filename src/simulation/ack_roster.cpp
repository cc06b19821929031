#include "simulation/ack_roster.h"

#include <algorithm>

namespace mocha {
namespace {

std::string full_name(const std::string& robot, const std::string& node) {
  return robot + "/" + node;
}

}  // namespace

void AckRoster::expect(const std::string& robot, const std::string& node) {
  entries_[full_name(robot, node)] = {};
}

void AckRoster::acknowledge(const std::string& robot, const std::string& node,
                            std::int64_t stamp_ns) {
  const auto entry = entries_.find(full_name(robot, node));
  if (entry == entries_.end()) return;
  entry->second.handled_ns = std::max(entry->second.handled_ns, stamp_ns);
  entry->second.counts = true;
}

bool AckRoster::complete(std::int64_t stamp_ns) const {
  return std::all_of(entries_.begin(), entries_.end(), [&](const auto& entry) {
    return !entry.second.counts || entry.second.handled_ns >= stamp_ns;
  });
}

std::vector<std::string> AckRoster::give_up(std::int64_t stamp_ns) {
  std::vector<std::string> names;
  for (auto& [name, entry] : entries_) {
    if (!entry.counts || entry.handled_ns >= stamp_ns) continue;
    entry.counts = false;
    names.push_back(name);
  }
  return names;
}

std::vector<std::string> AckRoster::missing() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) {
    if (!entry.counts) names.push_back(name);
  }
  return names;
}

}  // namespace mocha
