#include "planning/candidates/timed_guide.h"

#include <algorithm>

namespace mocha {
namespace {

/// The path of a query whose times are given, and beyond its ends on with the velocities there.
class TimedGuide {
 public:
  explicit TimedGuide(const DriveQuery& query) : query_(query) {}

  double duration_s() const { return query_.times_s.back(); }

  /// Averaged over `window_s` about t. So speed and direction change gradually, also from and to
  /// what they are at the ends.
  Vector2 smooth(double t, double window_s) const {
    constexpr int kParts = 16;
    Vector2 sum = Vector2::Zero();
    for (int i = 0; i <= kParts; ++i) sum += at(t + window_s * (i - kParts / 2) / kParts);
    return sum / (kParts + 1);
  }

 private:
  Vector2 at(double t) const {
    if (t <= 0.0) return query_.path.front() + t * query_.start.col(1);
    if (t >= duration_s()) {
      const Vector2 velocity = query_.rejoin ? Vector2(query_.rejoin->col(1)) : Vector2::Zero();
      return query_.path.back() + (t - duration_s()) * velocity;
    }
    const auto later = std::upper_bound(query_.times_s.begin(), query_.times_s.end(), t);
    const std::size_t i = later - query_.times_s.begin();
    const double share = (t - query_.times_s[i - 1]) / (*later - query_.times_s[i - 1]);
    return query_.path[i - 1] + share * (query_.path[i] - query_.path[i - 1]);
  }

  const DriveQuery& query_;
};

}  // namespace

InitialKnots<2> even_knots(const DriveQuery& query, int pieces, double window_s) {
  const TimedGuide guide(query);
  const double whole_s = guide.duration_s();
  const Vector2 off_start = query.path.front() - guide.smooth(0.0, window_s);
  const Vector2 off_end = query.path.back() - guide.smooth(whole_s, window_s);
  InitialKnots<2> knots;
  knots.path.resize(2, pieces + 1);
  knots.durations_s.setConstant(pieces, whole_s / pieces);
  for (int k = 0; k <= pieces; ++k) {
    const double share = static_cast<double>(k) / pieces;
    knots.path.col(k) =
        guide.smooth(share * whole_s, window_s) + (1.0 - share) * off_start + share * off_end;
  }
  return knots;
}

}  // namespace mocha
