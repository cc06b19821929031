#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
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

  /// Puts the factor in the matrix's place; false where that is not positive definite.
  bool factor() {
    for (int i = 0; i < blocks(); ++i) {
      if (i > 0) {
        diagonal_[i - 1]
            .transpose()
            .template triangularView<Eigen::Upper>()
            .template solveInPlace<Eigen::OnTheRight>(below_[i]);
        diagonal_[i].noalias() -= below_[i].lazyProduct(below_[i].transpose());
      }
      const Eigen::LLT<Eigen::Ref<Block>> cholesky(diagonal_[i]);
      if (cholesky.info() != Eigen::Success) return false;
    }
    return true;
  }

  /// Solves for a right-hand side, in its place: a column a block. Requires factor().
  void solve(Eigen::Matrix<double, N, Eigen::Dynamic>& columns) const {
    for (int i = 0; i < blocks(); ++i) {
      if (i > 0) columns.col(i) -= below_[i].lazyProduct(columns.col(i - 1));
      diagonal_[i].template triangularView<Eigen::Lower>().solveInPlace(columns.col(i));
    }
    for (int i = blocks() - 1; i >= 0; --i) {
      if (i + 1 < blocks())
        columns.col(i) -= below_[i + 1].transpose().lazyProduct(columns.col(i + 1));
      diagonal_[i].transpose().template triangularView<Eigen::Upper>().solveInPlace(columns.col(i));
    }
  }

 private:
  std::vector<Block> diagonal_;
  std::vector<Block> below_;
};

}  // namespace mocha
