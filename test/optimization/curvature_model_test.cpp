#include "optimization/curvature_model.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <numeric>
#include <utility>
#include <vector>

namespace mocha {
namespace {

constexpr int kPieces = 4;
constexpr int kState = 6;  // position, velocity, acceleration in the plane
constexpr double kSlope = 0.7;
constexpr double kDamping = 0.3;
using Model = CurvatureModel<2, 3>;

/// What the model stands for, written out: all states and durations, those of the knots by their
/// variables.
class DenseModel {
 public:
  DenseModel(const Eigen::Matrix2Xd& tangents, std::vector<int> per_knot)
      : tangents_(tangents), per_knot_(std::move(per_knot)) {}

  void add(int i, const Model::PieceCurvature& piece) {
    Eigen::MatrixXd by_all = Eigen::MatrixXd::Zero(2 * kState + 1, size());
    if (i > 0) place_state(i - 1, 0, by_all);
    if (i + 1 < kPieces) place_state(i, kState, by_all);
    by_all(2 * kState, tangents_.cols() + i) = kSlope;
    matrix_ += by_all.transpose() * piece * by_all;
  }

  /// With the free derivatives, which come last, eliminated.
  Eigen::VectorXd solve(const Eigen::VectorXd& x) const {
    Eigen::MatrixXd damped = matrix_;
    damped.topLeftCorner(x.size(), x.size()).diagonal().array() += kDamping;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size());
    right.head(x.size()) = x;
    return damped.partialPivLu().solve(right).head(x.size());
  }

 private:
  int variables() const { return static_cast<int>(tangents_.cols()) + kPieces; }
  int size() const { return variables() + 4 * (kPieces - 1); }
  void place_state(int knot, int row, Eigen::MatrixXd& by_all) const {
    const int first = std::accumulate(per_knot_.begin(), per_knot_.begin() + knot, 0);
    by_all.block(row, first, 2, per_knot_[knot]) = tangents_.middleCols(first, per_knot_[knot]);
    by_all.block<4, 4>(row + 2, variables() + 4 * knot).setIdentity();
  }

  Eigen::Matrix2Xd tangents_;
  std::vector<int> per_knot_;
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Zero(size(), size());
};

TEST(CurvatureModel, EliminatesTheFreeDerivatives) {
  for (const std::vector<int>& per_knot : {std::vector<int>{1, 1, 1}, {2, 2, 2}, {2, 1, 2}}) {
    std::srand(3);
    const int of_knots = std::accumulate(per_knot.begin(), per_knot.end(), 0);
    const Eigen::Matrix2Xd tangents = Eigen::Matrix2Xd::Random(2, of_knots);
    Model model(per_knot);
    DenseModel dense(tangents, per_knot);
    model.clear();
    for (int i = 0; i < kPieces; ++i) {
      const Model::PieceCurvature random = Model::PieceCurvature::Random();
      const Model::PieceCurvature piece = random * random.transpose();
      model.add(i, piece, tangents, kSlope);
      dense.add(i, piece);
    }
    ASSERT_TRUE(model.factor(kDamping));
    Eigen::VectorXd x = Eigen::VectorXd::Random(of_knots + kPieces);
    const Eigen::VectorXd expected = dense.solve(x);
    model.solve(x);
    EXPECT_LT((x - expected).norm(), 1e-5 * expected.norm()) << of_knots << " variables of knots";
  }
}

TEST(CurvatureModel, OfOnePieceIsThatOfItsDuration) {
  Model model(std::vector<int>{});
  model.clear();
  Model::PieceCurvature piece = Model::PieceCurvature::Identity();
  piece(2 * kState, 2 * kState) = 4.0;
  model.add(0, piece, Eigen::Matrix2Xd(2, 0), 0.5);
  ASSERT_TRUE(model.factor(1.0));
  Eigen::VectorXd x = Eigen::VectorXd::Constant(1, 6.0);
  model.solve(x);
  EXPECT_NEAR(x[0], 3.0, 1e-12);
}

TEST(CurvatureModel, RefusesWhatIsNotPositiveDefinite) {
  Model model(std::vector<int>{});
  model.clear();
  model.add(0, -Model::PieceCurvature::Identity(), Eigen::Matrix2Xd(2, 0), 1.0);
  EXPECT_FALSE(model.factor(0.5));
}

}  // namespace
}  // namespace mocha
