#include "world/moving/moving_obstacle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "trajectory/bernstein.h"
#include "trajectory/piece_hull.h"

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

/// Upper bound on |acceleration| over a drive.
double acceleration_bound(const PlanarPath& path) {
  double bound = 0.0;
  for (int i = 0; i < path.pieces(); ++i) {
    const auto hull = piece_hull(path.piece(i), path.piece_duration(i));
    bound = std::max(bound, hull.acceleration.colwise().norm().maxCoeff());
  }
  return bound;
}

// What Motion lets pass where phases meet, and at the end.
constexpr double kJump_m = 1e-3;
constexpr double kSpeedJump = 0.01;  // m/s

void require_of_mover(bool condition, const std::string& name, const char* what) {
  if (!condition) throw std::invalid_argument("moving obstacle " + name + ": " + what);
}

}  // namespace

Eigen::AlignedBox2d MovingObstacle::box() const {
  const Vector2 everywhere = Vector2::Constant(std::numeric_limits<double>::infinity());
  return {-everywhere, everywhere};
}

PeerObstacle::PeerObstacle(std::string name, std::shared_ptr<const Motion> motion, double radius_m,
                           const Braking& braking, double mistimed_s)
    : name_(std::move(name)),
      motion_(std::move(motion)),
      radius_m_(radius_m),
      braking_(braking),
      max_speed_(0.0) {
  require_of_mover(motion_ != nullptr && !motion_->empty(), name_, "has no motion");
  require_of_mover(std::isfinite(radius_m_) && radius_m_ >= 0.0, name_,
                   "the radius is not finite and >= 0 m");
  require_of_mover(std::isfinite(mistimed_s) && mistimed_s >= 0.0, name_,
                   "the time that it may be early or late is not finite and >= 0 s");
  for (const Phase& phase : motion_->phases()) {
    const auto* drive = std::get_if<DrivePhase>(&phase);
    if (drive != nullptr) max_speed_ = std::max(max_speed_, speed_bound(drive->path));
    max_accelerations_.push_back(drive != nullptr ? acceleration_bound(drive->path) : 0.0);
  }
  radius_m_ += mistimed_s * max_speed_;
}

MovingObstacle::Disc PeerObstacle::at(double t) const {
  return {motion_->position(t), motion_->velocity(t), radius_m_, 0.0};
}

double PeerObstacle::max_closing_speed(double t) const {
  return t >= rest_time() ? 0.0 : max_speed_;
}

/// A path with accelerations of up to a is up to a h^2 / 8 off its chord after a time h; a jump of
/// the speed adds up to a quarter of it times h, a jump of the place all of it.
double PeerObstacle::chord_error_m(double from_s, double until_s) const {
  const double span_s = std::max(0.0, until_s - from_s);
  double acceleration = 0.0;
  double jumps_m = 0.0;
  double speed_jumps = 0.0;
  const auto count_joint = [&](double t, double jump_m, double speed_jump) {
    if (!(from_s < t && t <= until_s)) return;
    jumps_m += jump_m;
    speed_jumps += speed_jump;
  };
  const double start_s = motion_->start_time();
  count_joint(start_s, 0.0, motion_->at(start_s).velocity.norm());
  count_joint(rest_time(), 0.0, kSpeedJump);
  for (std::size_t i = 0; i < max_accelerations_.size(); ++i) {
    const double begin_s = motion_->phase_start_time(static_cast<int>(i));
    const double end_s = motion_->phase_start_time(static_cast<int>(i) + 1);
    if (begin_s < until_s && end_s > from_s)
      acceleration = std::max(acceleration, max_accelerations_[i]);
    if (i > 0) count_joint(begin_s, kJump_m, kSpeedJump);
  }
  return 0.125 * acceleration * span_s * span_s + 0.25 * speed_jumps * span_s + jumps_m;
}

double PeerObstacle::rest_time() const { return motion_->end_time(); }

Eigen::AlignedBox2d PeerObstacle::box() const {
  const Vector2 radius_m = Vector2::Constant(radius_m_);
  return {motion_->box().min() - radius_m, motion_->box().max() + radius_m};
}

PredictedDisc::PredictedDisc(std::string name, double t0, const Vector2& centre,
                             const Vector2& velocity, double radius_m, double radius_rate,
                             double growth_s)
    : name_(std::move(name)),
      t0_(t0),
      centre_(centre),
      velocity_(velocity),
      radius_m_(radius_m),
      radius_rate_(radius_rate),
      growth_s_(growth_s) {
  require_of_mover(std::isfinite(t0_) && centre_.allFinite() && velocity_.allFinite(), name_,
                   "time, place or velocity is not finite");
  require_of_mover(std::isfinite(radius_m_) && radius_m_ >= 0.0, name_,
                   "the radius is not finite and >= 0 m");
  require_of_mover(std::isfinite(radius_rate_) && radius_rate_ >= 0.0, name_,
                   "the growth of the radius is not finite and >= 0 m/s");
  require_of_mover(growth_s_ >= 0.0, name_, "the time for which the radius grows is not >= 0 s");
}

MovingObstacle::Disc PredictedDisc::at(double t) const {
  const double ahead_s = t - t0_;
  const bool grows = ahead_s >= 0.0 && ahead_s < growth_s_;
  return {centre_ + ahead_s * velocity_, velocity_,
          radius_m_ + radius_rate_ * std::clamp(ahead_s, 0.0, growth_s_),
          grows ? radius_rate_ : 0.0};
}

double PredictedDisc::max_closing_speed(double t) const {
  return velocity_.norm() + (t - t0_ < growth_s_ ? radius_rate_ : 0.0);
}

/// The centre moves uniformly, and the radius is convex in time but where its growth ends.
double PredictedDisc::chord_error_m(double from_s, double until_s) const {
  const double before_s = t0_ + growth_s_ - from_s;
  const double after_s = until_s - from_s - before_s;
  if (!(before_s > 0.0 && after_s > 0.0)) return 0.0;
  return radius_rate_ * before_s * after_s / (before_s + after_s);
}

double PredictedDisc::rest_time() const { return std::numeric_limits<double>::infinity(); }

}  // namespace mocha
