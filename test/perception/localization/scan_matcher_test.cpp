#include "perception/localization/scan_matcher.h"

#include <gtest/gtest.h>

#include <random>

#include "perception/localization/localisation_scene.h"
#include "perception/localization/match_function.h"

namespace mocha {
namespace {

ScanMatcherOptions options() { return shipped_localizer_options().matcher; }

Eigen::Matrix3d covariance(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

/// A street without ends: nothing says how far along it the robot is.
struct Street {
  Street() {
    OccupancyGrid grid;
    grid.resolution_m = 0.05;
    grid.origin = {-20.0, -2.0};
    grid.width = 800;
    grid.height = 80;
    grid.cells.assign(800 * 80, OccupancyGrid::kFree);
    for (int x = 0; x < 800; ++x)
      grid.at(x, 10) = grid.at(x, 69) = OccupancyGrid::kOccupied;  // 2.95 m apart
    walls.emplace(grid, 1.0);
  }

  /// From the middle of the street.
  static ScanHits scan() {
    ScanHits scan;
    for (double x = -6.0; x <= 6.0; x += 0.1) {
      scan.hits.emplace_back(x, 1.475);
      scan.hits.emplace_back(x, -1.475);
    }
    return scan;
  }

  std::optional<LikelihoodField> walls;
};

TEST(ScanMatcherTest, TheJacobianIsThatOfTheResiduals) {
  const Street street;
  const ScanHits scan = Street::scan();
  const PoseEstimate prior{{{0.3, 0.04}, 0.2}, covariance(0.1, 0.05)};
  const MatchFunction function(scan, *street.walls, prior, options());
  const int rows = function.NumResiduals();
  const Eigen::Vector3d at(0.013, -0.021, 0.017);
  Eigen::VectorXd residuals(rows);
  Eigen::MatrixXd jacobian(rows, 3);
  function(at.data(), residuals.data(), jacobian.data());
  constexpr double kStep = 1e-7;
  int compared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d low = at - kStep * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d high = at + kStep * Eigen::Vector3d::Unit(axis);
    Eigen::VectorXd before(rows);
    Eigen::VectorXd after(rows);
    function(low.data(), before.data(), nullptr);
    function(high.data(), after.data(), nullptr);
    for (int row = 0; row < rows; ++row) {
      // Across the line between two cells the interpolated distance has a kink.
      const double forward = (after[row] - residuals[row]) / kStep;
      const double backward = (residuals[row] - before[row]) / kStep;
      if (std::abs(forward - backward) > 1e-3) continue;
      EXPECT_NEAR(jacobian(row, axis), 0.5 * (forward + backward), 1e-3) << row << ' ' << axis;
      ++compared;
    }
  }
  EXPECT_GT(compared, 3 * rows * 9 / 10);
}

TEST(ScanMatcherTest, FindsThePoseAcrossAStreetAndKeepsThePriorAlongIt) {
  const Street street;
  const PoseEstimate prior{{{0.3, 0.09}, 0.04}, covariance(0.1, 0.05)};
  const PoseEstimate match = ScanMatcher(options()).match(Street::scan(), *street.walls, prior);
  EXPECT_NEAR(match.pose.position.y(), 0.0, 0.01);
  EXPECT_NEAR(match.pose.yaw_rad, 0.0, 0.003);
  EXPECT_NEAR(match.pose.position.x(), 0.3, 0.01);
  EXPECT_LT(std::sqrt(match.covariance(1, 1)), 0.02);
  EXPECT_GT(std::sqrt(match.covariance(0, 0)), 0.08);
}

TEST(ScanMatcherTest, HitsOnWhatTheMapDoesNotKnowHaveNoSay) {
  const Street street;
  ScanHits scan = Street::scan();
  const PoseEstimate prior{{{0.3, 0.05}, 0.02}, covariance(0.1, 0.05)};
  const PoseEstimate alone = ScanMatcher(options()).match(scan, *street.walls, prior);
  const std::size_t people = scan.hits.size() / 2;
  for (std::size_t i = 0; i < people; ++i)
    scan.hits.emplace_back(1.0 + 0.01 * static_cast<double>(i % 20), 0.5);
  const PoseEstimate crowded = ScanMatcher(options()).match(scan, *street.walls, prior);
  EXPECT_NEAR(crowded.pose.position.y(), alone.pose.position.y(), 0.01);
  EXPECT_NEAR(crowded.pose.yaw_rad, alone.pose.yaw_rad, 0.005);
}

TEST(ScanMatcherTest, ItsCovarianceIsNotBetterThanItsErrors) {
  World world = one_robot_world("config/worlds/corridor.yaml", {{0.0, 0.0}, 0.0});
  const RobotModel& model = world.robots[0].model;
  const LikelihoodField walls(map_of(drive_through(world, corridor_path(), 1), model), 1.0);
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  int count = 0;
  const ScanMatcher matcher(options());
  for (const DriveScan& sweep : drive_through(world, corridor_path(), 2)) {
    const Pose off{sweep.truth.position + 0.05 * Vector2(normal(random), normal(random)),
                   sweep.truth.yaw_rad + 0.02 * normal(random)};
    const PoseEstimate match =
        matcher.match(hits_of(sweep, model.lidar), walls, {off, covariance(0.05, 0.02)});
    Eigen::Vector3d error;
    error << match.pose.position - sweep.truth.position,
        wrap_angle(match.pose.yaw_rad - sweep.truth.yaw_rad);
    sum += error.dot(match.covariance.inverse() * error);
    ++count;
  }
  EXPECT_LT(sum / count, 6.0);
  EXPECT_GT(sum / count, 0.3);
}

TEST(PoseEstimateTest, SaysWhatIsWrongWithIt) {
  const PoseEstimate sound{{{1.0, 2.0}, 0.3}, covariance(0.1, 0.05)};
  EXPECT_EQ(fault_of(sound), "");
  for (const double odd : {double{NAN}, double{INFINITY}, -1e300, 1e6}) {
    PoseEstimate nowhere = sound;
    nowhere.pose.position.y() = odd;
    EXPECT_EQ(fault_of(nowhere), "not finite, or too far away") << odd;
  }
  PoseEstimate aimless = sound;
  aimless.pose.yaw_rad = NAN;
  EXPECT_EQ(fault_of(aimless), "not finite, or too far away");
  for (const double odd : {double{NAN}, double{INFINITY}, -1.0, 0.0}) {
    PoseEstimate vague = sound;
    vague.covariance(1, 1) = odd;
    EXPECT_EQ(fault_of(vague), "its covariance is not positive definite") << odd;
  }
}

}  // namespace
}  // namespace mocha
