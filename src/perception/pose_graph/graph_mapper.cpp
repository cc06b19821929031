#include "perception/pose_graph/graph_mapper.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "perception/pose_graph/graph_optimizer.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kSlack_m = 0.5;  // of a step that no robot can drive
constexpr double kSlip = 0.05;
constexpr double kStepNoise_m = 0.01;
constexpr double kStepNoise_rad = 0.004;
constexpr double kRestartSigma_m = 0.3;
constexpr double kRestartSigma_rad = 0.3;

Eigen::Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

}  // namespace

GraphMapperOptions GraphMapperOptions::from(const ParameterTable& values, const RobotModel& model) {
  GraphMapperOptions options;
  options.keyframe_distance_m = values.number("keyframe_distance");
  options.keyframe_turn_rad = values.number("keyframe_turn");
  options.hits = values.integer("hits");
  options.loops = {values.number("loop_radius"), values.number("loop_quality")};
  options.max_speed = model.limits.max_speed;
  options.odometry = OdometryNoise(model, kSlip);
  return options;
}

GraphMapper::GraphMapper(const GraphMapperOptions& options, DrivenMap map)
    : options_(options),
      graph_(std::move(map.graph)),
      keyframes_(std::move(map.keyframes)),
      closer_(options.loops),
      start_{{}, diagonal(kStepNoise_m, kStepNoise_rad)} {
  find_surfels(keyframes_, options_.hits);
}

void GraphMapper::begin(const PoseEstimate& base) {
  start_ = base;
  is_beginning_ = true;
}

Eigen::Matrix3d GraphMapper::noise_of(const Pose& step) const {
  return options_.odometry.of(step) + diagonal(kStepNoise_m, kStepNoise_rad);
}

PoseEstimate GraphMapper::add(const ScanHits& scan, const Pose& odometry) {
  check_measured(scan, odometry);
  if (!is_beginning_ && scan.time_s <= time_s_)
    throw std::invalid_argument("the scan is not newer than the one before");
  const PoseEstimate prior = is_beginning_ ? start_ : predict(odometry, scan.time_s - time_s_);
  pose_ = prior.pose;
  time_s_ = scan.time_s;
  odometry_ = odometry;
  std::vector<Surfel> surfels = surfels_of(scan, options_.hits);
  const Alignment place = align(scan, surfels, prior);
  explained_ = place.explained;
  const bool is_placed = place.explained >= LocalMap::kExplained;
  if (is_placed) pose_ = place.pose;
  if (is_keyframe_due()) {
    add_keyframe(scan, odometry, std::move(surfels), place);
    close(closer_.look(graph_, keyframes_, graph_.size() - 1));
    pose_ = graph_.poses().back();
  }
  is_beginning_ = false;
  return {pose_, is_placed ? place.covariance : prior.covariance};
}

PoseEstimate GraphMapper::predict(const Pose& odometry, double dt_s) {
  Pose step = relative(odometry_, odometry);
  if (step.position.norm() > options_.max_speed * dt_s + kSlack_m) {
    step = Pose{};
    jumps_ += diagonal(kRestartSigma_m, kRestartSigma_rad);
  }
  since_ = composed(since_, step);
  return {composed(pose_, step), noise_of(since_) + jumps_};
}

bool GraphMapper::is_keyframe_due() const {
  if (is_beginning_) return true;
  const Pose moved = relative(graph_.poses().back(), pose_);
  return moved.position.norm() >= options_.keyframe_distance_m ||
         std::abs(moved.yaw_rad) >= options_.keyframe_turn_rad;
}

/// The keyframes around the newest one; at the beginning of another drive, around its start.
void GraphMapper::take_reference() {
  int centre = graph_.size() - 1;
  if (is_beginning_) {
    const auto far_m = [&](const Pose& pose) { return (pose.position - pose_.position).norm(); };
    const auto nearest =
        std::min_element(graph_.poses().begin(), graph_.poses().end(),
                         [&](const Pose& a, const Pose& b) { return far_m(a) < far_m(b); });
    centre = static_cast<int>(nearest - graph_.poses().begin());
  }
  reference_.emplace(chosen(keyframes_around(centre, graph_.size(), graph_), graph_, keyframes_));
}

Alignment GraphMapper::align(const ScanHits& scan, const std::vector<Surfel>& surfels,
                             const PoseEstimate& prior) {
  if (keyframes_.empty()) return {};
  if (!reference_) take_reference();
  return reference_->place(scan, surfels, prior);
}

void GraphMapper::add_keyframe(const ScanHits& scan, const Pose& odometry,
                               std::vector<Surfel> surfels, const Alignment& place) {
  const int id = graph_.add_keyframe(pose_);
  keyframes_.push_back({odometry, scan, std::move(surfels)});
  if (!is_beginning_) graph_.add({id - 1, id, since_, (noise_of(since_) + jumps_).inverse(), true});
  if (place.explained >= LocalMap::kExplained) link(graph_, id, place, is_beginning_);
  since_ = Pose{};
  jumps_.setZero();
  reference_.reset();
}

void GraphMapper::close(const std::vector<LoopClosure>& loops) {
  if (loops.empty()) return;
  for (const LoopClosure& loop : loops) link(graph_, loop.keyframe, loop.place, true);
  optimize(graph_);
  loops_closed_ += static_cast<int>(loops.size());
  ++corrections_;
}

void GraphMapper::finish() {
  close(closer_.take_unconfirmed());
  if (!keyframes_.empty()) optimize(graph_);
  ++corrections_;
  reference_.reset();
}

}  // namespace mocha
