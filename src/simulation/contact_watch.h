#pragma once

#include <set>
#include <string>
#include <utility>

namespace mocha {

/// Turns distances between bodies into events: one for each onset of a contact.
class ContactWatch {
 public:
  /// Whether a contact of these two begins now: they overlap, at least one of them is moving, and
  /// they have been apart by more than 1 cm since the last one.
  bool begins(const std::string& first, const std::string& second, double distance_m, bool moving);

 private:
  std::set<std::pair<std::string, std::string>> touching_;
};

}  // namespace mocha
