#include "safety/curve_certificate.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <stdexcept>

#include "safety/curve_arc.h"
#include "safety/limit_search.h"
#include "safety/worst_value.h"

namespace mocha {
namespace {

/// A ball that has to stay clear of a field.
template <int D>
struct BallKeepout {
  const ObstacleField<D>& field;
  double radius_m;

  bool clear(const CurveSweep<D>& sweep) const {
    return field.distance_bound(sweep.place) >= radius_m + sweep.travel_m;
  }
  double sweep_m(const CurveSweep<D>& sweep) const { return sweep.travel_m; }
};

/// A ball about the origin, from which something stays away.
template <int D>
struct OriginKeepout {
  double radius_m;

  bool clear(const CurveSweep<D>& sweep) const {
    // What overflows is no proof.
    return sweep.place.norm() - sweep.travel_m >= radius_m;
  }
  double sweep_m(const CurveSweep<D>& sweep) const { return sweep.travel_m; }
};

/// A piece of a curve between two times, as seen from what moves in the tube then.
template <int D, int N>
CurveArc<D, N> relative_arc(const CurvePiece<D, N>& piece, const TubePiece<D>& other, double from_s,
                            double until_s) {
  Bernstein<D, N> position = piece.position;
  const double from = (from_s - piece.start_s) / piece.duration_s;
  const double until = (until_s - piece.start_s) / piece.duration_s;
  if (until < 1.0) position = split(position, until).first;
  if (from > 0.0) position = split(position, from / std::min(until, 1.0)).second;
  for (int k = 0; k <= N; ++k) {  // what moves uniformly has evenly spread control points
    position.col(k) -= other.centre_at(from_s + (until_s - from_s) * k / N);
  }
  return {position, from_s, until_s - from_s};
}

}  // namespace

template <int D, int S>
CurveCertificate<D, S>::CurveCertificate(const Curve& curve)
    : curve_(curve), pieces_(curve_pieces(curve, 0.0, 0.0)) {
  if (pieces_.empty()) throw std::invalid_argument("CurveCertificate: the curve has no pieces");
}

template <int D, int S>
auto CurveCertificate<D, S>::check_limits(double max_speed, double max_acceleration) const
    -> Violation {
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const auto& piece = pieces_[i];
    Earliest first = i > 0 ? first_jump(pieces_[i - 1], piece) : Earliest{};
    if (!first) first = first_excess(piece, max_speed, max_acceleration);
    if (!first) continue;
    const int order = first.term == ViolatedTerm::kSpeed ? 1 : 2;
    const auto value = [&](double t) { return curve_.derivative(t, order).norm(); };
    Violation violation;
    violation.term = first.term;
    violation.time_s = piece.start_s + first.u * piece.duration_s;
    violation.place = curve_.position(violation.time_s);
    violation.limit = order == 1 ? max_speed : max_acceleration;
    violation.value = first.jumps ? std::numeric_limits<double>::infinity()
                                  : worst_value(value, std::greater<>(), violation.limit,
                                                violation.time_s, curve_.duration());
    return violation;
  }
  return {};
}

template <int D, int S>
auto CurveCertificate<D, S>::check_clearance(double radius_m, const ObstacleField<D>& field,
                                             double margin_m) const -> Violation {
  const BallKeepout<D> keepout{field, radius_m + margin_m};
  for (const auto& piece : pieces_) {
    const CurveArc<D, 2 * S - 1> arc{piece.position, piece.start_s, piece.duration_s};
    const auto t = first_unclear(arc, keepout);
    if (!t) continue;
    const auto value = [&](double when) {
      return field.distance_bound(curve_.position(when)) - radius_m;
    };
    Violation violation;
    violation.term = ViolatedTerm::kClearance;
    violation.time_s = *t;
    violation.place = curve_.position(*t);
    violation.limit = margin_m;
    violation.value = worst_value(value, std::less<>(), margin_m, *t, curve_.duration());
    return violation;
  }
  return {};
}

/// From the rim of what moves to the curve's point [m].
template <int D, int S>
double CurveCertificate<D, S>::gap_m(const TubePiece<D>& piece, double t) const {
  return (curve_.position(t) - piece.centre_at(t)).norm() - piece.radius_at(t);
}

template <int D, int S>
auto CurveCertificate<D, S>::check_separation(double radius_m, const Tube<D>& tube,
                                              double margin_m) const -> Violation {
  for (const auto& piece : pieces_) {
    for (const TubePiece<D>& other : tube) {
      const double from_s = std::max(piece.start_s, other.start_s);
      const double until_s = std::min(piece.end_s(), other.end_s);
      if (from_s >= until_s) continue;
      const double largest_m = std::max(other.radius_at(from_s), other.radius_at(until_s));
      const auto t = first_unclear(relative_arc(piece, other, from_s, until_s),
                                   OriginKeepout<D>{largest_m + radius_m + margin_m});
      if (!t) continue;
      Violation violation;
      violation.term = ViolatedTerm::kSeparation;
      violation.time_s = *t;
      violation.place = curve_.position(*t);
      violation.limit = margin_m;
      violation.value = worst_value([&](double when) { return gap_m(other, when) - radius_m; },
                                    std::less<>(), margin_m, *t, until_s);
      return violation;
    }
  }
  return {};
}

template class CurveCertificate<2, 3>;
template class CurveCertificate<3, 3>;

}  // namespace mocha
