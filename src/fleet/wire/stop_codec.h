#pragma once

#include <vector>

#include "fleet/protocol/emergency_stop.h"
#include "fleet/wire/byte_codec.h"

namespace mocha {

/// Emergency stops of a fleet as bytes, and back. Both throw std::invalid_argument, saying what is
/// wrong, for what cannot be encoded or decoded; whether it makes sense is for validate() to say.
void put_stops(ByteWriter& out, const std::vector<FleetStop>& stops);
std::vector<FleetStop> get_stops(ByteReader& in);

}  // namespace mocha
