#pragma once

#include <mocha_ugv/EmergencyStopState.h>
#include <mocha_ugv/FleetStops.h>

#include <string>

#include "fleet/protocol/emergency_stop.h"

namespace mocha {

mocha_ugv::FleetStops to_message(const FleetStops& stops, ros::Time stamp);

/// Throws std::invalid_argument, saying what is wrong, for what no robot can have meant
/// (validate()).
FleetStops stops_from_message(const mocha_ugv::FleetStops& message);

/// `robot`: its name. The message names the services that reset what holds.
mocha_ugv::EmergencyStopState state_of(const EmergencyStop& stop, const std::string& robot,
                                       ros::Time stamp);

}  // namespace mocha
