#include "optimization/time_quadrature.h"

#include <cmath>

namespace mocha {

template <int D, int S>
TimeQuadrature<D, S>::TimeQuadrature(int kappa) : kappa_(kappa) {
  for (int j = 0; j <= kappa; ++j) {
    const double u = static_cast<double>(j) / kappa;
    Basis value;
    Basis first = Basis::Zero();
    Basis second = Basis::Zero();
    Basis third = Basis::Zero();
    for (int k = 0; k < 2 * S; ++k) {
      value[k] = std::pow(u, k);
      if (k >= 1) first[k] = k * std::pow(u, k - 1);
      if (k >= 2) second[k] = k * (k - 1) * std::pow(u, k - 2);
      if (k >= 3) third[k] = k * (k - 1) * (k - 2) * std::pow(u, k - 3);
    }
    value_.push_back(value);
    first_.push_back(first);
    second_.push_back(second);
    third_.push_back(third);
  }
}

template <int D, int S>
double TimeQuadrature<D, S>::add(const Minco<D, S>& curve,
                                 const std::vector<std::unique_ptr<Penalty<D>>>& penalties,
                                 std::vector<Piece>& by_piece, Eigen::VectorXd& by_duration,
                                 std::vector<double>& shares) const {
  double total = 0.0;
  double piece_start = 0.0;
  double by_time_so_far =
      0.0;  // of everything before a piece: these samples do not move when it gets longer
  double by_time_total = 0.0;
  for (int i = 0; i < curve.pieces(); ++i) {
    const double tau = curve.piece_duration(i);
    const Piece& c = curve.piece(i);
    double sum = 0.0;
    double by_tau = 0.0;
    double by_time_here = 0.0;
    for (int j = 0; j <= kappa_; ++j) {
      const double weight = j == 0 || j == kappa_ ? 0.5 : 1.0;
      const double u = static_cast<double>(j) / kappa_;
      TrajectorySample<D> sample;
      sample.position.noalias() = c * value_[j];
      sample.velocity.noalias() = c * first_[j] / tau;
      sample.acceleration.noalias() = c * second_[j] / (tau * tau);
      sample.jerk.noalias() = c * third_[j] / (tau * tau * tau);
      sample.time_s = piece_start + u * tau;
      SampleGradient<D> gradient;
      double value = 0.0;
      for (std::size_t p = 0; p < penalties.size(); ++p) {
        const double share = penalties[p]->add(sample, gradient);
        shares[p] += weight * tau / kappa_ * share;
        value += share;
      }
      if (value == 0.0) continue;
      sum += weight * value;
      const double step = weight * tau / kappa_;
      by_piece[i].noalias() += step * gradient.by_position * value_[j].transpose();
      by_piece[i].noalias() += (step / tau) * gradient.by_velocity * first_[j].transpose();
      by_piece[i].noalias() +=
          (step / (tau * tau)) * gradient.by_acceleration * second_[j].transpose();
      by_piece[i].noalias() +=
          (step / (tau * tau * tau)) * gradient.by_jerk * third_[j].transpose();
      by_tau -= step / tau *
                (gradient.by_velocity.dot(sample.velocity) +
                 2.0 * gradient.by_acceleration.dot(sample.acceleration) +
                 3.0 * gradient.by_jerk.dot(sample.jerk));
      by_tau += step * u * gradient.by_time;
      by_time_here += step * gradient.by_time;
    }
    total += tau / kappa_ * sum;
    // (26): a longer piece moves every later sample in absolute time. Later pieces' shares are
    // added below.
    by_duration[i] += sum / kappa_ + by_tau - by_time_so_far - by_time_here;
    by_time_so_far += by_time_here;
    by_time_total += by_time_here;
    piece_start += tau;
  }
  if (by_time_total != 0.0) by_duration.array() += by_time_total;
  return total;
}

template class TimeQuadrature<2, 3>;
template class TimeQuadrature<3, 3>;

}  // namespace mocha
