#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mocha {

/// The nodes that have to acknowledge each step of the clock before the next one.
class AckRoster {
 public:
  void expect(const std::string& robot, const std::string& node);

  /// A node reports that it has handled the step at `stamp_ns`. Nodes that were given up count
  /// again; unexpected ones never do.
  void acknowledge(const std::string& robot, const std::string& node, std::int64_t stamp_ns);

  /// Whether every node that counts has handled the step at `stamp_ns` or a later one.
  bool complete(std::int64_t stamp_ns) const;

  /// Gives up the nodes that have not: they do not count until they acknowledge again. Returns
  /// their names ("ugv1/perception").
  std::vector<std::string> give_up(std::int64_t stamp_ns);

  /// Names of the nodes that are given up.
  std::vector<std::string> missing() const;

 private:
  struct Entry {
    std::int64_t handled_ns = -1;
    bool counts = true;
  };

  std::map<std::string, Entry> entries_;
};

}  // namespace mocha
