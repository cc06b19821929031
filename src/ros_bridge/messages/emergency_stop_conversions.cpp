#include "ros_bridge/messages/emergency_stop_conversions.h"

#include <ros/names.h>

#include <boost/date_time/posix_time/posix_time.hpp>

#include "ros_bridge/messages/conversions.h"

namespace mocha {
namespace {

std::string since(double t) {
  return " since " + boost::posix_time::to_simple_string(ros_time(t).toBoost()) + " UTC";
}

std::string reset_by(const std::string& service) {
  return "; to reset it: rosservice call " + ros::names::resolve(service) + " false";
}

}  // namespace

mocha_ugv::FleetStops to_message(const FleetStops& stops, ros::Time stamp) {
  mocha_ugv::FleetStops message;
  message.header.stamp = stamp;
  message.agent = stops.agent;
  message.epoch = stops.epoch;
  for (const FleetStop& stop : stops.stops) {
    mocha_ugv::FleetStop each;
    each.agent = stop.agent;
    each.ordered = stop.ordered;
    each.released = stop.released;
    each.since = ros_time(stop.since_s);
    each.reason = stop.reason;
    message.stops.push_back(each);
  }
  return message;
}

FleetStops stops_from_message(const mocha_ugv::FleetStops& message) {
  FleetStops stops{message.agent, message.epoch, {}};
  for (const mocha_ugv::FleetStop& each : message.stops) {
    stops.stops.push_back(
        {each.agent, each.ordered, each.released, each.since.toSec(), each.reason});
  }
  validate(stops);
  return stops;
}

mocha_ugv::EmergencyStopState state_of(const EmergencyStop& stop, const std::string& robot,
                                       ros::Time stamp) {
  mocha_ugv::EmergencyStopState state;
  state.header.stamp = stamp;
  state.stopped = stop.stopped();
  state.robot = stop.record().robot;
  state.fleet = stop.fleet_stopped();
  state.resets = stop.record().resets;
  if (state.robot) {
    state.by.push_back(robot);
    state.message = "emergency stop of " + robot + since(stop.record().since_s) + ": " +
                    stop.record().reason + reset_by("emergency_stop");
  }
  for (const FleetStop& order : stop.holding()) {
    state.by.push_back(order.agent);
    state.message += (state.message.empty() ? "" : ". ") +
                     ("emergency stop of the fleet by " + order.agent) + since(order.since_s) +
                     ": " + order.reason;
  }
  if (state.fleet) state.message += reset_by("fleet/emergency_stop");
  if (!state.stopped) state.message = "no emergency stop";
  return state;
}

}  // namespace mocha
