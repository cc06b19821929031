#include "trajectory/stop_separation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "trajectory/mistiming.h"
#include "trajectory/separation.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.1;  // of all that follows; the moments are whole numbers of it
constexpr double kLongestReaction_s = 10.0;

/// A motion in steps, and how its robot stops from each of them.
class SteppedMotion {
 public:
  /// Steps are counted from `first` on, that is from first * kStep_s.
  SteppedMotion(const BrakableMotion& brakable, long first)
      : first_(first), braking_(brakable.braking) {
    const Motion& motion = brakable.motion;
    const double end_s = motion.end_time();
    const long last = std::max(first, static_cast<long>(std::ceil(end_s / kStep_s)));
    for (long i = first; i <= last; ++i) {
      const double t = static_cast<double>(i) * kStep_s;
      const MotionState state = motion.at(t);
      const bool drives = t >= motion.start_time() && t < end_s;
      places_.push_back(state.pose.position);
      speeds_.push_back(drives ? std::abs(state.speed) : 0.0);
      yaw_rates_.push_back(std::abs(state.yaw_rate));
      max_lateral_ = std::max(max_lateral_, speeds_.back() * yaw_rates_.back());
    }
    stops_.resize(places_.size());
    max_speed_ = *std::max_element(speeds_.begin(), speeds_.end());
  }

  const Vector2& place(long i) const { return places_[index(i)]; }
  double max_speed() const { return max_speed_; }
  long last() const { return first_ + static_cast<long>(places_.size()) - 1; }
  /// No stop is longer [m].
  double longest_stop_m() const {
    return max_speed_ * (0.5 * max_speed_ / braking_.beside(max_lateral_) + 2.0 * kBrakingRamp_s);
  }

  /// Where the robot is at step k that brakes from step i on; k is not before i.
  const Vector2& stopping(long i, long k) {
    const std::vector<Vector2>& stop = stop_from(index(i));
    return stop[std::min<std::size_t>(k - i, stop.size() - 1)];
  }
  /// The step from which on a robot that brakes from step i on rests.
  long rests(long i) { return i + static_cast<long>(stop_from(index(i)).size()) - 1; }

 private:
  std::size_t index(long i) const {
    return std::min<std::size_t>(std::max(0L, i - first_), places_.size() - 1);
  }

  /// Linear in between, at `at` steps from the first.
  template <typename Value>
  static Value between(const std::vector<Value>& values, double at) {
    const auto i = std::min(static_cast<std::size_t>(at), values.size() - 1);
    const auto next = std::min(i + 1, values.size() - 1);
    const double share = std::min(at - static_cast<double>(i), 1.0);
    return values[i] + share * (values[next] - values[i]);
  }

  const std::vector<Vector2>& stop_from(std::size_t start) {
    std::vector<Vector2>& stop = stops_[start];
    if (stop.empty()) brake(start, stop);
    return stop;
  }

  /// Never faster than the motion at the same place, as brake_along() brakes.
  void brake(std::size_t start, std::vector<Vector2>& stop) const {
    const std::size_t next = std::min(start + 1, speeds_.size() - 1);
    const double acceleration = (speeds_[next] - speeds_[start]) / kStep_s;
    double speed = speeds_[start];
    double at = static_cast<double>(start);
    stop.push_back(places_[start]);
    for (int i = 0; speed > kRest_mps; ++i) {
      const double ramped = std::min(1.0, (i + 0.5) * kStep_s / kBrakingRamp_s);
      const double bend = between(yaw_rates_, at) / std::max(between(speeds_, at), kRest_mps);
      const double rate = braking_.rate(acceleration, ramped, bend * speed * speed);
      const double later = std::max(0.0, speed + rate * kStep_s);
      const double brakes_s = rate < 0.0 ? std::min(kStep_s, speed / -rate) : kStep_s;
      const double way_m = 0.5 * (speed + later) * brakes_s;
      const double track = between(speeds_, at + 0.5);
      at += track * kStep_s <= way_m ? 1.0 : way_m / (track * kStep_s);
      stop.push_back(between(places_, at));
      speed = std::min(later, between(speeds_, at));
    }
  }

  long first_;
  Braking braking_;
  std::vector<Vector2> places_;
  std::vector<double> speeds_;
  std::vector<double> yaw_rates_;
  std::vector<std::vector<Vector2>> stops_;  // as far as they were asked for
  double max_speed_ = 0.0;
  double max_lateral_ = 0.0;
};

/// How close the straight line from a to b comes to the origin.
double closest_to_origin(const Vector2& a, const Vector2& b) {
  const Vector2 line = b - a;
  const double squared = line.squaredNorm();
  const double share = squared > 0.0 ? std::clamp(-a.dot(line) / squared, 0.0, 1.0) : 0.0;
  return (a + share * line).norm();
}

struct Closest {
  double distance_m = std::numeric_limits<double>::infinity();
  long step = 0;
};

/// From where the one that brakes first is, to the other, at the steps from one on.
struct Offsets {
  long first = 0;
  std::vector<Vector2> offsets;

