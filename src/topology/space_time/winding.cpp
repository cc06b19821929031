#include "topology/space_time/winding.h"

#include <algorithm>
#include <cmath>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

Vector2 position_at(const TimedPath& path, double t) {
  const auto next = std::upper_bound(path.begin() + 1, path.end() - 1, t,
                                     [](double s, const TimedPoint& p) { return s < p.time_s; });
  const TimedPoint& p = *(next - 1);
  const TimedPoint& q = *next;
  return p.position + (t - p.time_s) / (q.time_s - p.time_s) * (q.position - p.position);
}

Vector2 centre_at(const Tube<2>& tube, double t) {
  const auto next = std::upper_bound(tube.begin() + 1, tube.end(), t,
                                     [](double s, const TubePiece<2>& p) { return s < p.start_s; });
  return (next - 1)->centre_at(t);
}

/// Between the times at which the path or the tube bends, the relative motion is straight.
double swept_turns(const TimedPath& path, const Tube<2>& tube, double from_s, double until_s) {
  std::vector<double> times = {from_s, until_s};
  const auto add = [&](double t) {
    if (from_s < t && t < until_s) times.push_back(t);
  };
  for (const TimedPoint& point : path) add(point.time_s);
  for (const TubePiece<2>& piece : tube) add(piece.start_s);
  std::sort(times.begin(), times.end());
  double swept_rad = 0.0;
  Vector2 last = position_at(path, from_s) - centre_at(tube, from_s);
  for (const double t : times) {
    const Vector2 relative = position_at(path, t) - centre_at(tube, t);
    swept_rad += angle_between(last, relative);
    last = relative;
  }
  return swept_rad / (2.0 * M_PI);
}

}  // namespace

double winding_difference(const TimedPath& a, const TimedPath& b, const Tube<2>& tube) {
  if (a.size() < 2 || b.size() < 2 || tube.empty()) return 0.0;
  const double from_s = std::max({a.front().time_s, b.front().time_s, tube.front().start_s});
  const double until_s = std::min({a.back().time_s, b.back().time_s, tube.back().end_s});
  if (!(from_s < until_s)) return 0.0;
  return swept_turns(a, tube, from_s, until_s) - swept_turns(b, tube, from_s, until_s);
}

bool same_class(const TimedPath& a, const TimedPath& b, const std::vector<Tube<2>>& obstacles) {
  return std::all_of(obstacles.begin(), obstacles.end(), [&](const Tube<2>& tube) {
    return std::abs(winding_difference(a, b, tube)) < 0.5;
  });
}

}  // namespace mocha
