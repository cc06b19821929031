#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "config/parameter_table.h"
#include "perception/localization/odometry_noise.h"
#include "perception/pose_graph/graph_file.h"
#include "perception/pose_graph/keyframe.h"
#include "perception/pose_graph/local_map.h"
#include "perception/pose_graph/loop_closer.h"
#include "perception/pose_graph/pose_graph.h"
#include "world/robot_model.h"

namespace mocha {

struct GraphMapperOptions {
  double keyframe_distance_m;
  double keyframe_turn_rad;
  std::size_t hits;  ///< of a scan, at most, that are aligned
  LoopCloserOptions loops;
  double max_speed;  ///< [m/s] no robot is faster
  OdometryNoise odometry;

  /// From the parameters of the same names, without units; the odometry's noise is the model's.
  static GraphMapperOptions from(const ParameterTable& values, const RobotModel& model);
};

/// Makes a map from drives, of a robot's scans and odometry.
///
/// Each scan is aligned with the keyframes around. Where the robot has moved on it becomes one
/// itself, constrained to those it agrees with. Where it comes back to a place that it has seen,
/// the loop is closed: all poses move to where all constraints agree best.
class GraphMapper {
 public:
  /// Goes on with a map that was driven before, if there is one; then begin() has to be called
  /// first.
  explicit GraphMapper(const GraphMapperOptions& options, DrivenMap map = {});

  /// A drive begins here, at the next scan; the first one of a map at its origin, if nothing else
  /// is said.
  void begin(const PoseEstimate& base);

  /// Takes the next scan, all of its hits in the order of the beams, and the pose of base_link in
  /// the odometry frame at its time. Returns base_link in the map. A jump of the odometry that no
  /// robot can drive is taken for an odometry that has begun anew. Throws std::invalid_argument,
  /// and changes nothing, for what ScanLocalizer::add() does not take.
  PoseEstimate add(const ScanHits& scan, const Pose& odometry);

  /// No scans come any more: loops that only they could have confirmed are closed as well.
  void finish();

  const PoseGraph& graph() const { return graph_; }
  const std::vector<ScanKeyframe>& keyframes() const { return keyframes_; }
  /// Share of the newest scan that the keyframes around explain.
  double explained() const { return explained_; }
  int loops_closed() const { return loops_closed_; }
  int loops_tried() const { return closer_.tried(); }
  /// Changes whenever poses of keyframes have moved.
  int corrections() const { return corrections_; }

 private:
  PoseEstimate predict(const Pose& odometry, double dt_s);
  Alignment align(const ScanHits& scan, const std::vector<Surfel>& surfels,
                  const PoseEstimate& prior);
  void take_reference();
  bool is_keyframe_due() const;
  void add_keyframe(const ScanHits& scan, const Pose& odometry, std::vector<Surfel> surfels,
                    const Alignment& place);
  void close(const std::vector<LoopClosure>& loops);
  Eigen::Matrix3d noise_of(const Pose& step) const;

  GraphMapperOptions options_;
  PoseGraph graph_;
  std::vector<ScanKeyframe> keyframes_;
  LoopCloser closer_;
  PoseEstimate start_;                               // of the drive
  bool is_beginning_ = true;                         // no scan of the drive was taken
  Pose pose_;                                        // of the newest scan
  Pose odometry_;                                    // at the newest scan
  double time_s_ = 0.0;                              // of the newest scan
  Pose since_;                                       // by the odometry, since the newest keyframe
  Eigen::Matrix3d jumps_ = Eigen::Matrix3d::Zero();  // what jumps of the odometry made unsure
  std::optional<LocalMap> reference_;                // empty: has to be made
  double explained_ = 0.0;
  int loops_closed_ = 0;
  int corrections_ = 0;
};

}  // namespace mocha
