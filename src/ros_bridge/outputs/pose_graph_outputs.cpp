#include "ros_bridge/outputs/pose_graph_outputs.h"

#include <ros/console.h>
#include <visualization_msgs/MarkerArray.h>

#include <utility>

#include "ros_bridge/messages/pose_graph_messages.h"
#include "ros_bridge/rviz/pose_graph_drawing.h"

namespace mocha {
namespace {

constexpr double kSavingPeriod_s = 30.0;

}  // namespace

PoseGraphOutputs::PoseGraphOutputs(ros::NodeHandle& node, const RobotIdentity& robot,
                                   const MappingSession& session, std::string path)
    : frame_(robot.map_frame),
      path_(std::move(path)),
      session_(session),
      graphs_(node.advertise<mocha_ugv::PoseGraph>("pose_graph", 2, true)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("pose_graph_markers", 2, true)),
      service_(node.advertiseService("get_keyframes", &PoseGraphOutputs::on_get, this)) {}

PoseGraphOutputs::~PoseGraphOutputs() { save(); }

void PoseGraphOutputs::step(ros::Time now) {
  const GraphMapper& mapper = session_.mapper();
  if (mapper_ != &mapper || keyframes_ != mapper.graph().size() ||
      corrections_ != mapper.corrections()) {
    mapper_ = &mapper;
    keyframes_ = mapper.graph().size();
    corrections_ = mapper.corrections();
    is_saved_ = session_.is_looking();
    publish(now);
  }
  if (now < saved_ + ros::Duration(kSavingPeriod_s) && now >= saved_) return;
  saved_ = now;
  save();
}

void PoseGraphOutputs::publish(ros::Time now) {
  mocha_ugv::PoseGraph message;
  message.header.frame_id = frame_;
  message.header.stamp = now;
  message.loops = session_.mapper().loops_closed();
  to_message(session_.mapper().graph().poses(), message);
  graphs_.publish(message);
  Drawing drawing(frame_, now);
  draw_pose_graph(session_.mapper().graph(), drawing);
  drawings_.publish(drawing.markers());
}

void PoseGraphOutputs::save() {
  if (path_.empty() || is_saved_) return;
  try {
    save_driven_map({session_.mapper().graph(), session_.mapper().keyframes()}, path_);
    is_saved_ = true;
  } catch (const MapError& error) {
    ROS_ERROR("The pose graph is not saved: %s", error.what());
  }
}

bool PoseGraphOutputs::on_get(mocha_ugv::GetKeyframes::Request& request,
                              mocha_ugv::GetKeyframes::Response& response) {
  const std::vector<ScanKeyframe>& keyframes = session_.mapper().keyframes();
  for (std::size_t i = request.first; i < keyframes.size(); ++i)
    response.keyframes.push_back(to_message(keyframes[i].scan));
  return true;
}

}  // namespace mocha
