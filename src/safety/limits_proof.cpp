#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "safety/certificate.h"
#include "safety/drive_piece.h"
#include "safety/limit_search.h"
#include "safety/worst_value.h"
#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

constexpr double kCourseStep_s =
    1e-3;  // a velocity that turns by 90 degrees in less passes through zero
constexpr double kOnlyHulls = 1.0;         // no halving: what the control points say
constexpr double kWheelResolution = 1e-5;  // of normalised time
constexpr double kHeadingJump_rad = 0.01;  // as between the phases of a motion

/// First u at which the velocity may vanish: where halving down to `resolution` finds no half-plane
/// for its directions.
std::optional<double> first_stop(const Bernstein<2, 4>& course, double resolution) {
  const Vector2 mean = course.rowwise().sum();
  if (((mean.transpose() * course).array() > 0.0).all()) return std::nullopt;
  if (!(resolution < 1.0)) return 0.0;
  const auto [before, after] = split(course);
  if (const auto u = first_stop(before, 2.0 * resolution)) return 0.5 * *u;
  if (const auto u = first_stop(after, 2.0 * resolution)) return 0.5 + 0.5 * *u;
  return std::nullopt;
}

/// With tau the duration, the yaw rate is (c x c') / (tau |c|^2) for the course c, whatever zeros
/// the velocity has at rests: they cancel. No quotient is formed.
std::optional<double> first_swerve(const DrivePiece& piece, int side, double max_yaw_rate,
                                   double resolution = 1e-7) {
  const Bernstein<1, 7> turning = cross(piece.course, derivative(piece.course));
  Bernstein<1, 8> excess = -max_yaw_rate * piece.duration_s * squared_norm(piece.course);
  for (int j = 0; j <= 8; ++j) {  // elevated to degree 8
    if (j > 0) excess[j] += side * turning[j - 1] * j / 8.0;
    if (j < 8) excess[j] += side * turning[j] * (8 - j) / 8.0;
  }
  return first_positive(excess, resolution);
}

std::pair<DrivePiece, DrivePiece> in_halves(const DrivePiece& piece) {
  std::pair<DrivePiece, DrivePiece> halves(piece, piece);
  std::tie(halves.first.velocity, halves.second.velocity) = split(piece.velocity);
  std::tie(halves.first.course, halves.second.course) = split(piece.course);
  for (DrivePiece* half : {&halves.first, &halves.second}) {
    half->velocity *= 0.5;  // by a normalised time that now runs twice as fast
    half->duration_s *= 0.5;
  }
  return halves;
}

/// First u at which the faster wheel exceeds its limit, |v| + track / 2 |omega|: on each part, the
/// wheel leaves to the yaw rate what the part's highest speed does not need.
std::optional<double> first_overspin(const DrivePiece& piece, const MotionLimits& limits,
                                     double resolution) {
  const double to_spare = kLimitSlack * limits.max_wheel_speed - piece.max_speed();
  const double yaw_rate = 2.0 * to_spare / limits.track_m;
  const bool proved = to_spare >= 0.0 && !first_swerve(piece, -1, yaw_rate, kOnlyHulls) &&
                      !first_swerve(piece, 1, yaw_rate, kOnlyHulls);
  if (proved) return std::nullopt;
  if (!(resolution < 1.0)) return 0.0;
  const auto [before, after] = in_halves(piece);
  if (const auto u = first_overspin(before, limits, 2.0 * resolution)) return 0.5 * *u;
  if (const auto u = first_overspin(after, limits, 2.0 * resolution)) return 0.5 + 0.5 * *u;
  return std::nullopt;
}

/// Where two pieces do not meet, in place, velocity or heading.
Earliest first_break(const DrivePiece& before, const DrivePiece& after) {
  if (const Earliest first = first_jump(before, after)) return first;
  const Vector2 from = before.course.col(4);
  const Vector2 to = after.course.col(0);
  const double aside = std::abs(cross(from, to));
  if (aside <= kHeadingJump_rad * from.dot(to)) return {};
  return {ViolatedTerm::kYawRate, 0.0, true};
}

Earliest first_violation(const DrivePiece& piece, const MotionLimits& limits) {
  if (piece.drive_direction < 0 && !limits.can_reverse) return {ViolatedTerm::kSpeedBackward, 0.0};
  Earliest first = first_excess(piece, limits.max_speed, limits.max_acceleration);
  for (const int side : {-1, 1}) {
    first.consider(ViolatedTerm::kYawRate,
                   first_swerve(piece, side, kLimitSlack * limits.max_yaw_rate));
  }
  if (!limits.wheels_are_ample()) {
    first.consider(ViolatedTerm::kWheelSpeed, first_overspin(piece, limits, kWheelResolution));
  }
  const double step = kCourseStep_s / piece.duration_s;
  const auto stop = first_stop(piece.course, step);
  first.consider(ViolatedTerm::kYawRate, stop);
  first.jumps = stop && first.term == ViolatedTerm::kYawRate && *stop <= first.u + step;
  return first;
}

