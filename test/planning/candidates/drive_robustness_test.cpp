#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "planning/candidates/drive_optimizer.h"
#include "planning/candidates/start_maneuver.h"
#include "planning/worlds.h"
#include "world/margin_budget.h"
#include "world/primitive_field.h"

// Thousands of queries that make no sense: whatever comes in, no exception, no NaN out, and a
// reason.

namespace mocha {
namespace {

class StrangeQueries {
 public:
  explicit StrangeQueries(int seed) : random_(seed) {}

  /// A path with jumps, repeated points, loops, and now and then a number that is none.
  DriveQuery next() {
    DriveQuery query;
    query.duration_cost = DurationCost::total(1.0);
    query.start_time_s = pick({0.0, 1e3, 1e9, -5.0});
    Vector2 p = size() * Vector2(unit(), unit());
    const int points = static_cast<int>(pick({0, 1, 2, 2, 3, 5, 12}));
    for (int i = 0; i < points; ++i) {
      query.path.push_back(p);
      p += (one_in(200) ? 1e4 : pick({0.0, 1e-9, 0.01, 0.3, 1.0, 3.0})) * Vector2(unit(), unit());
    }
    query.start.setZero();
    if (!query.path.empty()) query.start.col(0) = query.path.front();
    query.start.col(1) = pick({0.0, 0.0, 0.5, 1.0, 5.0, 1e4}) * Vector2(unit(), unit());
    query.start.col(2) = pick({0.0, 0.5, 2.0, 100.0}) * Vector2(unit(), unit());
    if (one_in(8) && points > 0) spoil(query.path[points / 2].x());
    if (one_in(16)) spoil(query.start(1, 2));
    if (one_in(16)) spoil(query.start_time_s);
    return query;
  }

  std::vector<Obstacle> obstacles() {
    std::vector<Obstacle> obstacles;
    const int count = static_cast<int>(pick({0, 1, 5, 40}));
    for (int i = 0; i < count; ++i) {
      obstacles.push_back(Circle{5.0 * Vector2(unit(), unit()), std::abs(unit())});
    }
    return obstacles;
  }

  bool camouflage() { return one_in(2); }

 private:
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  bool one_in(int n) { return std::uniform_int_distribution<int>(1, n)(random_) == 1; }
  double size() { return pick({1.0, 1.0, 10.0, 1e5}); }
  double pick(std::initializer_list<double> values) {
    const int last = static_cast<int>(values.size()) - 1;
    return values.begin()[std::uniform_int_distribution<int>(0, last)(random_)];
  }
  void spoil(double& value) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    value = pick({std::nan(""), kInfinity, -kInfinity, 1e300, -1e12});
  }

  std::mt19937 random_;
};

/// Of the coefficients and durations; not a number if one of them is none.
double largest(const PlanarPath& curve) {
  double sum = 0.0;
  for (int i = 0; i < curve.pieces(); ++i) {
    sum += curve.piece(i).cwiseAbs().sum() + curve.piece_duration(i);
  }
  return sum;
}

TEST(DriveRobustness, StrangeQueriesGetAReasonAndNothingThatIsNotANumber) {
  const RobotModel robot = rover();
  PlannerOptions options = default_options();
  options.max_evaluations = 12;
  const DriveOptimizer optimizer(robot, options, MarginBudget::of(robot).static_margin());
  StrangeQueries queries(4);
  int refused = 0;
  int found = 0;
  int motions = 0;
  for (int i = 0; i < 4000; ++i) {
    const DriveQuery query = queries.next();
    const PrimitiveField<2> field(queries.obstacles(), 1.0);
    Effort effort;
    if (!queries.camouflage())
      effort.fallback = Fallback{FallbackKind::kCamouflageGivenUp, Vector2::Zero()};
    const auto result = optimizer.optimize_drive(query, field, effort, [] { return false; });
    EXPECT_LE(result.evaluations, options.max_evaluations);
    if (result.curve.pieces() == 0) {
      ++refused;
      EXPECT_TRUE(result.stop == StopReason::kInvalidInput || result.stop == StopReason::kNotFinite)
          << i;
      continue;
    }
    ++found;
    EXPECT_TRUE(std::isfinite(result.cost)) << i;
    const double scale = largest(result.curve);
    ASSERT_TRUE(std::isfinite(scale)) << i;
    EXPECT_LT((result.curve.state(0.0) - query.start).norm(), 1e-9 * scale) << i;
    const Vector2 end = result.curve.position(result.curve.duration());
    EXPECT_LT((end - query.path.back()).norm(), 1e-9 * scale) << i;
    EXPECT_NO_THROW(motions += static_cast<bool>(
                        Motion::make(query.start_time_s, {DrivePhase{1, result.curve}})))
        << i;
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(found, 1500);
  EXPECT_GT(motions, 1000);
}

TEST(DriveRobustness, APathThroughAnObstacleIsNotCertified) {
  const RobotModel robot = rover();
  const SpeedMargin margin = MarginBudget::of(robot).static_margin();
  const DriveOptimizer optimizer(robot, default_options(), margin);
  // A wall without an end: no way round.
  const Polygon wall{{{4.0, -500.0}, {4.5, -500.0}, {4.5, 500.0}, {4.0, 500.0}}};
  const PrimitiveField<2> field({wall}, 1.0);
  DriveQuery query{{{0.0, 0.0}, {8.0, 0.0}}, PlanarMinco::State::Zero(), 0.0, {}, {}, {}, {}, {}};
  query.duration_cost = DurationCost::total(1.0);
  query.start.col(2) = Vector2(rest_acceleration(robot.limits), 0.0);
  const auto result = optimizer.optimize_drive(query, field, {}, [] { return false; });
  ASSERT_GT(result.curve.pieces(), 0);
  const Motion motion(0.0, {DrivePhase{1, result.curve}});
  const Violation violation = check_clearance(motion, robot.footprint, field, margin, 0.0);
  ASSERT_TRUE(violation);
  EXPECT_EQ(violation.term, ViolatedTerm::kClearance);
  EXPECT_LT(violation.value, violation.limit);
}

}  // namespace
}  // namespace mocha
