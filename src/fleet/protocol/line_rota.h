#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mocha {

/// The order in which heartbeats, which have room for so many lines, speak of peers: first of those
/// of which nothing was said yet, the most urgent first; then of each the oftener, the more urgent
/// it is.
class LineRota {
 public:
  struct Entry {
    std::string peer;
    double urgency;  ///< above 0; one twice as urgent has its turn twice as often
  };

  /// Throws std::invalid_argument where there is room for nothing.
  explicit LineRota(std::size_t most_lines);

  /// Returns the peers that have their turn now.
  std::vector<std::string> take(std::vector<Entry> entries, double now);

 private:
  struct Turn {
    double time_s;
    std::uint64_t number;  // of those at one time, which came first
  };

  std::size_t most_lines_;
  std::map<std::string, Turn> last_;  // of the entries of the last time
  std::uint64_t turns_ = 0;
};

}  // namespace mocha
