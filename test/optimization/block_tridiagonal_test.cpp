#include "optimization/block_tridiagonal.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

namespace mocha {
namespace {

constexpr int kSize = 3;
constexpr int kBlocks = 4;

/// Sets random blocks, with `more` added on the diagonal; returns the same as one matrix.
Eigen::MatrixXd fill(BlockTridiagonal<kSize>& matrix, double more) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(kSize * kBlocks, kSize * kBlocks);
  matrix.resize(kBlocks);
  matrix.set_zero();
  std::srand(7);
  for (int i = 0; i < kBlocks; ++i) {
    const Eigen::Matrix3d random = Eigen::Matrix3d::Random();
    matrix.diagonal(i) = random * random.transpose() + more * Eigen::Matrix3d::Identity();
    dense.block<kSize, kSize>(kSize * i, kSize * i) = matrix.diagonal(i);
    if (i == 0) continue;
    matrix.below(i).setRandom();
    dense.block<kSize, kSize>(kSize * i, kSize * (i - 1)) = matrix.below(i);
    dense.block<kSize, kSize>(kSize * (i - 1), kSize * i) = matrix.below(i).transpose();
  }
  return dense;
}

TEST(BlockTridiagonal, SolvesAsTheDenseMatrixDoes) {
  BlockTridiagonal<kSize> matrix;
  const Eigen::MatrixXd dense = fill(matrix, 3.0);
  Eigen::Matrix3Xd columns = Eigen::Matrix3Xd::Random(kSize, kBlocks);
  const Eigen::VectorXd right = Eigen::Map<Eigen::VectorXd>(columns.data(), columns.size());
  ASSERT_TRUE(matrix.factor());
  matrix.solve(columns);
  const Eigen::VectorXd expected = dense.partialPivLu().solve(right);
  EXPECT_LT((Eigen::Map<Eigen::VectorXd>(columns.data(), columns.size()) - expected).norm(), 1e-12);
}

TEST(BlockTridiagonal, SaysThatItIsNotPositiveDefinite) {
  BlockTridiagonal<kSize> matrix;
  fill(matrix, -1.0);
  EXPECT_FALSE(matrix.factor());
}

}  // namespace
}  // namespace mocha
