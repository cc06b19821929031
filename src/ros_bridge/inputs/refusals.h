#pragma once

#include <map>
#include <string>

namespace mocha {

/// Messages that were not used, counted by reason.
class Refusals {
 public:
  /// `reason` is counted; `detail`, as it was refused, is kept until the next one.
  void add(const std::string& reason, const std::string& detail = "");
  const std::map<std::string, int>& counts() const { return counts_; }
  const std::string& newest() const { return newest_; }

  /// Warns of the newest, if there are any since the last time; at most every ten seconds.
  void warn();

 private:
  std::map<std::string, int> counts_;
  int total_ = 0;
  int warned_of_ = 0;
  std::string newest_;
};

}  // namespace mocha
