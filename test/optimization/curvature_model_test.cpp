#include "optimization/curvature_model.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

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
  explicit DenseModel(const Eigen::Matrix2Xd& tangents)
      : tangents_(tangents), per_knot_(static_cast<int>(tangents.cols()) / (kPieces - 1)) {}

  void add(int i, const Model::PieceCurvature& piece) {
    Eigen::MatrixXd by_all = Eigen::MatrixXd::Zero(2 * kState + 1, size());
    if (i > 0) place_state(i - 1, 0, by_all);
    if (i + 1 < kPieces) place_state(i, kState, by_all);
    by_all(2 * kState, per_knot_ * (kPieces - 1) + i) = kSlope;
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
  int variables() const { return per_knot_ * (kPieces - 1) + kPieces; }
  int size() const { return variables() + 4 * (kPieces - 1); }
  void place_state(int knot, int row, Eigen::MatrixXd& by_all) const {
    by_all.block(row, knot * per_knot_, 2, per_knot_) =
        tangents_.middleCols(knot * per_knot_, per_knot_);
    by_all.block<4, 4>(row + 2, variables() + 4 * knot).setIdentity();
  }

  Eigen::Matrix2Xd tangents_;
  int per_knot_;
  Eigen::MatrixXd matrix_ = Eigen::MatrixXd::Zero(size(), size());
};

TEST(CurvatureModel, EliminatesTheFreeDerivatives) {
  for (const int per_knot : {1, 2}) {
    std::srand(3);
    const Eigen::Matrix2Xd tangents = Eigen::Matrix2Xd::Random(2, per_knot * (kPieces - 1));
    Model model(std::vector<int>(kPieces - 1, per_knot));
    DenseModel dense(tangents);
    model.clear();
    for (int i = 0; i < kPieces; ++i) {
      const Model::PieceCurvature random = Model::PieceCurvature::Random();
      const Model::PieceCurvature piece = random * random.transpose();
      model.add(i, piece, tangents, kSlope);
      dense.add(i, piece);
    }
    ASSERT_TRUE(model.factor(kDamping));
    Eigen::VectorXd x = Eigen::VectorXd::Random(per_knot * (kPieces - 1) + kPieces);
    const Eigen::VectorXd expected = dense.solve(x);
    model.solve(x);
    EXPECT_LT((x - expected).norm(), 1e-5 * expected.norm()) << per_knot << " variables a knot";
  }
}

TEST(CurvatureModel, OfOnePieceIsThatOfItsDuration) {
  Model model(1, 0);
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
  Model model(1, 0);
  model.clear();
  model.add(0, -Model::PieceCurvature::Identity(), Eigen::Matrix2Xd(2, 0), 1.0);
  EXPECT_FALSE(model.factor(0.5));
}

}  // namespace
}  // namespace mocha
