#include "simulation/sensor_fault.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "simulation/world_simulator.h"

namespace mocha {
namespace {

constexpr double kStep_s = 0.02;
constexpr double kWall_m = 4.0;  // ahead, on both sides and behind

SensorFault fault(const std::string& name) {
  auto values = ParameterTable::from_schema("config/fleet_simulator.yaml");
  values.change({{"sensor_fault", name}});
  return SensorFault::from(values);
}

WorldRobot robot(const std::string& name, const Pose& start) {
  WorldRobot robot{name, load_robot_model("config", "rover"), start, {}};
  robot.model.lidar.beams = 360;
  robot.model.lidar.dropout = 0.0;
  robot.model.lidar.sweep_time_s = 0.0;
  robot.model.odometry_noise_distance = 0.0;
  robot.model.odometry_noise_yaw = 0.0;
  return robot;
}

/// A square room with two robots.
World room(double noise_m) {
  World world;
  const auto wall = [](double x0, double y0, double x1, double y1) {
    return Polygon{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
  };
  const double a = kWall_m;
  const double b = kWall_m + 0.2;
  world.polygons = {wall(-b, a, b, b), wall(-b, -b, b, -a), wall(-b, -a, -a, a), wall(a, -a, b, a)};
  world.robots = {robot("ugv1", {}), robot("ugv2", {{0.0, -3.0}, 0.0})};
  for (WorldRobot& robot : world.robots) robot.model.lidar.noise_m = noise_m;
  return world;
}

/// Drives the first robot for a time; its sweeps.
std::vector<Scan> drive(WorldSimulator& simulator, double duration_s, const Twist& twist) {
  std::vector<Scan> scans;
  const double from_s = simulator.time_s();
  for (int i = 1; i <= std::lround(duration_s / kStep_s); ++i) {
    simulator.command(0, twist);
    for (auto& sweep : simulator.step_to(from_s + i * kStep_s).scans) {
      if (sweep.robot == 0) scans.push_back(std::move(sweep.scan));
    }
  }
  return scans;
}

/// The beam that looks to a bearing.
float range_at(const WorldSimulator& simulator, const Scan& scan, double bearing_rad) {
  const Lidar& lidar = simulator.robots()[0].lidar;
  return scan.ranges_m.at(
      std::lround((bearing_rad - lidar.angle_min_rad()) / lidar.angle_increment_rad()));
}

TEST(SensorFault, EveryNameOfTheParameterIsAnother) {
  const auto values = ParameterTable::from_schema("config/fleet_simulator.yaml");
  for (const std::string& name : values.parameters().at("sensor_fault").choices) {
    const SensorFault lie = fault(name);
    const int kinds = lie.lidar.frozen + (lie.lidar.delay_s > 0.0) + (lie.lidar.turn_rad > 0.0) +
                      (lie.lidar.noise_factor > 1.0) + (lie.lidar.blind_rad > 0.0) +
                      lie.odometry.frozen + (lie.odometry.slip > 0.0);
    EXPECT_EQ(kinds, name == "none" ? 0 : 1) << name;
  }
}

TEST(SensorFault, AFrozenLidarRepeatsItselfWithFreshStamps) {
  WorldSimulator simulator(room(0.01), 0.0, 1);
  const Scan before = drive(simulator, 1.0, {}).back();
  simulator.set_fault("ugv1", fault("scan_frozen"));
  for (const Scan& scan : drive(simulator, 1.0, {0.5, 0.5})) {
    EXPECT_EQ(scan.ranges_m, before.ranges_m);
    EXPECT_GT(scan.start_time_s, before.start_time_s);
  }
  simulator.set_fault("ugv1", {});
  EXPECT_NE(drive(simulator, 0.2, {}).back().ranges_m, before.ranges_m);
}

TEST(SensorFault, ADelayedScanShowsWhatWasThen) {
  WorldSimulator honest(room(0.0), 0.0, 1);
  WorldSimulator late(room(0.0), 0.0, 1);
  late.set_fault("", fault("scan_delayed"));
  const auto fresh = drive(honest, 3.0, {0.5, 0.3});
  const auto stale = drive(late, 3.0, {0.5, 0.3});
  ASSERT_EQ(fresh.size(), stale.size());
  for (std::size_t i = 3; i < fresh.size(); ++i) {
    EXPECT_DOUBLE_EQ(stale[i].start_time_s, fresh[i].start_time_s);
    for (std::size_t beam = 0; beam < fresh[i].ranges_m.size(); ++beam)
      ASSERT_NEAR(stale[i].ranges_m[beam], fresh[i - 3].ranges_m[beam], 1e-4);
  }
}

TEST(SensorFault, ATurnedLidarLooksToTheLeft) {
  WorldSimulator simulator(room(0.0), 0.0, 1);
  simulator.set_fault("ugv1", fault("scan_rotated"));
  const Scan scan = drive(simulator, 0.2, {}).back();
  EXPECT_NEAR(range_at(simulator, scan, 0.0), kWall_m / std::cos(3.0 * M_PI / 180.0), 1e-3);
}

TEST(SensorFault, ANoisyLidarScattersThriceAsMuch) {
  WorldSimulator simulator(room(0.01), 0.0, 1);
  simulator.set_fault("ugv1", fault("scan_noisy"));
  double squares = 0.0;
  const auto scans = drive(simulator, 100.0, {});
  for (const Scan& scan : scans) squares += std::pow(range_at(simulator, scan, 0.0) - kWall_m, 2);
  EXPECT_NEAR(std::sqrt(squares / scans.size()), 0.03, 0.003);
}

TEST(SensorFault, ABlindSectorReturnsNothingAhead) {
  WorldSimulator simulator(room(0.0), 0.0, 1);
  simulator.set_fault("ugv1", fault("scan_blind_sector"));
  const Scan scan = drive(simulator, 0.2, {}).back();
  for (const double bearing : {-0.5, 0.0, 0.5})
    EXPECT_TRUE(std::isinf(range_at(simulator, scan, bearing)));
  for (const double bearing : {-3.0, -0.55, 0.55, 3.0})
    EXPECT_TRUE(std::isfinite(range_at(simulator, scan, bearing)));
}

TEST(SensorFault, AFrozenOdometryStandsWhileTheRobotDrives) {
  WorldSimulator simulator(room(0.0), 0.0, 1);
  drive(simulator, 1.0, {0.5, 0.0});
  const Odometry& odometry = simulator.robots()[0].odometry;
  const Pose stands = odometry.pose();
  const Twist twist = odometry.twist();
  simulator.set_fault("ugv1", fault("odometry_frozen"));
  drive(simulator, 1.0, {0.0, 0.5});
  EXPECT_EQ(odometry.pose().position, stands.position);
  EXPECT_EQ(odometry.pose().yaw_rad, stands.yaw_rad);
  EXPECT_EQ(odometry.twist().speed, twist.speed);
  EXPECT_NEAR(
      (odometry.honest_pose().position - simulator.robots()[0].vehicle.pose().position).norm(), 0.0,
      1e-9);
  simulator.set_fault("ugv1", {});
  EXPECT_EQ(odometry.honest_pose().position, stands.position) << "what was lost stays lost";
}

TEST(SensorFault, ASlippingOdometryReportsMoreTravel) {
  WorldSimulator simulator(room(0.0), 0.0, 1);
  simulator.set_fault("ugv1", fault("odometry_slipping"));
  drive(simulator, 2.0, {0.5, 0.0});
  const SimulatedRobot& robot = simulator.robots()[0];
  EXPECT_NEAR(robot.odometry.pose().position.x(), 1.2 * robot.vehicle.pose().position.x(), 1e-9);
  EXPECT_NEAR(robot.odometry.twist().speed, 1.2 * robot.vehicle.twist().speed, 1e-9);
}

TEST(SensorFault, OnlyTheRobotThatIsNamedLies) {
  WorldSimulator simulator(room(0.0), 0.0, 1);
  simulator.set_fault("ugv2", fault("odometry_slipping"));
  drive(simulator, 1.0, {0.5, 0.0});
  EXPECT_NEAR(simulator.robots()[0].odometry.pose().position.x(),
              simulator.robots()[0].vehicle.pose().position.x(), 1e-9);
  EXPECT_THROW(simulator.set_fault("ugv3", {}), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
