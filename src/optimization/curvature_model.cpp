#include "optimization/curvature_model.h"

#include <numeric>
#include <utility>

namespace mocha {
namespace {

constexpr double kLeastCurvature = 1e-9;  // of the free derivatives, relative

}  // namespace

template <int D, int S>
CurvatureModel<D, S>::CurvatureModel(std::vector<int> per_knot)
    : per_knot_(std::move(per_knot)), first_(per_knot_.size() + 1, 0) {
  std::partial_sum(per_knot_.begin(), per_knot_.end(), first_.begin() + 1);
  matrix_.resize(static_cast<int>(first_.size()));
  columns_.resize(kSize, pieces());
}

template <int D, int S>
void CurvatureModel<D, S>::clear() {
  matrix_.set_zero();
}

template <int D, int S>
void CurvatureModel<D, S>::add(int i, const PieceCurvature& piece,
                               const Eigen::Matrix<double, D, Eigen::Dynamic>& tangents,
                               double slope) {
  // Rows and columns: the start's state, then the end's and the duration.
  PieceCurvature by_variables = piece;
  const auto pull_back = [&](int knot, int at) {
    Eigen::Matrix<double, D, D> tangent = Eigen::Matrix<double, D, D>::Zero();
    tangent.leftCols(per_knot_[knot]) = tangents.middleCols(first_[knot], per_knot_[knot]);
    by_variables.template middleRows<D>(at) =
        (tangent.transpose() * by_variables.template middleRows<D>(at)).eval();
    by_variables.template middleCols<D>(at) =
        (by_variables.template middleCols<D>(at) * tangent).eval();
  };
  if (i > 0) pull_back(i - 1, 0);
  if (i + 1 < pieces()) {
    pull_back(i, kEnd);
  } else {  // its end is given
    by_variables.template middleRows<kEnd>(kEnd).setZero();
    by_variables.template middleCols<kEnd>(kEnd).setZero();
  }
  by_variables.template bottomRows<1>() *= slope;
  by_variables.template rightCols<1>() *= slope;
  matrix_.diagonal(i) += by_variables.template bottomRightCorner<kSize, kSize>();
  if (i == 0) return;  // so is its start
  matrix_.diagonal(i - 1).template topLeftCorner<kEnd, kEnd>() +=
      by_variables.template topLeftCorner<kEnd, kEnd>();
  matrix_.below(i).template leftCols<kEnd>() +=
      by_variables.template bottomLeftCorner<kSize, kEnd>();
}

template <int D, int S>
bool CurvatureModel<D, S>::factor(double damping) {
  for (int i = 0; i < pieces(); ++i) {
    auto& block = matrix_.diagonal(i);
    const int placed = i + 1 < pieces() ? per_knot_[i] : 0;
    for (int k = 0; k < kEnd; ++k) {
      if (k < placed) {
        block(k, k) += damping;
      } else if (k < D || i + 1 == pieces()) {
        block(k, k) += 1.0;  // no variable
      } else {
        block(k, k) *= 1.0 + kLeastCurvature;
      }
    }
    block(kEnd, kEnd) += damping;
  }
  return matrix_.factor();
}

template <int D, int S>
void CurvatureModel<D, S>::solve(Eigen::VectorXd& x) {
  const int knots = pieces() - 1;
  columns_.setZero();
  for (int k = 0; k < knots; ++k)
    columns_.col(k).head(per_knot_[k]) = x.segment(first_[k], per_knot_[k]);
  columns_.row(kEnd) = x.tail(pieces()).transpose();
  matrix_.solve(columns_);
  for (int k = 0; k < knots; ++k)
    x.segment(first_[k], per_knot_[k]) = columns_.col(k).head(per_knot_[k]);
  x.tail(pieces()) = columns_.row(kEnd).transpose();
}

template class CurvatureModel<2, 3>;
template class CurvatureModel<3, 3>;

}  // namespace mocha
