#include "trajectory/separation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "trajectory/bernstein.h"

namespace mocha {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kSlack_m = 5e-4;

/// Upper bounds on speed and acceleration over one piece: the largest control points of the
/// derivatives.
MotionBounds bounds_of(const PlanarPath& path, int piece) {
  const double tau = path.piece_duration(piece);
  const auto velocity = derivative(to_bernstein(path.piece(piece)));
  const auto acceleration = derivative(velocity);
  return {velocity.colwise().norm().maxCoeff() / tau,
          acceleration.colwise().norm().maxCoeff() / (tau * tau)};
}

/// A stretch of time in which a robot stands or follows one polynomial piece.
struct Span {
  double end_s;                      // absolute
  Vector2 place = Vector2::Zero();   // where it stands, without a path
  const PlanarPath* path = nullptr;  // belongs to the motion
  int piece = 0;
  double begin_s = 0.0;  // absolute; of the piece
  double max_acceleration = 0.0;
};

/// A motion as spans that are visited in order of time. The motion must outlive it.
class Track {
 public:
  explicit Track(const Motion& motion) {
    if (motion.empty()) throw std::invalid_argument("separation: a motion is empty");
    spans_.push_back(standing(motion.position(motion.start_time()), motion.start_time()));
    for (int i = 0; i < static_cast<int>(motion.phases().size()); ++i) {
      const double begin = motion.phase_start_time(i);
      const Phase& phase = motion.phases()[i];
      if (const auto* drive = std::get_if<DrivePhase>(&phase)) {
        add(drive->path, begin);
      } else {
        spans_.push_back(standing(motion.position(begin), begin + duration_s(phase)));
      }
    }
    spans_.push_back(standing(motion.end_pose().position, kForever));
  }

  /// The span that holds time t; t must not decrease from call to call.
  const Span& at(double t) {
    while (spans_[current_].end_s <= t) ++current_;
    return spans_[current_];
  }

 private:
  static Span standing(const Vector2& place, double end_s) {
    Span span;
    span.end_s = end_s;
    span.place = place;
    return span;
  }

  void add(const PlanarPath& path, double begin) {
    for (int piece = 0; piece < path.pieces(); ++piece) {
      Span span;
      span.path = &path;
      span.piece = piece;
      span.begin_s = begin + path.piece_start(piece);
      span.end_s = span.begin_s + path.piece_duration(piece);
      span.max_acceleration = bounds_of(path, piece).acceleration;
      spans_.push_back(span);
    }
  }

  std::vector<Span> spans_;
  std::size_t current_ = 0;
};

struct Point {
  Vector2 position;
  Vector2 velocity;
};

Point point(const Span& span, double t) {
  if (span.path == nullptr) return {span.place, Vector2::Zero()};
  const double u = std::clamp((t - span.begin_s) / span.path->piece_duration(span.piece), 0.0, 1.0);
  const PlanarPath::Location location{span.piece, u};
  return {span.path->derivative(location, 0), span.path->derivative(location, 1)};
}

/// The longest step in which a distance cannot shrink by more than `gap` > 0: root of gap + rate h
/// - A h^2 / 2.
double safe_step(double gap, double rate, double max_acceleration) {
  if (max_acceleration <= 0.0) return rate < 0.0 ? gap / -rate : kForever;
  const double root = std::sqrt(rate * rate + 2.0 * max_acceleration * gap);
  return rate < 0.0 ? 2.0 * gap / (root - rate) : (rate + root) / max_acceleration;
}

/// Visits moments of [t0, t1] in order. visit(t, distance) returns the distance below which the
/// next moment of interest lies (less than `distance`), or a negative number to stop.
template <typename Visit>
void advance(const Motion& a, const Motion& b, double t0, double t1, Visit visit) {
  Track track_a(a);
  Track track_b(b);
  for (double t = t0;;) {
    const Span& span_a = track_a.at(t);
    const Span& span_b = track_b.at(t);
    const Point point_a = point(span_a, t);
    const Point point_b = point(span_b, t);
    const Vector2 offset = point_b.position - point_a.position;
    const double distance = offset.norm();
    const double floor = visit(t, distance);
    const double span_end = std::min(span_a.end_s, span_b.end_s);
    if (floor < 0.0 || t >= t1) return;
    const double rate = offset.dot(point_b.velocity - point_a.velocity) / distance;
    const double step =
        safe_step(distance - floor, rate, span_a.max_acceleration + span_b.max_acceleration);
    const double next = std::min({t + step, span_end, t1});
    if (next == kForever) return;
    t = std::max(next, std::nextafter(t, kForever));
  }
}

}  // namespace

ClosestApproach closest_approach(const Motion& a, const Motion& b, double t0, double t1,
                                 double tolerance_m) {
  if (!(t0 <= t1) || !(tolerance_m > 0.0)) {
    throw std::invalid_argument("closest_approach: needs t0 <= t1 and a tolerance above 0");
  }
  ClosestApproach closest{kForever, t0};
  advance(a, b, t0, t1, [&](double t, double distance) {
    if (distance < closest.distance_m) closest = {distance, t};
    return closest.distance_m - tolerance_m;  // below zero: nothing closer can matter
  });
  return closest;
}

std::optional<double> first_time_closer_than(const Motion& a, const Motion& b, double distance_m,
                                             double t0, double t1) {
  if (std::isnan(distance_m) || std::isnan(t0) || std::isnan(t1)) {
    throw std::invalid_argument("first_time_closer_than: a distance or time is not a number");
  }
  std::optional<double> first;
  if (t0 > t1 || distance_m < 0.0) return first;
  advance(a, b, t0, t1, [&](double t, double distance) {
    if (distance >= distance_m + kSlack_m) return distance_m;
    first = t;
    return -1.0;
  });
  return first;
}

bool far_apart(const Motion& a, const Motion& b, double distance_m) {
  return a.box().exteriorDistance(b.box()) > distance_m + 2.0 * kSlack_m;
}

MotionBounds bounds(const Motion& motion) {
  MotionBounds bounds{0.0, 0.0};
  for (const Phase& phase : motion.phases()) {
    const auto* drive = std::get_if<DrivePhase>(&phase);
    if (drive == nullptr) continue;
    for (int i = 0; i < drive->path.pieces(); ++i) {
      const MotionBounds piece = bounds_of(drive->path, i);
      bounds.speed = std::max(bounds.speed, piece.speed);
      bounds.acceleration = std::max(bounds.acceleration, piece.acceleration);
    }
  }
  return bounds;
}

}  // namespace mocha
