#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "perception/mapping/occupancy_map.h"
#include "perception/shipped_options.h"
#include "safety/certifier.h"
#include "topology/grid_world.h"
#include "trajectory/simple_motions.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

/// A robot that has seen nothing but the ground that perception frees where it stands.
class StartOnUnseenGround : public ::testing::TestWithParam<const char*> {
 protected:
  Scene scene_at(const Vector2& place) const {
    OccupancyMapOptions options = shipped_map_options();
    options.resolution_m = robot_.map_resolution_m;
    OccupancyMap map(options);
    map.mark_standing(place, standing_radius_m(robot_));
    const OccupancyGrid grid = map.slice(1.0);
    Scene scene;
    scene.obstacles = occupied_field(grid);
    scene.unseen = unseen_field(grid);
    return scene;
  }

  Violation promised(const Motion& motion, const Scene& scene) const {
    return certify(motion, robot_.footprint, scene, requirements_[RequirementName::kPromise]);
  }

  const RobotModel robot_ = load_robot_model("config", GetParam());
  const Requirements requirements_{robot_};
};

TEST_P(StartOnUnseenGround, ItMayTurnWhereItStands) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-3.0, 3.0);
  for (int i = 0; i < 100; ++i) {
    const Pose start{{anywhere(random), anywhere(random)}, anywhere(random)};
    const double duration_s = 2.0 * M_PI / robot_.limits.max_yaw_rate * 3.0;
    const Motion turn(0.0, {TurnPhase{start, 2.0 * M_PI, duration_s}});
    const Violation violation = promised(turn, scene_at(start.position));
    EXPECT_FALSE(violation) << describe(violation) << " at " << start.position.transpose();
  }
}

TEST_P(StartOnUnseenGround, ItMayNotDriveOffWhatItHasSeen) {
  const Motion drive = straight_drive(0.0, {0.0, 0.0}, 0.0, 1.0, 0.4, 0.4);
  EXPECT_EQ(promised(drive, scene_at({0.0, 0.0})).term, ViolatedTerm::kUnseenSpace);
}

INSTANTIATE_TEST_SUITE_P(Models, StartOnUnseenGround,
                         ::testing::Values("jackal", "rover", "waveshare_rover"),
                         [](const auto& model) { return std::string(model.param); });

}  // namespace
}  // namespace mocha
