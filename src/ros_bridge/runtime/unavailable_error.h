#pragma once

#include <stdexcept>

namespace mocha {

/// What a node needs and does not find now, though it may be there later: nothing that its user
/// has to mend first.
class UnavailableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mocha
