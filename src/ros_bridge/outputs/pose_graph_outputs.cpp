#include "ros_bridge/outputs/pose_graph_outputs.h"

#include <ros/console.h>
#include <visualization_msgs/MarkerArray.h>

#include <utility>

#include "ros_bridge/messages/pose_graph_messages.h"
#include "ros_bridge/runtime/file_service.h"
#include "ros_bridge/rviz/pose_graph_drawing.h"

namespace mocha {
namespace {

constexpr double kSavingPeriod_s = 30.0;

/// Throws what keeps a map of another drive from being merged.
void check(MapMatch::Fault fault, const std::string& path) {
  if (fault == MapMatch::Fault::kNothingInCommon)
    throw MapError(path + ": has no places in common with this map, as far as one can tell");
  if (fault == MapMatch::Fault::kAmbiguous)
    throw MapError(path + ": fits this map in several ways");
}

}  // namespace

PoseGraphOutputs::PoseGraphOutputs(ros::NodeHandle& node, const RobotIdentity& robot,
                                   MappingSession& session, std::string path)
    : frame_(robot.map_frame),
      path_(std::move(path)),
      session_(session),
      graphs_(node.advertise<mocha_ugv::PoseGraph>("pose_graph", 2, true)),
      drawings_(node.advertise<visualization_msgs::MarkerArray>("pose_graph_markers", 2, true)),
      services_{node.advertiseService("get_keyframes", &PoseGraphOutputs::on_get, this),
                node.advertiseService("merge_pose_graph", &PoseGraphOutputs::on_merge, this)} {}

PoseGraphOutputs::~PoseGraphOutputs() {
  session_.finish();
  is_saved_ = session_.is_looking();
  save();
}

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

bool PoseGraphOutputs::on_merge(mocha_ugv::LoadMap::Request& request,
                                mocha_ugv::LoadMap::Response& response) {
  return answer(response, [&] {
    if (session_.is_looking()) throw MapError("the robot's place in its own map is not known yet");
    const std::string path = absolute(request.path);
    const int before = session_.mapper().graph().size();
    check(session_.merge(load_driven_map(path)), path);
    const int more = session_.mapper().graph().size() - before;
    return "merged " + path + ": " + std::to_string(more) + " keyframes more";
  });
}

}  // namespace mocha
