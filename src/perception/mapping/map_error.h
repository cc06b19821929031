#pragma once

#include <stdexcept>

namespace mocha {

/// A map cannot be read, written or extended. what() names the file, if there is one, and the
/// reason.
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mocha
