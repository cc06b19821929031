#pragma once

#include <ros/transport_hints.h>

namespace mocha {

/// For subscriptions on which something waits. TCP holds small messages back for up to 40 ms, to
/// send fewer packets; in that time a robot drives 4 cm, and a fast simulation makes many steps.
inline ros::TransportHints at_once() { return ros::TransportHints().tcpNoDelay(); }

}  // namespace mocha
