#pragma once

#include <cstdint>
#include <vector>

#include "fleet/promise.h"

namespace mocha {

/// A heartbeat as bytes: as many datagrams as its lines need, in a large fleet several. Each is a
/// heartbeat of its own; the last two lines of the whole, which are about the sender, stay
/// together. Throws std::invalid_argument where a line of it cannot be said at all.
std::vector<std::vector<std::uint8_t>> datagrams(const Beat& beat);

}  // namespace mocha