  const Vector2& at(long k) const {
    return offsets[std::min<std::size_t>(k - first, offsets.size() - 1)];
  }
  long last() const { return first + static_cast<long>(offsets.size()) - 1; }
};

/// One robot brakes first, the other reacts.
class Stops {
 public:
  /// Offsets of more than `far_m` are not looked at.
  Stops(SteppedMotion& brakes, SteppedMotion& reacts, long reaction, double far_m)
      : brakes_(brakes), reacts_(reacts), reaction_(reaction), far_squared_(far_m * far_m) {}

  /// How close they come, unless far, if the one brakes at step i, or since the last step that was
  /// asked for.
  Closest closest(long i) {
    Offsets next{i, {}};
    const long until = std::max(brakes_.rests(i), reacts_.rests(i + reaction_));
    for (long k = i; k <= until; ++k) {
      const Vector2& there =
          k < i + reaction_ ? reacts_.place(k) : reacts_.stopping(i + reaction_, k);
      next.offsets.push_back(there - brakes_.stopping(i, k));
    }
    Closest closest;
    const auto look = [&](const Vector2& a, const Vector2& b, long k) {
      if (a.squaredNorm() > far_squared_) return;
      const double distance_m = closest_to_origin(a, b);
      if (distance_m < closest.distance_m) closest = {distance_m, k};
    };
    for (long k = i; k <= until; ++k) look(next.at(k), next.at(k + 1), k);
    if (!former_.offsets.empty() && former_.first + 1 == i) {
      for (long k = i; k <= std::max(until, former_.last()); ++k)
        look(former_.at(k), next.at(k), k);
    }
    former_ = std::move(next);
    return closest;
  }

 private:
  SteppedMotion& brakes_;
  SteppedMotion& reacts_;
  long reaction_;
  double far_squared_;
  Offsets former_;
};

void check(const Motion& a, const Motion& b, double reaction_s) {
  if (a.empty() || b.empty()) throw std::invalid_argument("first_stop_meeting: a motion is empty");
  if (!(reaction_s >= 0.0) || reaction_s > kLongestReaction_s)
    throw std::invalid_argument("first_stop_meeting: needs a reaction time up to 10 s");
}

/// From when on a motion moves, of the time from `from_s` on; never where it has ended.
double moves_from_s(const Motion& motion, double from_s) {
  return motion.end_time() <= from_s ? std::numeric_limits<double>::infinity()
                                     : std::max(from_s, motion.start_time());
}

}  // namespace

std::optional<StopMeeting> first_stop_meeting(const BrakableMotion& a, const BrakableMotion& b,
                                              double distance_m, double reaction_s, double from_s,
                                              double until_s) {
  check(a.motion, b.motion, reaction_s);
  if (far_apart(a.motion, b.motion, distance_m)) return std::nullopt;
  const long reaction = static_cast<long>(std::ceil(reaction_s / kStep_s - 1e-6));
  // Until one of them sets off, nothing changes: a promise may be for tomorrow.
  const double sets_off_s =
      std::min(moves_from_s(a.motion, from_s), moves_from_s(b.motion, from_s));
  const double begins_s =
      std::isfinite(sets_off_s) ? std::max(from_s, sets_off_s - (reaction + 1) * kStep_s) : from_s;
  const long first = static_cast<long>(std::ceil(begins_s / kStep_s));
  SteppedMotion one(a, first);
  SteppedMotion other(b, first);
  Mistiming off = mistiming(a.motion, b.motion, a.mistimed_s + b.mistimed_s);
  off.from_s -= reaction_s;  // the one brakes, and the other sets off before it reacts
  const double step_m = (one.max_speed() + other.max_speed()) * kStep_s;
  // From one moment of braking to the next a stop moves by no more than three steps.
  const double far_m = std::max(0.0, distance_m + off.loss_m) + 3.0 * step_m;
  Stops one_first(one, other, reaction, far_m);
  Stops other_first(other, one, reaction, far_m);
  const double reach_m = step_m * reaction + one.longest_stop_m() + other.longest_stop_m();
  const long both_rest = std::max(one.last(), other.last());
  const long last = until_s < static_cast<double>(both_rest) * kStep_s
                        ? static_cast<long>(std::floor(until_s / kStep_s))
                        : both_rest;
  for (long i = first; i <= last; ++i) {
    const double spare_m =
        (one.place(i) - other.place(i)).norm() - distance_m - off.loss_m - reach_m;
    if (spare_m > step_m) {
      i += static_cast<long>(std::min(spare_m / std::max(step_m, 1e-9), 1e6)) - 1;
      continue;
    }
    const Closest ahead = one_first.closest(i);
    const Closest behind = other_first.closest(i);
    const Closest& closest = ahead.distance_m < behind.distance_m ? ahead : behind;
    const double brakes_s = static_cast<double>(i) * kStep_s;
    if (closest.distance_m >= distance_m + off.loss_at(brakes_s)) continue;
    const double time_s = static_cast<double>(closest.step) * kStep_s;
    return StopMeeting{brakes_s, time_s, closest.distance_m, one.place(closest.step)};
  }
  return std::nullopt;
}

}  // namespace mocha
