#include "ros_bridge/outputs/local_outputs.h"

#include "ros_bridge/messages/conversions.h"
#include "ros_bridge/rviz/local_drawing.h"

namespace mocha {
namespace {

constexpr double kDrawEvery_s = 0.2;
constexpr double kFailureShown_s = 1.0;

/// Whether a plan is what local planning made.
bool follows(const Motion& plan, const LocalPlan& local) {
  return local.reason == PlanReason::kSolved && !plan.empty() &&
         plan.start_time() == local.motion.start_time() &&
         plan.end_time() == local.motion.end_time();
}

}  // namespace

LocalOutputs::LocalOutputs(ros::NodeHandle& node, const RobotIdentity& identity,
                           const RobotModel& model, double horizon_s)
    : identity_(identity),
      radius_m_(model.footprint.circumscribed_radius_m()),
      braking_(model.braking()),
      horizon_s_(horizon_s),
      plans_(node.advertise<mocha_ugv::Trajectory>("local_trajectory", 2, true)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("local_markers", 2, true)) {}

void LocalOutputs::show(const LocalReplanner::Output& output, double took_s, const Motion& plan,
                        const Predictions& predictions, ros::Time now) {
  if (output.local) {
    counts_.switches +=
        output.swerves && output.local->switches_class && now.toSec() < local_.rejoins_s;
    counts_.followed += output.swerves;
    counts_.solved += output.local->reason == PlanReason::kSolved;
    record_.add(PlanningEffort::of(*output.local, took_s));
    local_ = *output.local;
    planned_at_ = now;
    if (output.swerves) publish(plan, now);
  }
  if (output.keeps_plan) publish(plan, now);
  draw(plan, predictions, now);
}

void LocalOutputs::publish(const Motion& plan, ros::Time now) {
  mocha_ugv::Trajectory message;
  message.header.stamp = now;
  message.header.frame_id = identity_.map_frame;
  message.state = mocha_ugv::Trajectory::PLANNED;
  message.agent = identity_.name;
  message.sequence = static_cast<std::uint32_t>(counts_.followed);
  message.footprint_radius = radius_m_;
  to_message(braking_, message);
  to_message(plan, message);
  plans_.publish(message);
}

void LocalOutputs::draw(const Motion& plan, const Predictions& predictions, ros::Time now) {
  const bool swerves = follows(plan, local_) && now.toSec() < local_.rejoins_s;
  const bool failed = record_.plans() > 0 && !follows(plan, local_) &&
                      (now - planned_at_).toSec() < kFailureShown_s;
  if (predictions.empty() && !swerves && !failed) {
    clear(now);
    return;
  }
  if ((now - drawn_at_).toSec() < kDrawEvery_s) return;
  Drawing drawing(identity_.map_frame, now);
  for (const auto& thing : predictions) drawing.add_obstacle(*thing, now.toSec(), horizon_s_);
  if (swerves || failed) draw_local_plan(local_, drawing);
  drawings_.publish(drawing.markers());
  drawn_at_ = now;
  shows_ = true;
}

void LocalOutputs::clear(ros::Time now) {
  if (!shows_) return;
  drawings_.publish(Drawing(identity_.map_frame, now).markers());
  shows_ = false;
}

}  // namespace mocha
