#include "planning/candidates/timed_guide.h"

#include <algorithm>
#include <cstddef>

namespace mocha {
namespace {

template <int D>
Eigen::Matrix<double, D, 1> averaged(const TimedGuide<D>& guide, double t, double window_s) {
  constexpr int kParts = 16;
  Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
  for (int i = 0; i <= kParts; ++i) sum += guide.at(t + window_s * (i - kParts / 2) / kParts);
  return sum / (kParts + 1);
}

}  // namespace

template <int D>
auto TimedGuide<D>::at(double t) const -> Vector {
  if (t <= 0.0) return points.front() + t * start_velocity;
  if (t >= times_s.back()) return points.back() + (t - times_s.back()) * end_velocity;
  const auto later = std::upper_bound(times_s.begin(), times_s.end(), t);
  const std::size_t i = later - times_s.begin();
  const double share = (t - times_s[i - 1]) / (*later - times_s[i - 1]);
  return points[i - 1] + share * (points[i] - points[i - 1]);
}

template <int D>
InitialKnots<D> even_knots(const TimedGuide<D>& guide, int pieces, double window_s) {
  using Vector = Eigen::Matrix<double, D, 1>;
  const double whole_s = guide.times_s.back();
  const Vector off_start = guide.points.front() - averaged(guide, 0.0, window_s);
  const Vector off_end = guide.points.back() - averaged(guide, whole_s, window_s);
  InitialKnots<D> knots;
  knots.path.resize(D, pieces + 1);
  knots.durations_s.setConstant(pieces, whole_s / pieces);
  for (int k = 0; k <= pieces; ++k) {
    const double share = static_cast<double>(k) / pieces;
    knots.path.col(k) =
        averaged(guide, share * whole_s, window_s) + (1.0 - share) * off_start + share * off_end;
  }
  return knots;
}

template InitialKnots<2> even_knots(const TimedGuide<2>&, int, double);
template InitialKnots<3> even_knots(const TimedGuide<3>&, int, double);

}  // namespace mocha
