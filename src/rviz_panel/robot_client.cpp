#include "rviz_panel/robot_client.h"

#include <ros/master.h>
#include <ros/service.h>
#include <std_srvs/SetBool.h>

#include <set>
#include <utility>

namespace mocha {
namespace {

const std::string kToldByRobots = "/planner_status";  // ends the name of a topic of every robot

const char* service_of(RobotClient::Switch which) {
  switch (which) {
    case RobotClient::Switch::kPause:
      return "pause";
    case RobotClient::Switch::kEmergencyStop:
      return "emergency_stop";
    case RobotClient::Switch::kFleetEmergencyStop:
      return "fleet/emergency_stop";
  }
  return "";
}

}  // namespace

std::vector<std::string> robots_on_master() {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  std::set<std::string> names;
  for (const auto& topic : topics) {
    const std::size_t end = topic.name.rfind(kToldByRobots);
    const bool is_robots = topic.datatype == "mocha_ugv/PlannerStatus" &&
                           end != std::string::npos && end > 0 &&
                           end + kToldByRobots.size() == topic.name.size();
    if (is_robots) names.insert(topic.name.substr(1, end - 1));
  }
  return {names.begin(), names.end()};
}

RobotClient::RobotClient(std::string name, BackgroundCalls& calls,
                         std::function<void(std::string)> say)
    : name_(std::move(name)), calls_(calls), say_(std::move(say)), node_("/" + name_) {
  const auto listen = [this](const std::string& topic, auto& newest) {
    using Newest = typename std::decay_t<decltype(newest)>::value_type;
    const boost::function<void(const boost::shared_ptr<const Newest>&)> take =
        [&newest](const boost::shared_ptr<const Newest>& message) { newest = *message; };
    subscribers_.push_back(node_.subscribe<Newest>(topic, 10, take));
  };
  listen("planner_status", news_.planner);
  listen("replanner_status", news_.replanner);
  listen("emergency_stop_state", news_.stop);
  listen("localization", news_.localization);
  listen("candidates", candidates_);
  goals_ = node_.advertise<geometry_msgs::PoseStamped>("move_base_simple/goal", 1);
  waypoints_ = node_.advertise<nav_msgs::Path>("waypoints", 1);
  patrols_ = node_.advertise<nav_msgs::Path>("patrol", 1);
}

void RobotClient::hear(const diagnostic_msgs::DiagnosticStatus& status, ros::Time now) {
  if (status.hardware_id != name_) return;
  for (const auto& value : status.values) {
    if (value.key != "state" || status.name.find("global_planner") == std::string::npos) continue;
    news_.state = value.value;
    news_.heard = now;
  }
}

void RobotClient::turn(Switch which, bool on) {
  const std::string service = "/" + name_ + "/" + service_of(which);
  calls_.add([say = say_, name = name_, service, on] {
    std_srvs::SetBool call;
    call.request.data = on;
    if (!ros::service::call(service, call)) {
      say(name + ": does not answer on " + service);
    } else {
      say(name + ": " + (call.response.success ? "" : "refused: ") + call.response.message);
    }
  });
}

}  // namespace mocha
