#include "world/moving_obstacle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "trajectory/bernstein.h"

namespace mocha {
namespace {

/// Upper bound on |velocity| over a drive, from the control points of its derivative in Bernstein
/// form.
double speed_bound(const PlanarPath& path) {
  double bound = 0.0;
  for (int i = 0; i < path.pieces(); ++i) {
    const auto velocity = derivative(to_bernstein(path.piece(i)));
    bound = std::max(bound, velocity.colwise().norm().maxCoeff() / path.piece_duration(i));
  }
  return bound;
}

void require(bool condition, const std::string& name, const char* what) {
  if (!condition) throw std::invalid_argument("moving obstacle " + name + ": " + what);
}

}  // namespace

PeerObstacle::PeerObstacle(std::string name, std::shared_ptr<const Motion> motion, double radius_m)
    : name_(std::move(name)), motion_(std::move(motion)), radius_m_(radius_m), max_speed_(0.0) {
  require(motion_ != nullptr && !motion_->empty(), name_, "has no motion");
  require(std::isfinite(radius_m_) && radius_m_ >= 0.0, name_,
          "the radius is not finite and >= 0 m");
  for (const Phase& phase : motion_->phases()) {
    if (const auto* drive = std::get_if<DrivePhase>(&phase)) {
      max_speed_ = std::max(max_speed_, speed_bound(drive->path));
    }
  }
}

MovingObstacle::Disc PeerObstacle::at(double t) const {
  const MotionState state = motion_->at(t);
  return {state.pose.position, state.velocity, radius_m_, 0.0};
}

double PeerObstacle::max_closing_speed(double t) const {
  return t >= rest_time() ? 0.0 : max_speed_;
}

double PeerObstacle::rest_time() const { return motion_->end_time(); }

PredictedDisc::PredictedDisc(std::string name, double t0, const Vector2& centre,
                             const Vector2& velocity, double radius_m, double radius_rate)
    : name_(std::move(name)),
      t0_(t0),
      centre_(centre),
      velocity_(velocity),
      radius_m_(radius_m),
      radius_rate_(radius_rate) {
  require(std::isfinite(t0_) && centre_.allFinite() && velocity_.allFinite(), name_,
          "time, place or velocity is not finite");
  require(std::isfinite(radius_m_) && radius_m_ >= 0.0, name_,
          "the radius is not finite and >= 0 m");
  require(std::isfinite(radius_rate_) && radius_rate_ >= 0.0, name_,
          "the growth of the radius is not finite and >= 0 m/s");
}

MovingObstacle::Disc PredictedDisc::at(double t) const {
  const double ahead = std::max(0.0, t - t0_);
  return {centre_ + (t - t0_) * velocity_, velocity_, radius_m_ + radius_rate_ * ahead,
          radius_rate_};
}

double PredictedDisc::max_closing_speed(double) const { return velocity_.norm() + radius_rate_; }

double PredictedDisc::rest_time() const { return std::numeric_limits<double>::infinity(); }

}  // namespace mocha
