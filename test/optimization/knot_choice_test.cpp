#include "optimization/knot_choice.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "optimization/pace.h"
#include "optimization/slalom.h"

namespace mocha {
namespace {

/// Knots at each candidate, for `duration_s`.
Eigen::VectorXd uniform(double duration_s) {
  return Eigen::VectorXd::Constant(Slalom::kIntervals, duration_s / Slalom::kIntervals);
}

TEST(Paced, IsNearThePaceThatCostsLeast) {
  const Slalom slalom;
  auto objective = slalom.objective(2000.0);
  Eigen::VectorXd ignored(objective.variables());
  const auto cost = [&](const Eigen::VectorXd& durations_s) {
    return objective.evaluate(objective.initial(durations_s), ignored);
  };
  for (const double start_s : {18.0, 24.0}) {
    const Eigen::VectorXd durations_s = paced(objective, uniform(start_s));
    EXPECT_GT(durations_s.sum(), start_s);
    double least = cost(durations_s);
    for (double total_s = 8.0; total_s < 100.0; total_s *= 1.02)
      least = std::min(least, cost(uniform(total_s)));
    EXPECT_LT(cost(durations_s), 1.01 * least);
    EXPECT_LT(least, 0.9 * cost(uniform(start_s)));
  }
}

TEST(Paced, IsNeverFasterThanTheFrontEnd) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const Eigen::VectorXd slow = uniform(300.0);
  EXPECT_LT((paced(objective, slow) - slow).norm(), 1e-9);
}

/// Candidates on a path that goes round a corner in its middle.
KnotCandidates<2> round_a_corner(double tolerance_m) {
  KnotCandidates<2> candidates = Slalom::candidates();
  for (int i = 0; i <= Slalom::kIntervals; ++i) {
    const double beyond_m = candidates.path(0, i) - 0.75 * Slalom::kLength_m;
    if (beyond_m > 0.0) candidates.path.col(i) += Eigen::Vector2d(-beyond_m, beyond_m);
  }
  candidates.tolerance_m = tolerance_m;
  return candidates;
}

TEST(ChooseKnots, ChoosesMoreOnlyWherePenaltiesOrThePathAskForThem) {
  const Slalom slalom;
  auto objective = slalom.objective();
  // A straight path through the posts is penalised as much by itself.
  const auto few = choose_knots(objective, Slalom::candidates());
  ASSERT_EQ(few.pieces(), Slalom::kIntervals / Slalom::kCoarsest);
  for (const RayKnot<2>& knot : few.knots) {
    EXPECT_EQ(knot.freedom, 1);
    EXPECT_NEAR(std::abs(knot.axes(1, 0)), 1.0, 1e-12) << "the ray comes from the reference";
    EXPECT_NEAR(knot.position().y(), 0.0, 1e-12);
  }
}

TEST(ChooseKnots, FollowsThePathAsCloselyAsAskedFor) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const auto loose = choose_knots(objective, round_a_corner(10.0));
  const auto close = choose_knots(objective, round_a_corner(0.05));
  EXPECT_GT(close.pieces(), loose.pieces());
  EXPECT_LT(close.pieces(), Slalom::kIntervals) << "straight stretches need no more";
  EXPECT_NEAR(close.durations_s.maxCoeff() / close.durations_s.minCoeff(), 8.0, 8.0);
  EXPECT_GT(close.durations_s.maxCoeff(), 1.9 * close.durations_s.minCoeff());
}

/// The path swerves round the posts, a coarse curve does not: it has to be told apart where it is.
TEST(ChooseKnots, FollowsAPathRoundObstacles) {
  const Slalom slalom;
  auto objective = slalom.objective();
  KnotCandidates<2> candidates = Slalom::candidates();
  for (int i = 0; i <= Slalom::kIntervals; ++i) {
    const double x = candidates.path(0, i);
    if (x < 12.5) candidates.path(1, i) = 0.45 * std::sin(M_PI * (x - 0.5) / 3.0);
  }
  candidates.path(1, 0) = 0.0;
  candidates.tolerance_m = 100.0;
  const auto chain = choose_knots(objective, candidates);
  EXPECT_GT(chain.pieces(), Slalom::kIntervals / Slalom::kCoarsest);
  EXPECT_LT(chain.durations_s[0], 0.6 * chain.durations_s[chain.pieces() - 1]);
}

TEST(ChooseKnots, WithoutReferencesKnotsAreWaypoints) {
  const Slalom slalom;
  auto objective = slalom.objective();
  KnotCandidates<2> candidates = Slalom::candidates();
  candidates.references = [](const Eigen::Matrix2Xd&) { return std::nullopt; };
  for (const RayKnot<2>& knot : choose_knots(objective, candidates).knots)
    EXPECT_EQ(knot.freedom, 2);
}

TEST(ChooseKnots, RefusesWhatIsNotAsDescribed) {
  const Slalom slalom;
  auto objective = slalom.objective();
  const auto refuses = [&](const KnotCandidates<2>& candidates) {
    EXPECT_THROW(choose_knots(objective, candidates), std::invalid_argument);
  };
  for (const int coarsest : {0, 3, 64}) {
    KnotCandidates<2> bad = Slalom::candidates();
    bad.coarsest = coarsest;
    refuses(bad);
  }
  KnotCandidates<2> bad = Slalom::candidates();
  bad.duration_s = 0.0;
  refuses(bad);
  bad = Slalom::candidates();
  bad.tolerance_m = -1.0;
  refuses(bad);
  bad = Slalom::candidates();
  bad.path(1, 3) = std::numeric_limits<double>::quiet_NaN();
  refuses(bad);
}

}  // namespace
}  // namespace mocha
