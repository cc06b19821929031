#include "world/moving/tube.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mocha {
namespace {

/// When |relative + t velocity| - t growth is least, for t from 0 to `span`.
template <typename Vector>
double nearest_moment(const Vector& relative, const Vector& velocity, double growth, double span) {
  const double speed2 = velocity.squaredNorm();
  const double growth2 = growth * growth;
  if (speed2 <= growth2) return growth > 0.0 ? span : 0.0;  // it only shrinks, or only grows
  const double passing = -relative.dot(velocity) / speed2;
  const double off_m = growth == 0.0 ? 0.0 : (relative + passing * velocity).norm();
  const double later = growth * off_m / std::sqrt(speed2 * (speed2 - growth2));
  return std::clamp(passing + later, 0.0, span);
}

}  // namespace

template <int D>
double least_gap_m(const TubePiece<D>& piece, const typename TubePiece<D>::Place& p, double p_s,
                   const typename TubePiece<D>::Place& q, double q_s) {
  const double from_s = std::max(p_s, piece.start_s);
  const double until_s = std::min(q_s, piece.end_s);
  if (from_s > until_s) return std::numeric_limits<double>::infinity();
  using Place = typename TubePiece<D>::Place;
  const Place velocity = q_s > p_s ? Place((q - p) / (q_s - p_s)) : Place(Place::Zero());
  const Place relative = p + (from_s - p_s) * velocity - piece.centre_at(from_s);
  const Place closing = velocity - piece.velocity;
  const double t = nearest_moment(relative, closing, piece.radius_rate, until_s - from_s);
  return (relative + t * closing).norm() - piece.radius_at(from_s + t);
}

template double least_gap_m<2>(const TubePiece<2>&, const Eigen::Vector2d&, double,
                               const Eigen::Vector2d&, double);
template double least_gap_m<3>(const TubePiece<3>&, const Eigen::Vector3d&, double,
                               const Eigen::Vector3d&, double);

}  // namespace mocha
