#pragma once

#include <Eigen/Core>
#include <vector>

namespace mocha {

/// A disc (D = 2) or ball (D = 3) that moves and grows uniformly for a while.
template <int D>
struct TubePiece {
  using Place = Eigen::Matrix<double, D, 1>;

  double start_s;
  double end_s;
  Place centre;  ///< at start_s [m]
  Place velocity;
  double radius_m;     ///< at start_s; below 0 it is in no way
  double radius_rate;  ///< [m/s]

  Place centre_at(double t) const { return centre + (t - start_s) * velocity; }
  double radius_at(double t) const { return radius_m + (t - start_s) * radius_rate; }
};

/// What a moving thing occupies in space and time (paper Fig. 5): pieces in order of time, each
/// ending where and when the next one starts. None for what is nowhere.
template <int D>
using Tube = std::vector<TubePiece<D>>;

/// Of what moves at a steady velocity, from 0 on for as long as anyone looks.
template <int D>
Tube<D> steady_tube(const typename TubePiece<D>::Place& place,
                    const typename TubePiece<D>::Place& velocity, double radius_m) {
  constexpr double kLong_s = 1e5;
  return {{0.0, kLong_s, place, velocity, radius_m, 0.0}};
}

/// The same, its radius enlarged by `keep_m`.
template <int D>
Tube<D> enlarged(Tube<D> tube, double keep_m) {
  for (TubePiece<D>& piece : tube) piece.radius_m += keep_m;
  return tube;
}

/// The least distance [m] from the rim of the piece to a point that moves uniformly from p at p_s
/// to q at q_s, at the times that they share; negative inside, infinity without such a time. Exact
/// but for rounding: the distance of the centres is convex in time and the radius linear, so there
/// is one minimum, and it has a closed form.
template <int D>
double least_gap_m(const TubePiece<D>& piece, const typename TubePiece<D>::Place& p, double p_s,
                   const typename TubePiece<D>::Place& q, double q_s);

extern template double least_gap_m<2>(const TubePiece<2>&, const Eigen::Vector2d&, double,
                                      const Eigen::Vector2d&, double);
extern template double least_gap_m<3>(const TubePiece<3>&, const Eigen::Vector3d&, double,
                                      const Eigen::Vector3d&, double);

}  // namespace mocha
