#pragma once

#include <optional>
#include <utility>

#include "trajectory/bernstein.h"

namespace mocha {

/// Bounds on where a point is during an interval of time: within `travel_m` of `place`.
template <int D>
struct CurveSweep {
  Eigen::Matrix<double, D, 1> place;
  double travel_m;
};

/// An interval of a curve.
template <int D, int N>
struct CurveArc {
  Bernstein<D, N> position;
  double start_s;
  double duration_s;

  std::pair<CurveArc, CurveArc> halves() const {
    const auto parts = split(position);
    const double half = 0.5 * duration_s;
    return {{parts.first, start_s, half}, {parts.second, start_s + half, half}};
  }

  CurveSweep<D> sweep(const CurveArc& second_half) const {
    const Eigen::Matrix<double, D, 1> place = second_half.position.col(0);
    return {place, (position.colwise() - place).colwise().norm().maxCoeff()};
  }
};

/// The start [s] of the first interval of an arc that cannot be proved clear; none is a proof for
/// all of it.
///
/// An Arc says by sweep() where it takes the body, a Keepout whether a sweep is clear() throughout.
/// That takes one look, at the middle of the interval: a distance changes no faster than one moves.
/// Where it does not suffice, each half is looked at, until all that moves moves less than half a
/// millimetre (sweep_m()) or for less than a microsecond.
template <typename Arc, typename Keepout>
std::optional<double> first_unclear(const Arc& arc, const Keepout& keepout) {
  constexpr double kResolution_m = 5e-4;
  constexpr double kShortest_s = 1e-6;
  const auto [before, after] = arc.halves();
  const auto sweep = arc.sweep(after);
  if (keepout.clear(sweep)) return std::nullopt;
  if (arc.duration_s < kShortest_s || keepout.sweep_m(sweep) < kResolution_m) return arc.start_s;
  if (const auto t = first_unclear(before, keepout)) return t;
  return first_unclear(after, keepout);
}

}  // namespace mocha
