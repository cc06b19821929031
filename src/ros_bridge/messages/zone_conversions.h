#pragma once

#include <mocha_ugv/Zones.h>

#include <string>
#include <vector>

#include "world/zones.h"

namespace mocha {

/// All but the header and the way out.
void to_message(const Zones& zones, mocha_ugv::Zones& message);

/// A last corner that repeats the first only says that an area is closed. Zones without a name are
/// named after their place in the list. Throws std::invalid_argument, naming the zone.
Zones from_message(const std::vector<mocha_ugv::Zone>& zones);

}  // namespace mocha
