#pragma once

#include <vector>

#include "fleet/byte_codec.h"
#include "fleet/emergency_stop.h"

namespace mocha {

/// Emergency stops of a fleet as bytes, and back. Both throw std::invalid_argument, saying what is
/// wrong, for what cannot be said or was not; whether it makes sense is for validate() to say.
void put_stops(ByteWriter& out, const std::vector<FleetStop>& stops);
std::vector<FleetStop> get_stops(ByteReader& in);

}  // namespace mocha
