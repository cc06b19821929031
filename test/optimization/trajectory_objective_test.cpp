#include "optimization/trajectory_objective.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "camouflage/adaptive_map.h"
#include "camouflage/camouflage_map.h"
#include "optimization/dynamics_penalty.h"
#include "optimization/moving_penalty.h"
#include "optimization/obstacle_penalty.h"
#include "optimization/trajectory_optimizer.h"
#include "optimization/turning_penalty.h"

namespace mocha {
namespace {

/// Analytic balls: distances are smooth away from the medial axis.
template <int D>
class Balls : public ObstacleField<D> {
 public:
  using typename ObstacleField<D>::Vector;
  using typename ObstacleField<D>::Sample;
  using typename ObstacleField<D>::Box;
  struct Ball {
    Vector centre;
    double radius;
  };
  explicit Balls(std::vector<Ball> balls) : balls_(std::move(balls)) {}
  Sample sample(const Vector& p) const override {
    Sample nearest{1e9, Vector::Zero()};
    for (const Ball& ball : balls_) {
      const double distance = (p - ball.centre).norm() - ball.radius;
      if (distance < nearest.distance_m) nearest = {distance, (p - ball.centre).normalized()};
    }
    return nearest;
  }
  double distance_bound(const Vector& p) const override {
    return std::max(0.0, sample(p).distance_m);
  }
  bool clear(const Box& box, double r) const override {
    return distance_bound(box.center()) > r + 0.5 * box.diagonal().norm();
  }

 private:
  std::vector<Ball> balls_;
};

template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> prey_knots(int count, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, 0.2);
  Eigen::Matrix<double, D, Eigen::Dynamic> prey(D, count);
  for (int k = 0; k < count; ++k) {
    for (int axis = 0; axis < D; ++axis)
      prey(axis, k) = (axis == 0 ? k + 1.0 : 0.0) + noise(random);
  }
  return prey;
}

template <int D, int S = 3>
typename TrajectoryObjective<D, S>::Options basic_options(std::shared_ptr<const KnotMap<D>> map,
                                                          const ObstacleField<D>& field) {
  typename TrajectoryObjective<D, S>::Options options;
  options.start.setZero();
  options.end.setZero();
  options.end(0, 0) = map->knots() + 1.0;
  options.start(0, 1) = 0.7;
  if constexpr (S > 2) options.start(1, 2) = 0.1;
  options.knot_map = map;
  options.effort_weight = 0.1;
  options.duration_cost = DurationCost::total(2.0);
  options.kappa = 12;
  options.metres_per_eta = 1.0;
  options.penalties.push_back(std::make_unique<DynamicsPenalty<D>>(7.0, 0.9, 0.6));
  options.penalties.push_back(std::make_unique<ObstaclePenalty<D>>(
      11.0, field, std::vector<typename ObstaclePenalty<D>::Cover>{{0.15, 0.6}, {-0.15, 0.7}},
      0.05));
  return options;
}

template <int D, int S>
void expect_gradient(TrajectoryObjective<D, S>& objective, const Eigen::VectorXd& x) {
  Eigen::VectorXd gradient(objective.variables());
  Eigen::VectorXd ignored(objective.variables());
  objective.evaluate(x, gradient);
  const double scale = gradient.template lpNorm<Eigen::Infinity>();
  for (int i = 0; i < x.size(); ++i) {
    // Four points: the effort of short pieces bends so much that two are not accurate enough.
    constexpr double kStep = 1e-5;
    const auto difference = [&](double step) {
      Eigen::VectorXd plus = x;
      Eigen::VectorXd minus = x;
      plus[i] += step;
      minus[i] -= step;
      return objective.evaluate(plus, ignored) - objective.evaluate(minus, ignored);
    };
    const double slope = (8.0 * difference(kStep) - difference(2.0 * kStep)) / (12.0 * kStep);
    EXPECT_NEAR(gradient[i], slope, 1e-6 * scale) << "variable " << i;
  }
}

template <int D>
Balls<D> random_balls(std::mt19937& random) {
  std::vector<typename Balls<D>::Ball> balls;
  std::uniform_real_distribution<double> along(0.0, 7.0);
  std::uniform_real_distribution<double> beside(-0.6, 0.6);
  for (int i = 0; i < 5; ++i) {
    typename Balls<D>::Ball ball;
    ball.centre.setZero();
    ball.centre[0] = along(random);
    for (int axis = 1; axis < D; ++axis) ball.centre[axis] = beside(random);
    ball.radius = 0.3;
    balls.push_back(ball);
  }
  return Balls<D>(balls);
}

Eigen::VectorXd random_start(int variables, double size, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, size);
  Eigen::VectorXd x(variables);
  for (int i = 0; i < variables; ++i) x[i] = noise(random);
  return x;
}

