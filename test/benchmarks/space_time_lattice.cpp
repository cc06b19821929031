#include "benchmarks/space_time_lattice.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mocha {
namespace {

constexpr int kMostRest = 31;
constexpr double kEighth_rad = 0.25 * M_PI;

/// Direction of a velocity that one step leads to from rest.
int eighths(double x, double y) {
  return (static_cast<int>(std::lround(std::atan2(y, x) / kEighth_rad)) + 8) % 8;
}

}  // namespace

SpaceTimeLattice::SpaceTimeLattice(const LatticeUnits& units, const Pose& start,
                                   double start_time_s, double max_yaw_rate, bool can_reverse)
    : units_(units),
      start_(start),
      axes_(Eigen::Rotation2Dd(start.yaw_rad).toRotationMatrix()),
      start_time_s_(start_time_s),
      max_yaw_rate_(max_yaw_rate),
      can_reverse_(can_reverse) {
  if (!(units.step_s > 0.0 && units.push > 0.0 && units.merged_m > 0.0 && max_yaw_rate > 0.0))
    throw std::invalid_argument("SpaceTimeLattice: units and max_yaw_rate must be positive");
  merged_units_ = std::max(1, static_cast<int>(std::lround(units.merged_m / units.length_m())));
  longest_rest_ = turning_steps(can_reverse ? 2 : 4);
  if (longest_rest_ > kMostRest)
    throw std::invalid_argument("SpaceTimeLattice: a turn takes more than 31 steps");
}

int SpaceTimeLattice::turning_steps(int eighths) const {
  const double turn_s = 1.875 * kEighth_rad * eighths / max_yaw_rate_;
  return static_cast<int>(std::lround(turn_s / units_.step_s));
}

LatticeState SpaceTimeLattice::start(double speed) const {
  LatticeState state;
  state.vx = static_cast<std::int8_t>(std::lround(speed / units_.speed()));
  return state;
}

LatticeState SpaceTimeLattice::pushed(const LatticeState& state, int ax, int ay) const {
  LatticeState next = state;
  next.x += 2 * state.vx + ax;
  next.y += 2 * state.vy + ay;
  next.vx += ax;
  next.vy += ay;
  ++next.step;
  next.heading = 0;
  next.rest = 0;
  if (!next.stands()) return next;
  next.heading = state.stands() ? state.heading : eighths(state.vx, state.vy);
  if (state.stands()) next.rest = std::min(state.rest + 1, longest_rest_);
  return next;
}

int SpaceTimeLattice::heading_of(double yaw_rad) const {
  const double turned_rad = yaw_rad - start_.yaw_rad;
  return eighths(std::cos(turned_rad), std::sin(turned_rad));
}

bool SpaceTimeLattice::turns(const LatticeState& from, const LatticeState& to) const {
  if (to.stands()) return true;
  if (from.stands()) {
    const int full = can_reverse_ ? 4 : 8;
    const int apart = (eighths(to.vx, to.vy) - from.heading + 8) % full;
    return from.rest >= turning_steps(std::min(apart, full - apart));
  }
  const double cross = from.vx * to.vy - from.vy * to.vx;
  const double dot = from.vx * to.vx + from.vy * to.vy;
  return std::abs(std::atan2(cross, dot)) <= max_yaw_rate_ * units_.step_s;
}

std::uint64_t SpaceTimeLattice::key(const LatticeState& state, bool exactly) const {
  const int units = exactly ? 1 : merged_units_;
  const auto merged = [&](int i) {
    return static_cast<std::uint64_t>((i + (1 << 14)) / units) & 0x7FFF;
  };
  return static_cast<std::uint64_t>(state.rest) << 58 |
         static_cast<std::uint64_t>(state.heading) << 55 | merged(state.x) << 40 |
         merged(state.y) << 25 | static_cast<std::uint64_t>(exactly) << 24 |
         static_cast<std::uint64_t>(state.vx + 32) << 18 |
         static_cast<std::uint64_t>(state.vy + 32) << 12 | static_cast<std::uint64_t>(state.step);
}

}  // namespace mocha
