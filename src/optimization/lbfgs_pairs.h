#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace mocha {

/// The last steps of a descent and by how much each has changed the gradient: what L-BFGS knows of
/// the curvature, on top of an inner model of it. After construction nothing is allocated.
class LbfgsPairs {
 public:
  explicit LbfgsPairs(Eigen::Index variables)
      : steps_(variables, kPairs), changes_(variables, kPairs) {}

  void clear() { size_ = 0; }

  /// Forgets the oldest where there is no more room; leaves out what shows no curvature.
  void add(const Eigen::VectorXd& step, const Eigen::VectorXd& change) {
    constexpr double kLeast = 1e-10;
    const double curvature = step.dot(change);
    if (!(curvature > kLeast * step.norm() * change.norm())) return;
    newest_ = (newest_ + 1) % kPairs;
    size_ = std::min(size_ + 1, kPairs);
    steps_.col(newest_) = step;
    changes_.col(newest_) = change;
    curvatures_[newest_] = curvature;
  }

  /// A gradient becomes the step down it, backwards: the two loops of Nocedal (1980), with `inner`
  /// between them, which does the same by the inner model.
  template <typename Inner>
  void to_step(Eigen::VectorXd& gradient, const Inner& inner) const {
    Eigen::Matrix<double, kPairs, 1> shares;
    for (int age = 0; age < size_; ++age) {
      const int i = at(age);
      shares[i] = steps_.col(i).dot(gradient) / curvatures_[i];
      gradient -= shares[i] * changes_.col(i);
    }
    inner(gradient);
    for (int age = size_ - 1; age >= 0; --age) {
      const int i = at(age);
      gradient += (shares[i] - changes_.col(i).dot(gradient) / curvatures_[i]) * steps_.col(i);
    }
  }

 private:
  static constexpr int kPairs = 12;

  int at(int age) const { return (newest_ - age + kPairs) % kPairs; }

  Eigen::MatrixXd steps_;
  Eigen::MatrixXd changes_;
  Eigen::Matrix<double, kPairs, 1> curvatures_;  // step . change
  int size_ = 0;
  int newest_ = 0;
};

}  // namespace mocha
