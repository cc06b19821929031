#include "fleet/protocol/line_rota.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace mocha {

LineRota::LineRota(std::size_t most_lines) : most_lines_(most_lines) {
  if (most_lines == 0) throw std::invalid_argument("most_lines = 0, allowed is 1 or more");
}

std::vector<std::string> LineRota::take(std::vector<Entry> entries, double now) {
  constexpr double kNever_s = -std::numeric_limits<double>::infinity();
  std::map<std::string, Turn> last;
  for (const Entry& entry : entries) {
    const auto known = last_.find(entry.peer);
    last[entry.peer] = known == last_.end() ? Turn{kNever_s, 0} : known->second;
  }
  const auto waits_longest = [&](const Entry& a, const Entry& b) {
    const auto order = [&](const Entry& entry) {
      const Turn& turn = last.at(entry.peer);
      return std::make_tuple(-(now - turn.time_s) * entry.urgency, turn.number, -entry.urgency);
    };
    return order(a) < order(b);
  };
  const std::size_t lines = std::min(most_lines_, entries.size());
  std::partial_sort(entries.begin(), entries.begin() + lines, entries.end(), waits_longest);
  std::vector<std::string> turns;
  for (std::size_t i = 0; i < lines; ++i) {
    turns.push_back(entries[i].peer);
    last[entries[i].peer] = {now, ++turns_};
  }
  last_ = std::move(last);
  return turns;
}

}  // namespace mocha
