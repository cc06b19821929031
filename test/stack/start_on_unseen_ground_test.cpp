#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "perception/mapping/occupancy_map.h"
#include "perception/shipped_options.h"
#include "safety/certifier.h"
#include "topology/grid_world.h"
#include "trajectory/frame_change.h"
#include "trajectory/simple_motions.h"

namespace mocha {
namespace {

/// A robot that has seen nothing but the ground where it starts, and at most one scan.
class StartOnUnseenGround : public ::testing::TestWithParam<const char*> {
 protected:
  /// With nothing near; the lidar sees a metre.
  Scene scene_at(const Pose& place, bool sees) const {
    OccupancyMapOptions options = shipped_map_options();
    options.resolution_m = robot_.map_resolution_m;
    OccupancyMap map(options);
    map.see_robot(place, StartGround(robot_), {});
    if (sees) map.insert_scan(beams_from(place));
    const OccupancyGrid grid = map.slice(1.0);
    Scene scene;
    scene.obstacles = occupied_field(grid);
    scene.unseen = unseen_field(grid);
    return scene;
  }

  std::vector<Beam> beams_from(const Pose& base) const {
    const Pose lidar = composed(base, robot_.lidar.mount);
    std::vector<Beam> beams;
    for (double share = -0.5; share <= 0.5; share += 0.002) {
      const double angle_rad = lidar.yaw_rad + share * robot_.lidar.field_of_view_rad;
      const Vector2 end = lidar.position + Vector2(std::cos(angle_rad), std::sin(angle_rad));
      beams.push_back({{lidar.position.x(), lidar.position.y(), 0.2},
                       {end.x(), end.y(), 0.2},
                       BeamEnd::kMiss,
                       0.0});
    }
    return beams;
  }

  Violation promised(const Motion& motion, const Scene& scene) const {
    return certify(motion, robot_.footprint, scene, requirements_[RequirementName::kPromise]);
  }

  const RobotModel robot_ = load_robot_model("config", GetParam());
  const Requirements requirements_{robot_};
};

TEST_P(StartOnUnseenGround, ItMayStandUnseen) {
  const Pose start{{1.0, 2.0}, 0.4};
  EXPECT_FALSE(promised(standing(0.0, start.position, start.yaw_rad), scene_at(start, false)));
}

TEST_P(StartOnUnseenGround, ItMayTurnWhereItStandsAfterOneScan) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-3.0, 3.0);
  for (int i = 0; i < 100; ++i) {
    const Pose start{{anywhere(random), anywhere(random)}, anywhere(random)};
    const double duration_s = 2.0 * M_PI / robot_.limits.max_yaw_rate * 3.0;
    const Motion turn(0.0, {TurnPhase{start, 2.0 * M_PI, duration_s}});
    const Violation violation = promised(turn, scene_at(start, true));
    EXPECT_FALSE(violation) << describe(violation) << " at " << start.position.transpose();
  }
}

TEST_P(StartOnUnseenGround, ItMayNotDriveOffWhatItHasSeen) {
  const Motion drive = straight_drive(0.0, {0.0, 0.0}, 0.0, 1.0, 0.4, 0.4);
  EXPECT_EQ(promised(drive, scene_at({{0.0, 0.0}, 0.0}, false)).term, ViolatedTerm::kUnseenSpace);
}

INSTANTIATE_TEST_SUITE_P(Models, StartOnUnseenGround,
                         ::testing::Values("jackal", "rover", "waveshare_rover"),
                         [](const auto& model) { return std::string(model.param); });

}  // namespace
}  // namespace mocha
