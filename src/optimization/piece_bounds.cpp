#include "optimization/piece_bounds.h"

#include <algorithm>

#include "trajectory/bernstein.h"

namespace mocha {

template <int D, int S>
PieceBounds<D> bounds_of(const Eigen::Matrix<double, D, 2 * S>& piece, double start_s,
                         double duration_s) {
  const Bernstein<D, 2 * S - 1> position = to_bernstein(piece);
  const Bernstein<D, 2 * S - 2> course = derivative(position);
  const Bernstein<D, 2 * S - 3> bend = derivative(course);
  const Eigen::Matrix<double, D, 1> ahead = course.rowwise().sum();
  const double least_ahead = std::max(0.0, (ahead.transpose() * course).minCoeff());
  const double inverse2 = 1.0 / (duration_s * duration_s);
  PieceBounds<D> bounds;
  bounds.box = {position.rowwise().minCoeff(), position.rowwise().maxCoeff()};
  bounds.min_speed2 =
      least_ahead > 0.0 ? least_ahead * least_ahead / ahead.squaredNorm() * inverse2 : 0.0;
  bounds.max_speed2 = course.colwise().squaredNorm().maxCoeff() * inverse2;
  bounds.max_acceleration2 = bend.colwise().squaredNorm().maxCoeff() * inverse2 * inverse2;
  bounds.start_s = start_s;
  bounds.duration_s = duration_s;
  return bounds;
}

template PieceBounds<2> bounds_of<2, 2>(const Eigen::Matrix<double, 2, 4>&, double, double);
template PieceBounds<2> bounds_of<2, 3>(const Eigen::Matrix<double, 2, 6>&, double, double);
template PieceBounds<2> bounds_of<2, 4>(const Eigen::Matrix<double, 2, 8>&, double, double);
template PieceBounds<3> bounds_of<3, 2>(const Eigen::Matrix<double, 3, 4>&, double, double);
template PieceBounds<3> bounds_of<3, 3>(const Eigen::Matrix<double, 3, 6>&, double, double);
template PieceBounds<3> bounds_of<3, 4>(const Eigen::Matrix<double, 3, 8>&, double, double);

}  // namespace mocha
