#pragma once

#include <cstddef>
#include <vector>

#include "perception/localization/scan_matcher.h"

namespace mocha {

/// What is known of the pose of one keyframe, seen from another.
struct Constraint {
  int from;
  int to;
  Pose relative;                ///< of `to` in the frame of `from`
  Eigen::Matrix3d information;  ///< of (x [m], y [m], yaw [rad]) of it; positive definite
  bool may_be_wrong;            ///< has a bounded say
};

/// The poses of keyframes, and the constraints between them.
class PoseGraph {
 public:
  /// Returns the keyframe's number: they count from 0.
  int add_keyframe(const Pose& pose);

  /// Between two different keyframes of the graph.
  void add(const Constraint& constraint);

  /// Adds all of another graph, its frame placed at `frame`: its keyframes after those of this one,
  /// with the constraints between them.
  void append(const PoseGraph& other, const Pose& frame);

  int size() const { return static_cast<int>(poses_.size()); }
  const std::vector<Pose>& poses() const { return poses_; }
  const std::vector<Constraint>& constraints() const { return constraints_; }

  /// One for each keyframe.
  void set_poses(std::vector<Pose> poses) { poses_ = std::move(poses); }

  /// How far a keyframe's place is from being known, as seen from another.
  struct Uncertainty {
    bool is_known = false;  ///< false: not connected, or less exactly than was asked for
    double position_variance_m2 = 0.0;
    double yaw_variance_rad2 = 0.0;
  };

  /// Of each keyframe, as seen from `keyframe`, along those constraints that tell most: an upper
  /// bound. Positions less exact than `sigma_m` are left out.
  std::vector<Uncertainty> uncertainties(int keyframe, double sigma_m) const;

  /// The keyframes within `distance_m` whose positions are known to `sigma_m`, as seen from
  /// `keyframe`, itself among them: the nearest first.
  std::vector<int> surely_near(int keyframe, double sigma_m, double distance_m) const;

 private:
  std::vector<Pose> poses_;
  std::vector<Constraint> constraints_;
  std::vector<std::vector<int>> of_keyframe_;  // constraints that end there
  std::vector<Uncertainty> added_;             // by each constraint
};

}  // namespace mocha