template <int Dimension, int Order>
struct Case {
  static constexpr int D = Dimension;
  static constexpr int S = Order;
};

template <typename Case>
class Objectives : public testing::Test {};
using Cases = testing::Types<Case<2, 3>, Case<3, 3>>;
TYPED_TEST_SUITE(Objectives, Cases);

TYPED_TEST(Objectives, GradientMatchesDifferences) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  for (int seed = 1; seed <= 8; ++seed) {
    std::mt19937 random(seed);
    const auto prey = prey_knots<D>(5, random);
    Eigen::Matrix<double, D, Eigen::Dynamic> references = prey;
    references.row(1).array() -= 3.0;
    const Balls<D> balls = random_balls<D>(random);
    auto options =
        basic_options<D, S>(std::make_shared<CamouflageMap<D>>(prey, references, 1.5), balls);
    options.metres_per_eta = 0.7;
    TrajectoryObjective<D, S> reduced(std::move(options));
    expect_gradient(reduced, random_start(reduced.variables(), 0.4, random));
    TrajectoryObjective<D, S> full(
        basic_options<D, S>(std::make_shared<WaypointMap<D>>(prey), balls));
    expect_gradient(full, full.initial(Eigen::VectorXd::Constant(6, 1.2)));
  }
}

/// Other knots, other numbers of variables: the same as an objective made for them.
TYPED_TEST(Objectives, WithOtherKnotsItIsAsIfMadeForThem) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  std::mt19937 random(4);
  const auto prey = prey_knots<D>(5, random);
  const Balls<D> balls = random_balls<D>(random);
  std::vector<RayKnot<D>> knots;
  for (int k = 0; k < 5; ++k) {
    knots.push_back(RayKnot<D>::on_ray(prey.col(k), RayKnot<D>::Vector::Ones()));
    knots.back().freedom = 1 + k % D;
    knots.back().units_per_m = 1.0 + 0.5 * k;
  }
  const auto map = std::make_shared<AdaptiveMap<D>>(knots, 1.5);
  TrajectoryObjective<D, S> changed(
      basic_options<D, S>(std::make_shared<WaypointMap<D>>(prey_knots<D>(9, random)), balls));
  auto options = basic_options<D, S>(map, balls);
  options.end(0, 0) = 10.0;  // where the other one's nine knots lead
  TrajectoryObjective<D, S> made(std::move(options));
  changed.set_knot_map(map);
  ASSERT_EQ(changed.variables(), made.variables());
  ASSERT_EQ(changed.pieces(), 6);
  const Eigen::VectorXd x = random_start(made.variables(), 0.4, random);
  Eigen::VectorXd by_changed(x.size());
  Eigen::VectorXd by_made(x.size());
  EXPECT_EQ(changed.evaluate(x, by_changed), made.evaluate(x, by_made));
  EXPECT_EQ(by_changed, by_made);
  expect_gradient(changed, x);
  changed.evaluate(x, by_changed);
  ASSERT_TRUE(changed.prepare_steps(1.0) && made.prepare_steps(1.0));
  made.evaluate(x, by_made);
  changed.to_step(by_changed);
  made.to_step(by_made);
  EXPECT_LT((by_changed - by_made).norm(), 1e-9 * by_made.norm());
}

