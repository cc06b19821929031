#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace mocha {

/// A symmetric positive definite matrix whose N x N blocks lie on the diagonal and beside it, and
/// its Cholesky factor. After resize() nothing is allocated.
template <int N>
class BlockTridiagonal {
 public:
  using Block = Eigen::Matrix<double, N, N>;

  void resize(int blocks) {
    diagonal_.resize(blocks);
    below_.resize(blocks);
  }
  int blocks() const { return static_cast<int>(diagonal_.size()); }

  void set_zero() {
    for (Block& block : diagonal_) block.setZero();
    for (Block& block : below_) block.setZero();
  }

  /// Block (i, i).
  Block& diagonal(int i) { return diagonal_[i]; }
  /// Block (i, i - 1); i > 0.
  Block& below(int i) { return below_[i]; }

  /// Puts the factor in the matrix's place; false where that is not positive definite. What is
  /// above the diagonal is left as it is.
  bool factor() {
    for (int i = 0; i < blocks(); ++i) {
      if (i > 0) {
        divide_by_factor(diagonal_[i - 1], below_[i]);
        for (int k = 0; k < N; ++k) subtract_square(below_[i], k, 0, diagonal_[i]);
      }
      if (!factor(diagonal_[i])) return false;
    }
    return true;
  }

  /// Solves for a right-hand side, in its place: a column a block. Requires factor().
  void solve(Eigen::Matrix<double, N, Eigen::Dynamic>& columns) const {
    for (int i = 0; i < blocks(); ++i) {
      auto x = columns.col(i);
      if (i > 0) {
        for (int k = 0; k < N; ++k) x -= columns(k, i - 1) * below_[i].col(k);
      }
      for (int k = 0; k < N; ++k) {
        x[k] /= diagonal_[i](k, k);
        for (int row = k + 1; row < N; ++row) x[row] -= x[k] * diagonal_[i](row, k);
      }
    }
    for (int i = blocks() - 1; i >= 0; --i) {
      auto x = columns.col(i);
      if (i + 1 < blocks()) {
        for (int k = 0; k < N; ++k) x[k] -= below_[i + 1].col(k).dot(columns.col(i + 1));
      }
      for (int k = N - 1; k >= 0; --k) {
        for (int row = k + 1; row < N; ++row) x[k] -= diagonal_[i](row, k) * x[row];
        x[k] /= diagonal_[i](k, k);
      }
    }
  }

 private:
  // Loops by columns, as Eigen's own solvers for blocks of a fixed size take a minute to compile.

  /// Subtracts from a block's lower half, from a column on, the square of another's column k.
  static void subtract_square(const Block& other, int k, int first, Block& block) {
    for (int column = first; column < N; ++column) {
      for (int row = column; row < N; ++row) block(row, column) -= other(row, k) * other(column, k);
    }
  }

  static bool factor(Block& block) {
    for (int k = 0; k < N; ++k) {
      if (!(block(k, k) > 0.0)) return false;
      const double root = std::sqrt(block(k, k));
      for (int row = k; row < N; ++row) block(row, k) /= root;
      subtract_square(block, k, k + 1, block);
    }
    return true;
  }

  /// Multiplies a block from the right by the inverse of a factor's transpose.
  static void divide_by_factor(const Block& factor, Block& block) {
    for (int k = 0; k < N; ++k) {
      block.col(k) /= factor(k, k);
      for (int column = k + 1; column < N; ++column)
        block.col(column) -= factor(column, k) * block.col(k);
    }
  }

  std::vector<Block> diagonal_;
  std::vector<Block> below_;
};

}  // namespace mocha
