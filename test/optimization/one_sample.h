#pragma once

#include "optimization/penalty.h"

namespace mocha {

/// One sample of a trajectory, to test penalties with.
template <int D>
struct Sample {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector position = Vector::Zero();
  Vector velocity = Vector::Zero();
  Vector acceleration = Vector::Zero();
  double time_s = 0.0;
  Vector jerk = Vector::Zero();
};

/// The sample as a piece that lasts no time.
template <int D>
PieceSamples<D> piece_of(const Sample<D>& sample) {
  PieceSamples<D> piece(1);
  piece.derivative[0].row(0) = sample.position;
  piece.derivative[1].row(0) = sample.velocity;
  piece.derivative[2].row(0) = sample.acceleration;
  piece.derivative[3].row(0) = sample.jerk;
  piece.time_s[0] = sample.time_s;
  const double speed2 = sample.velocity.squaredNorm();
  piece.bounds = {{sample.position, sample.position}, speed2,        speed2,
                  sample.acceleration.squaredNorm(),  sample.time_s, 0.0};
  return piece;
}

template <int D>
PenaltyRows<D> rows_at(const Penalty<D>& penalty, const Sample<D>& sample) {
  PenaltyRows<D> rows(1);
  rows.value.setZero();
  rows.by_time.setZero();
  for (auto& by : rows.by_derivative) by.setZero();
  penalty.add(piece_of(sample), rows);
  return rows;
}

template <int D>
double value_of(const Penalty<D>& penalty, const Sample<D>& sample) {
  return rows_at(penalty, sample).value[0];
}

}  // namespace mocha