TYPED_TEST(Objectives, ByPaceIsTheSlopeByTheLogarithmOfAllDurations) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  std::mt19937 random(6);
  const Balls<D> balls = random_balls<D>(random);
  TrajectoryObjective<D, S> objective(
      basic_options<D, S>(std::make_shared<WaypointMap<D>>(prey_knots<D>(5, random)), balls));
  Eigen::VectorXd ignored(objective.variables());
  const auto cost = [&](double log_factor) {
    const Eigen::VectorXd durations_s = Eigen::VectorXd::Constant(6, 1.2 * std::exp(log_factor));
    return objective.evaluate(objective.initial(durations_s), ignored);
  };
  const double slope = (cost(1e-5) - cost(-1e-5)) / 2e-5;
  cost(0.0);
  EXPECT_NEAR(objective.by_pace(), slope, 1e-5 * std::abs(slope));
}

/// Penalties may only be skipped where they are zero: the same cost as with every sample looked at.
template <int D>
class Unskipped : public Penalty<D> {
 public:
  explicit Unskipped(std::unique_ptr<Penalty<D>> inner) : inner_(std::move(inner)) {}
  const char* name() const override { return inner_->name(); }
  Derivatives wanted(const PieceBounds<D>&) const override {
    return kPosition | kVelocity | kAcceleration | kJerk | kTime;
  }
  void add(const PieceSamples<D>& samples, PenaltyRows<D>& rows) const override {
    PieceSamples<D> unbounded = samples;
    unbounded.bounds.max_speed2 = 1e300;
    unbounded.bounds.max_acceleration2 = 1e300;
    unbounded.bounds.min_speed2 = 0.0;
    inner_->add(unbounded, rows);
  }

 private:
  std::unique_ptr<Penalty<D>> inner_;
};

TYPED_TEST(Objectives, SkippingChangesNothing) {
  constexpr int D = TypeParam::D;
  constexpr int S = TypeParam::S;
  int quiet = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const auto prey = prey_knots<D>(5, random);
    const Balls<D> balls = random_balls<D>(random);
    const auto options = [&] {
      return basic_options<D, S>(std::make_shared<WaypointMap<D>>(prey), balls);
    };
    auto unskipped_options = options();
    for (auto& penalty : unskipped_options.penalties) {
      penalty = std::make_unique<Unskipped<D>>(std::move(penalty));
    }
    TrajectoryObjective<D, S> skipping(options());
    TrajectoryObjective<D, S> unskipped(std::move(unskipped_options));
    const Eigen::VectorXd x = skipping.initial(Eigen::VectorXd::Constant(6, 0.8 + 0.05 * seed));
    Eigen::VectorXd gradient(x.size());
    Eigen::VectorXd expected(x.size());
    const double cost = unskipped.evaluate(x, expected);
    EXPECT_NEAR(skipping.evaluate(x, gradient), cost, 1e-12 * cost);
    EXPECT_LT((gradient - expected).norm(), 1e-12 * expected.norm());
    for (const auto& term : skipping.terms()) quiet += term.second == 0.0;
  }
  EXPECT_GT(quiet, 5);
}

TEST(TrajectoryObjective, GradientMatchesDifferencesWithTurningAndMovingTerms) {
  for (int seed = 1; seed <= 8; ++seed) {
    std::mt19937 random(seed);
    const auto prey = prey_knots<2>(5, random);
    auto map = std::make_shared<WaypointMap<2>>(prey);
    const Balls<2> balls = random_balls<2>(random);
    auto options = basic_options<2>(map, balls);
    options.penalties.push_back(std::make_unique<TurningPenalty>(3.0, 0.4, 0.1));
    const auto walker = std::make_shared<PredictedDisc>("walker", 10.0, Vector2(4.0, -1.0),
                                                        Vector2(-0.2, 0.4), 0.3, 0.1);
    options.penalties.push_back(
        std::make_unique<MovingPenalty>(5.0, 10.0, std::vector<MovingThing>{{walker, 0.7, 1e9}}));
    TrajectoryObjective<2, 3> objective(std::move(options));
    expect_gradient(objective, objective.initial(Eigen::VectorXd::Constant(6, 0.9)));
  }
}

