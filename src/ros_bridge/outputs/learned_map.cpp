#include "ros_bridge/outputs/learned_map.h"

#include <ros/console.h>

#include <utility>

#include "perception/mapping/map_error.h"
#include "perception/mapping/map_image.h"

namespace mocha {
namespace {

constexpr double kLearnedPeriod_s = 30.0;

}  // namespace

LearnedMap::LearnedMap(const LearningLocalizer& localizer, std::string path)
    : localizer_(localizer), path_(std::move(path)) {}

LearnedMap::~LearnedMap() { save(); }

void LearnedMap::step(ros::Time now) {
  if (now < saved_ + ros::Duration(kLearnedPeriod_s) && now >= saved_) return;
  saved_ = now;
  save();
}

void LearnedMap::save() {
  if (path_.empty() || saved_changes_ == localizer_.changed()) return;
  try {
    save_map_image(localizer_.map(), path_);
    saved_changes_ = localizer_.changed();
  } catch (const MapError& error) {
    ROS_ERROR("What was learnt of the map is not saved: %s", error.what());
  }
}

}  // namespace mocha
