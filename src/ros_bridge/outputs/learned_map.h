#pragma once

#include <ros/time.h>

#include <string>

#include "perception/localization/learning_localizer.h"

namespace mocha {

/// What a localiser has learnt of its map, as a file that is written every half a minute, and in
/// the end.
class LearnedMap {
 public:
  /// The localiser must outlive this. No file where `path` is empty.
  LearnedMap(const LearningLocalizer& localizer, std::string path);
  ~LearnedMap();

  void step(ros::Time now);

 private:
  void save();

  const LearningLocalizer& localizer_;
  const std::string path_;
  int saved_changes_ = 0;
  ros::Time saved_;
};

}  // namespace mocha