TEST(TrajectoryObjective, GradientMatchesDifferencesWhereADriveStartsAtRest) {
  for (int seed = 1; seed <= 8; ++seed) {
    std::mt19937 random(seed);
    const auto prey = prey_knots<2>(5, random);
    auto map = std::make_shared<WaypointMap<2>>(prey);
    const Balls<2> balls = random_balls<2>(random);
    auto options = basic_options<2>(map, balls);
    options.start.col(1).setZero();
    options.start.col(2) = Vector2(0.3, -0.4);
    options.penalties.push_back(std::make_unique<TurningPenalty>(3.0, 0.05, 0.1));
    TrajectoryObjective<2, 3> objective(std::move(options));
    Eigen::VectorXd gradient(objective.variables());
    const Eigen::VectorXd x = objective.initial(Eigen::VectorXd::Constant(6, 0.9));
    objective.evaluate(x, gradient);
    EXPECT_GT(objective.terms().back().second, 0.0);
    expect_gradient(objective, x);
  }
}

TEST(TrajectoryObjective, TermsAddUpToTheCost) {
  std::mt19937 random(3);
  const Balls<2> balls = random_balls<2>(random);
  auto map = std::make_shared<WaypointMap<2>>(prey_knots<2>(5, random));
  TrajectoryObjective<2, 3> objective(basic_options<2>(map, balls));
  Eigen::VectorXd gradient(objective.variables());
  const double cost =
      objective.evaluate(objective.initial(Eigen::VectorXd::Constant(6, 1.0)), gradient);
  double sum = 0.0;
  for (const auto& term : objective.terms()) sum += term.second;
  EXPECT_NEAR(sum, cost, 1e-9 * cost);
  double of_pieces = objective.effort() + objective.duration_cost();
  for (int i = 0; i < objective.pieces(); ++i) of_pieces += objective.penalty(i);
  EXPECT_NEAR(of_pieces, cost, 1e-9 * cost);
}

TEST(TrajectoryOptimizer, AvoidsAnObstacleOnThePreyPath) {
  Eigen::Matrix2Xd prey(2, 5);
  prey << 1, 2, 3, 4, 5, 0, 0.01, 0.01, 0.01, 0;
  Eigen::Matrix2Xd references = prey;
  references.row(1).setConstant(-3.0);
  const Balls<2> balls({{{3.0, -0.2}, 0.3}});
  auto options = basic_options<2>(std::make_shared<CamouflageMap<2>>(prey, references, 1.5), balls);
  options.start.rightCols<2>().setZero();
  options.penalties.clear();
  options.penalties.push_back(std::make_unique<DynamicsPenalty<2>>(1e3, 1.0, 1.0));
  options.penalties.push_back(std::make_unique<ObstaclePenalty<2>>(
      1e3, balls, std::vector<ObstaclePenalty<2>::Cover>{{0.0, 0.5}}, 0.05));
  TrajectoryObjective<2, 3> objective(std::move(options));
  const auto result =
      optimize<2, 3>(objective, objective.initial(Eigen::VectorXd::Constant(6, 1.3)),
                     {400, 1e-4, [] { return false; }});
  EXPECT_EQ(result.stop, StopReason::kConverged);
  double clearance = 1e9;
  for (double t = 0.0; t < result.curve.duration(); t += 0.01) {
    clearance = std::min(clearance, balls.sample(result.curve.position(t)).distance_m);
  }
  EXPECT_GT(clearance, 0.45);
  EXPECT_GT(result.curve.duration(), 6.0);  // no faster than the speed limit allows
  EXPECT_LT(result.curve.duration(),
            8.5);  // and not much slower: 6 s + 1 s for starting and stopping
}

TEST(TrajectoryOptimizer, ReportsWhyItStopped) {
  std::mt19937 random(3);
  const Balls<2> balls = random_balls<2>(random);
  auto map = std::make_shared<WaypointMap<2>>(prey_knots<2>(5, random));
  TrajectoryObjective<2, 3> objective(basic_options<2>(map, balls));
  const Eigen::VectorXd x = objective.initial(Eigen::VectorXd::Constant(6, 1.0));
  OptimizerOptions options{5, 1e-4, [] { return false; }};
  const auto exhausted = optimize<2, 3>(objective, x, options);
  EXPECT_EQ(exhausted.stop, StopReason::kBudget);
  EXPECT_EQ(exhausted.evaluations, 5);
  EXPECT_EQ(exhausted.curve.pieces(), 6);
  options.should_stop = [] { return true; };
  EXPECT_EQ((optimize<2, 3>(objective, x, options).stop), StopReason::kStopped);
}

}  // namespace
}  // namespace mocha
