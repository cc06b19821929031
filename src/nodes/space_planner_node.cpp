#include <diagnostic_updater/diagnostic_updater.h>
#include <geometry_msgs/PointStamped.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "ros_bridge/inputs/refusals.h"
#include "ros_bridge/messages/space_conversions.h"
#include "ros_bridge/runtime/parameters.h"
#include "ros_bridge/runtime/robot_identity.h"
#include "ros_bridge/runtime/run_node.h"
#include "ros_bridge/rviz/space_drawing.h"
#include "stack/space_planning.h"

namespace mocha {
namespace {

constexpr double kDiagnosticsPeriod_s = 1.0;
constexpr std::uint32_t kMostClasses = 50;
constexpr std::size_t kMostBalls = 100;

/// Plans in an OctoMap in three dimensions, when it is asked to: by its service, or by points
/// clicked in rviz, each the goal from the one before.
class SpacePlannerNode {
 public:
  SpacePlannerNode(ros::NodeHandle& node, const ParameterTable& values)
      : identity_(robot_identity()),
        radius_m_(values.number("radius")),
        paths_(node.advertise<nav_msgs::Path>("space_path", 1, true)),
        trajectories_(node.advertise<mocha_ugv::SpaceTrajectory>("space_trajectory", 1, true)),
        markers_(node.advertise<visualization_msgs::MarkerArray>("space_markers", 1, true)),
        cells_(node.advertise<sensor_msgs::PointCloud2>("space_cells", 1, true)) {
    if (values.text("map_file").empty())
      throw ParameterError("parameter `map_file` is not set: no map to plan in");
    planner_ = make_space_planner(values, {}, [] { return ros::SteadyTime::now().toSec(); });
    cells_.publish(solid_cells_message(planner_->field(), identity_.map_frame, ros::Time::now()));
    diagnostics_.setHardwareID(identity_.name);
    diagnostics_.add("planning in space", this, &SpacePlannerNode::diagnose);
    timer_ = node.createTimer(ros::Duration(kDiagnosticsPeriod_s),
                              [this](const ros::TimerEvent&) { diagnostics_.update(); });
    clicks_ = node.subscribe("clicked_point", 5, &SpacePlannerNode::on_click, this);
    service_ = node.advertiseService("plan_in_space", &SpacePlannerNode::on_request, this);
  }

 private:
  bool on_request(mocha_ugv::PlanInSpace::Request& request,
                  mocha_ugv::PlanInSpace::Response& response) {
    SpaceQuery query{from_message(request.start), from_message(request.goal)};
    query.classes = static_cast<int>(std::min(request.classes, kMostClasses));
    try {
      if (request.moving.size() > kMostBalls)
        throw std::invalid_argument("moving: more than " + std::to_string(kMostBalls) + " balls");
      for (const mocha_ugv::MovingBall& ball : request.moving)
        query.moving.push_back(from_message(ball));
    } catch (const std::invalid_argument& error) {
      SpacePlan refused;
      refused.reason = PlanReason::kInvalidInput;
      refused.message = error.what();
      response = publish(refused, query.start);
      return true;
    }
    response = plan(std::move(query));
    return true;
  }

  void on_click(const geometry_msgs::PointStamped& click) {
    const Eigen::Vector3d place = from_message(click.point);
    if (click.header.frame_id != identity_.map_frame || !place.allFinite()) {
      refusals_.add("clicked_point: is not in the frame " + identity_.map_frame +
                    ", or not finite");
      return;
    }
    try {
      if (clicked_) plan({*clicked_, place});
    } catch (const std::exception& error) {  // such as no memory: it must not end the node
      refusals_.add(std::string("clicked_point: ") + error.what());
    }
    clicked_ = place;
  }

  mocha_ugv::PlanInSpace::Response plan(SpaceQuery query) {
    query.should_stop = [] { return !ros::ok(); };
    return publish(planner_->plan(query), query.start);
  }

  /// Every plan, and every refusal of one, goes this way.
  mocha_ugv::PlanInSpace::Response publish(const SpacePlan& plan, const Eigen::Vector3d& start) {
    took_s_ = plan.took_s;
    last_reason_ = plan.reason;
    ++plans_[plan.reason];
    last_ = to_text(plan.reason);
    if (plan.message != last_) last_ += ": " + plan.message;
    const ros::Time now = ros::Time::now();
    const auto response = to_message(plan, radius_m_, identity_.map_frame, now);
    paths_.publish(response.path);
    trajectories_.publish(response.trajectory);
    const auto region = plan.candidates.empty() ? nullptr : planner_->region_of(start);
    markers_.publish(space_markers(plan, region ? region->curves() : ObstacleCurves(),
                                   planner_->field(), identity_.map_frame, now));
    if (plan.reason == PlanReason::kInvalidInput) refusals_.add(plan.message);
    if (response.success) {
      ROS_INFO("%zu classes in %.0f ms, the cheapest of %.2f m in %.2f s",
               response.candidates.size(), 1e3 * took_s_, response.candidates.front().length,
               response.candidates.front().duration);
    } else {
      ROS_WARN("No plan: %s", last_.c_str());
    }
    return response;
  }

  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
    using diagnostic_msgs::DiagnosticStatus;
    status.summary(
        last_reason_ == PlanReason::kSolved ? DiagnosticStatus::OK : DiagnosticStatus::WARN, last_);
    int plans = 0;
    for (const auto& [reason, times] : plans_) plans += times;
    status.add("plans", plans);
    for (const auto& [reason, times] : plans_) {
      const std::string kind = reason == PlanReason::kSolved ? "" : "not solved: ";
      status.add(kind + to_text(reason), times);
    }
    status.add("time of the last plan [s]", took_s_);
    for (const auto& [reason, times] : refusals_.counts()) status.add("refused: " + reason, times);
  }

  const RobotIdentity identity_;
  const double radius_m_;
  std::unique_ptr<SpacePlanner> planner_;
  std::optional<Eigen::Vector3d> clicked_;
  Refusals refusals_;
  std::map<PlanReason, int> plans_ = {{PlanReason::kSolved, 0}};
  PlanReason last_reason_ = PlanReason::kSolved;
  std::string last_ = "nothing was asked yet";
  double took_s_ = 0.0;

  ros::Publisher paths_;
  ros::Publisher trajectories_;
  ros::Publisher markers_;
  ros::Publisher cells_;
  diagnostic_updater::Updater diagnostics_;
  ros::Timer timer_;
  ros::Subscriber clicks_;
  ros::ServiceServer service_;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::run_node<mocha::SpacePlannerNode>(argc, argv, "space_planner");
}
