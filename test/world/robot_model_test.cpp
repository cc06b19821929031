#include "world/robot_model.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "config/parameter_table.h"

namespace mocha {
namespace {

namespace fs = std::filesystem;

/// A config directory of its own, with the package's schema and one robot.
class RobotModelTest : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("mocha_robot_model_" + std::to_string(::getpid()));
    fs::create_directories(directory_ / "robots");
    fs::copy_file("config/robot.yaml", directory_ / "robot.yaml",
                  fs::copy_options::overwrite_existing);
  }
  void TearDown() override { fs::remove_all(directory_); }

  RobotModel load(const std::string& text) {
    std::ofstream(directory_ / "robots/test.yaml") << text;
    return load_robot_model(directory_.string(), "test");
  }

  std::string refusal(const std::string& text) {
    try {
      load(text);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "accepted";
  }

  fs::path directory_;
};

TEST_F(RobotModelTest, EveryShippedRobotLoads) {
  int count = 0;
  for (const auto& file : fs::directory_iterator("config/robots")) {
    const std::string name = file.path().stem().string();
    EXPECT_NO_THROW(EXPECT_EQ(load_robot_model("config", name).name, name)) << name;
    ++count;
  }
  EXPECT_GE(count, 2);
}

TEST_F(RobotModelTest, AFileAnywhereIsNamedByItsPath) {
  const std::string path = (directory_ / "mine.yaml").string();
  std::ofstream(path) << "max_speed: 0.4";
  const RobotModel mine = load_robot_model(directory_.string(), path);
  EXPECT_EQ(mine.limits.max_speed, 0.4);
  EXPECT_EQ(mine.name, path);
  std::ofstream(path) << "max_speed: 40";
  try {
    load_robot_model(directory_.string(), path);
    ADD_FAILURE();
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
  }
}

TEST_F(RobotModelTest, MarginsAreNoLargerAtRestThanAtSpeed) {
  EXPECT_EQ(load("margin_tracking: 0.02\nmargin_map: 0.005\n").margins.tracking_still_m, 0.02);
  EXPECT_NE(refusal("margin_tracking: 0.015").find("margin_tracking_still = 0.02 m is above"),
            std::string::npos);
  EXPECT_NE(refusal("margin_map_still: 0.04").find("margin_map_still = 0.04 m is above"),
            std::string::npos);
}

TEST_F(RobotModelTest, TheJackalIsThatOfTheBarnChallenge) {
  const RobotModel jackal = load_robot_model("config", "jackal");
  EXPECT_EQ(jackal.limits.max_speed, 2.0);
  EXPECT_EQ(jackal.limits.max_acceleration, 4.0);
  EXPECT_EQ(jackal.limits.max_yaw_rate, 4.0);
  EXPECT_FALSE(jackal.footprint.is_disc());
  EXPECT_EQ(jackal.lidar.beams, 1081);
  EXPECT_NEAR(jackal.lidar.field_of_view_rad / (jackal.lidar.beams - 1), M_PI / 720.0, 1e-8);
  EXPECT_EQ(jackal.lidar.rate_hz, 40.0);
  EXPECT_EQ(jackal.lidar.max_range_m, 10.0);
}

TEST_F(RobotModelTest, BrakesWithinItsLimitsAndHardWithinThoseOfAnEmergency) {
  RobotModel robot = load_robot_model("config", "jackal");
  // As braking along a path asks for (trajectory/stopping.h).
  EXPECT_LE(robot.braking().deceleration(), 0.7 * robot.limits.max_acceleration);
  EXPECT_GE(robot.braking().deceleration(), 0.5 * robot.limits.max_acceleration);
  EXPECT_EQ(robot.emergency_limits().max_acceleration, robot.emergency_acceleration);
  EXPECT_GT(robot.hard_braking().deceleration(), robot.braking().deceleration());
  EXPECT_LT(robot.hard_braking().deceleration(), robot.emergency_acceleration);
  // Gentler in bends.
  const double all = robot.limits.max_acceleration;
  EXPECT_LT(robot.braking().beside(0.99 * all), 0.99 * robot.braking().deceleration());
  EXPECT_EQ(robot.hard_braking().beside(0.0), robot.hard_braking().deceleration());
  EXPECT_LT(robot.hard_braking().beside(0.99 * robot.emergency_acceleration), all);
  // Never harder than told.
  robot.limits.max_acceleration = 0.77777;
  EXPECT_DOUBLE_EQ(robot.braking().deceleration(), 0.466);
  EXPECT_DOUBLE_EQ(robot.braking().max_acceleration(), 0.777);
}

TEST_F(RobotModelTest, ValuesThatAreNotGivenAreTheSchemasDefaults) {
  const RobotModel robot = load("max_speed: 0.5\nlidar_x: 0.2\n");
  EXPECT_EQ(robot.limits.max_speed, 0.5);
  EXPECT_EQ(robot.lidar.mount.position.x(), 0.2);
  EXPECT_EQ(robot.footprint.circumscribed_radius_m(), 0.3);
  EXPECT_NEAR(robot.lidar.field_of_view_rad, 2.0 * M_PI, 1e-6);
}

TEST_F(RobotModelTest, RefusalsNameFileKeyAndValue) {
  const std::string unknown = refusal("max_sped: 1.0\n");
  EXPECT_NE(unknown.find("test.yaml"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("max_sped"), std::string::npos) << unknown;
  const std::string range = refusal("track: -0.3\n");
  EXPECT_NE(range.find("track = -0.3"), std::string::npos) << range;
  EXPECT_NE(refusal("max_speed: 3.0\n").find("max_wheel_speed"), std::string::npos);
  EXPECT_NE(refusal("max_wheel_speed: 1.0\nmax_yaw_rate: 8.0\n").find("max_yaw_rate needs"),
            std::string::npos);
  EXPECT_NE(refusal("lidar_min_range: 5.0\nlidar_max_range: 4.0\n").find("lidar_min_range = 5"),
            std::string::npos);
  EXPECT_NE(refusal("lidar_rate: 20.0\n").find("lidar_sweep_time"), std::string::npos);
  EXPECT_THROW(load_robot_model("config", "no_such_robot"), ParameterError);
}

TEST_F(RobotModelTest, AFootprintIsADiscARectangleOrAPolygon) {
  EXPECT_EQ(load("footprint_radius: 0.2").footprint.circumscribed_radius_m(), 0.2);
  const std::string sides = "footprint: rectangle\nfootprint_length: 0.6\nfootprint_width: 0.4\n";
  EXPECT_NEAR(load(sides).footprint.inscribed_radius_m(), 0.2, 1e-12);
  const std::string wedge = "[[0.3, 0.0], [-0.1, 0.2], [-.1, -2e-1]]";
  const RobotModel robot = load("footprint: polygon\nfootprint_corners: '" + wedge + "'\n");
  const std::vector<Vector2> corners = {{0.3, 0.0}, {-0.1, 0.2}, {-0.1, -0.2}};
  EXPECT_EQ(robot.footprint.corners(), corners);
}

TEST_F(RobotModelTest, SaysWhatIsWrongWithCorners) {
  const auto refused = [this](const std::string& corners, const std::string& why) {
    const std::string error =
        refusal("footprint: polygon\nfootprint_corners: \"" + corners + "\"\n");
    for (const std::string& part :
         {std::string("test.yaml"), "footprint_corners = " + corners, why})
      EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  refused("", "[[x, y]");
  refused("0.3", "[[x, y]");
  refused("[[0.3, 0.0], [-0.1, 0.2], [-0.1, -0.2]", "[[x, y]");
  refused("[[0.3, 0.0], [-0.1, 0.2], [-0.1, -0.2, 0.0]]", "[[x, y]");
  refused("[[0.3, 0.0], [-0.1, 0.2], [-0.1]]", "[[x, y]");
  refused("[[0.3, 0.0], [-0.1, 0.2], [-0.1, wide]]", "[[x, y]");
  refused("[0.3, 0.0, -0.1, 0.2, -0.1, -0.2]", "[[x, y]");
  refused("[[0.3, 0.0], [-0.1, 0.2]]", "at least 3 corners");
  refused("[[0.3, 0.0], [-0.1, 0.2], [-0.1, .nan]]", "not finite");
  refused("[[0.3, 0.1], [0.1, 0.2], [0.1, 0.1]]", "base_link");
  EXPECT_NE(refusal("footprint_discs: 3\n").find("gone"), std::string::npos);
}

TEST_F(RobotModelTest, ABaseReversesUnlessItsModelSaysOtherwise) {
  EXPECT_TRUE(load("max_speed: 0.5\n").limits.can_reverse);
  const RobotModel forward = load("can_reverse: false\n");
  EXPECT_FALSE(forward.limits.can_reverse);
  EXPECT_FALSE(forward.emergency_limits().can_reverse);
}

TEST_F(RobotModelTest, ABaseThatCannotTurnInPlaceIsRefusedInPlainWords) {
  EXPECT_EQ(refusal("min_turning_radius: 0.0\n"), "accepted");
  EXPECT_EQ(
      refusal("min_turning_radius: 0.45\n"),
      (directory_ / "robots/test.yaml").string() +
          ": min_turning_radius = 0.45 m: mocha_ugv plans for bases that turn in place (0 m); "
          "car-like bases are not supported");
  EXPECT_NE(refusal("min_turning_radius: -0.1\n").find("min_turning_radius = -0.1"),
            std::string::npos);
}

TEST_F(RobotModelTest, AnEmergencyIsBetweenDrivingAndWhatTheWheelsCan) {
  const std::string limits = "max_acceleration: 1.0\nmax_wheel_acceleration: 2.0\n";
  for (const char* kept : {"1.0", "1.5", "2.0"})
    EXPECT_EQ(refusal(limits + "emergency_acceleration: " + kept + "\n"), "accepted") << kept;
  for (const char* broken : {"0.9", "2.1"}) {
    const std::string error = refusal(limits + "emergency_acceleration: " + broken + "\n");
    for (const std::string part :
         {"test.yaml", "max_acceleration = 1", "max_wheel_acceleration = 2"})
      EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_NE(error.find(std::string("emergency_acceleration = ") + broken), std::string::npos)
        << error;
  }
  // Of one that is given, the other has to fit, too.
  EXPECT_NE(refusal("max_acceleration: 2.2\n").find("emergency_acceleration"), std::string::npos);
  EXPECT_NE(refusal("max_wheel_acceleration: 1.0\n").find("emergency_acceleration"),
            std::string::npos);
}

TEST_F(RobotModelTest, AnEmergencyHasMoreAccelerationAndNothingElse) {
  for (const char* name : {"rover", "jackal"}) {
    const RobotModel robot = load_robot_model("config", name);
    const MotionLimits limits = robot.emergency_limits();
    EXPECT_GT(limits.max_acceleration, robot.limits.max_acceleration) << name;
    EXPECT_EQ(limits.max_acceleration, robot.emergency_acceleration);
    EXPECT_EQ(limits.max_speed, robot.limits.max_speed);
    EXPECT_EQ(limits.max_yaw_rate, robot.limits.max_yaw_rate);
    EXPECT_EQ(limits.max_wheel_speed, robot.limits.max_wheel_speed);
    EXPECT_LT(robot.braking().deceleration(), robot.limits.max_acceleration);
    EXPECT_LT(robot.hard_braking().deceleration(), robot.emergency_acceleration);
    EXPECT_GT(robot.hard_braking().deceleration(), robot.braking().deceleration());
  }
}

}  // namespace
}  // namespace mocha