/// Turns in place: rate and acceleration of the quintic profile are polynomials too. `u` is where
/// the check begins.
Earliest first_violation(const TurnPhase& turn, const MotionLimits& limits, double u) {
  const double tau = turn.duration_s;
  const Bernstein<1, 4> rate = derivative(yaw_change(turn));
  const Bernstein<1, 3> acceleration = derivative(rate);
  Earliest first;
  const auto check = [&](ViolatedTerm term, auto excess, double limit) {
    excess.array() -= kLimitSlack * limit;
    first.consider(term, first_positive(split(excess, u).second));
  };
  for (const double side : {1.0, -1.0}) {
    check(ViolatedTerm::kYawRate, Bernstein<1, 4>(side * rate), limits.max_yaw_rate * tau);
    check(ViolatedTerm::kAcceleration, Bernstein<1, 3>(side * acceleration),
          limits.max_yaw_acceleration * tau * tau);
  }
  return first;
}

double limit_of(ViolatedTerm term, bool in_turn, const MotionLimits& limits) {
  switch (term) {
    case ViolatedTerm::kSpeed:
      return limits.max_speed;
    case ViolatedTerm::kSpeedBackward:
      return 0.0;
    case ViolatedTerm::kYawRate:
      return limits.max_yaw_rate;
    case ViolatedTerm::kWheelSpeed:
      return limits.max_wheel_speed;
    default:
      return in_turn ? limits.max_yaw_acceleration : limits.max_acceleration;
  }
}

/// The violation that begins at `t` in a phase, with the worst value of the stretch that begins
/// there.
Violation report(const Motion& motion, int phase, const MotionLimits& limits, const Earliest& first,
                 double t) {
  const ViolatedTerm term = first.term;
  const auto* turn = std::get_if<TurnPhase>(&motion.phases()[phase]);
  const double end = motion.phase_start_time(phase) + duration_s(motion.phases()[phase]);
  const auto value_at = [&](double when) {
    const MotionState state = motion.at(when);
    if (term == ViolatedTerm::kSpeed || term == ViolatedTerm::kSpeedBackward)
      return state.velocity.norm();
    if (term == ViolatedTerm::kYawRate) return std::abs(state.yaw_rate);
    if (term == ViolatedTerm::kWheelSpeed) {
      return state.velocity.norm() + 0.5 * limits.track_m * std::abs(state.yaw_rate);
    }
    if (!turn) return state.acceleration.norm();
    return std::abs(state_of(*turn, when - motion.phase_start_time(phase)).rates.yaw_acceleration);
  };
  Violation violation;
  violation.term = term;
  violation.time_s = t;
  violation.place = motion.position(t);
  violation.limit = limit_of(term, turn != nullptr, limits);
  violation.value = first.jumps ? std::numeric_limits<double>::infinity()
                                : worst_value(value_at, std::greater<>(), violation.limit, t, end);
  return violation;
}

}  // namespace

Violation check_limits(const Motion& motion, const MotionLimits& limits, double from_s) {
  for (int i = 0; i < static_cast<int>(motion.phases().size()); ++i) {
    const Phase& phase = motion.phases()[i];
    const double start = motion.phase_start_time(i);
    if (start + duration_s(phase) <= from_s) continue;
    if (const auto* turn = std::get_if<TurnPhase>(&phase)) {
      const double u = std::max(0.0, (from_s - start) / turn->duration_s);
      const Earliest first = first_violation(*turn, limits, u);
      if (!first) continue;
      const double at = start + turn->duration_s * (u + (1.0 - u) * first.u);
      return report(motion, i, limits, first, at);
    }
    if (!std::holds_alternative<DrivePhase>(phase)) continue;
    const std::vector<DrivePiece> pieces = drive_pieces(motion, i, from_s);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const DrivePiece& piece = pieces[k];
      Earliest first = k > 0 ? first_break(pieces[k - 1], piece) : Earliest{};
      if (!first) first = first_violation(piece, limits);
      if (!first) continue;
      return report(motion, i, limits, first, piece.start_s + first.u * piece.duration_s);
    }
  }
  return {};
}

}  // namespace mocha
