#include "optimization/lbfgs_pairs.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace mocha {
namespace {

constexpr int kVariables = 5;

TEST(LbfgsPairs, WithoutPairsTheStepIsTheInnerOne) {
  const LbfgsPairs pairs(kVariables);
  Eigen::VectorXd gradient = Eigen::VectorXd::Ones(kVariables);
  pairs.to_step(gradient, [](Eigen::VectorXd& inner) { inner *= 0.5; });
  EXPECT_EQ(gradient, Eigen::VectorXd::Constant(kVariables, 0.5));
}

TEST(LbfgsPairs, TheNewestPairIsSatisfiedWhateverTheInnerModel) {
  LbfgsPairs pairs(kVariables);
  std::srand(5);
  const Eigen::MatrixXd random = Eigen::MatrixXd::Random(kVariables, kVariables);
  const Eigen::MatrixXd hessian =
      random * random.transpose() + Eigen::MatrixXd::Identity(kVariables, kVariables);
  Eigen::VectorXd step;
  for (int i = 0; i < 30; ++i) {  // more than are kept
    step = Eigen::VectorXd::Random(kVariables);
    pairs.add(step, hessian * step);
  }
  Eigen::VectorXd change = hessian * step;
  pairs.to_step(change, [](Eigen::VectorXd& inner) { inner *= 3.0; });
  EXPECT_LT((change - step).norm(), 1e-9);
}

TEST(LbfgsPairs, WhatShowsNoCurvatureIsLeftOut) {
  LbfgsPairs pairs(kVariables);
  const Eigen::VectorXd step = Eigen::VectorXd::Ones(kVariables);
  pairs.add(step, -step);
  pairs.add(step, Eigen::VectorXd::Zero(kVariables));
  Eigen::VectorXd gradient = 2.0 * step;
  pairs.to_step(gradient, [](Eigen::VectorXd&) {});
  EXPECT_EQ(gradient, 2.0 * step);
}

}  // namespace
}  // namespace mocha
