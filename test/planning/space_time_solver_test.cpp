#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "benchmarks/replan_problem.h"

namespace mocha {
namespace {

/// 10 m through a corridor 3 m wide.
ReplanScene corridor() {
  ReplanScene scene;
  scene.number = 0;
  scene.start_speed = 0.0;
  scene.goal = {10.0, 0.0};
  scene.low = {-3.0, -1.7};
  scene.high = {13.0, 1.7};
  for (const double y : {-1.6, 1.6}) {
    scene.obstacles.push_back(
        Polygon{{{-3.0, y - 0.1}, {13.0, y - 0.1}, {13.0, y + 0.1}, {-3.0, y + 0.1}}});
  }
  return scene;
}

/// A row across the corridor, too close to pass through, that goes along x.
void add_row(ReplanScene& scene, double x, double speed, std::vector<MoverLeg> legs) {
  for (const double y : {-1.0, 0.0, 1.0}) {
    scene.movers.push_back({0.4, {x, y}, speed < 0.0 ? M_PI : 0.0, std::abs(speed), legs});
  }
}

TEST(SpaceTimeSolver, DrivesFreelyInTheKinematicTime) {
  const auto found_s = arrival_time_s(problem_of(corridor()), {});
  ASSERT_TRUE(found_s);
  // 1 m/s and 0.5 m/s^2 along an axis, up to the tolerance about the goal.
  const double kinematic_s = (10.0 - 0.15) / 1.0 + 1.0 / 0.5;
  EXPECT_GE(*found_s, kinematic_s - 0.01);
  EXPECT_LE(*found_s, kinematic_s + 1.0);
}

TEST(SpaceTimeSolver, IsSoonerWhenAlreadyMoving) {
  ReplanScene scene = corridor();
  const double from_rest_s = arrival_time_s(problem_of(scene), {}).value();
  scene.start_speed = 0.75;
  EXPECT_LT(arrival_time_s(problem_of(scene), {}).value(), from_rest_s - 0.4);
}

TEST(SpaceTimeSolver, DoesNotPassAWallOfMovers) {
  ReplanScene standing = corridor();
  add_row(standing, 5.0, 0.0, {});
  EXPECT_FALSE(arrival_time_s(problem_of(standing), {}));
  ReplanScene coming = corridor();
  add_row(coming, 8.0, -0.5, {});
  EXPECT_FALSE(arrival_time_s(problem_of(coming), {}));
}

TEST(SpaceTimeSolver, PassesWhereTheClearanceAllowsIt) {
  ReplanScene scene = corridor();
  scene.movers.push_back(
      {0.4, {5.0, -0.5}, 0.0, 0.0, {}});  // leaves 0.9 m to a robot along the wall
  SolverOptions options;
  options.to_movers_m = 0.75;
  EXPECT_TRUE(arrival_time_s(problem_of(scene), options));
  options.to_movers_m = 0.95;
  EXPECT_FALSE(arrival_time_s(problem_of(scene), options));
}

TEST(SpaceTimeSolver, WaitsForAGapThatOpens) {
  constexpr double kOpens_s = 15.0;
  ReplanScene scene = corridor();
  add_row(scene, 5.0, 0.0, {});
  for (SceneMover& mover : scene.movers) {  // they walk off sideways, through the wall
    mover.heading_rad = M_PI / 2.0;
    mover.legs = {{kOpens_s, 0.0, 0.0}, {2.0, 1.0, 0.0}};
  }
  const auto found_s = arrival_time_s(problem_of(scene), {});
  ASSERT_TRUE(found_s);
  EXPECT_GT(*found_s, kOpens_s + 4.0);  // half the way is still to be driven
  EXPECT_LT(*found_s, kOpens_s + 10.0);
}

/// 8 m along the diagonal, in a corridor without ends.
SpaceTimeProblem turned_corridor() {
  SpaceTimeProblem problem;
  problem.ground = {{-5.0, -5.0}, {15.0, 15.0}, {}};
  const Vector2 along = Vector2(1.0, 1.0).normalized();
  const Vector2 across(-along.y(), along.x());
  for (const double side : {-1.5, 1.5}) {
    const Vector2 middle = Vector2(2.0, 2.0) + side * across;
    problem.ground.obstacles.push_back(Polygon{{middle - 20.0 * along, middle + 20.0 * along,
                                                middle + 20.0 * along + 0.3 * side * across,
                                                middle - 20.0 * along + 0.3 * side * across}});
  }
  problem.start = {{2.0, 2.0}, 0.25 * M_PI};
  problem.start_time_s = 100.0;
  problem.goal = Vector2(2.0, 2.0) + 8.0 * along;
  return problem;
}

TEST(SpaceTimeSolver, TellsTheArrivalInTheTimeOfTheMovers) {
  const double kinematic_s = (8.0 - 0.15) / 1.0 + 1.0 / 0.5;
  const double found_s = arrival_time_s(turned_corridor(), {}).value();
  EXPECT_GE(found_s, 100.0 + kinematic_s - 0.01);
  EXPECT_LE(found_s, 100.0 + kinematic_s + 1.0);
}

TEST(SpaceTimeSolver, WaitsUntilWhatIsInTheWayHasLeft) {
  SpaceTimeProblem problem = turned_corridor();
  const Circle plug{0.5 * (problem.start.position + problem.goal), 1.2};
  problem.movers = {
      [&](double time_s) { return time_s < 115.0 ? std::optional<Circle>(plug) : std::nullopt; }};
  const double found_s = arrival_time_s(problem, {}).value();
  EXPECT_GT(found_s, 115.0 + 4.0);
  EXPECT_LT(found_s, 115.0 + 10.0);
  problem.movers = {[&](double) { return std::optional<Circle>(plug); }};
  EXPECT_FALSE(arrival_time_s(problem, {}));
}

TEST(ReplanScenes, AreFairAndMeetTheRobot) {
  std::map<std::string, int> groups;
  int meetings = 0;
  for (int number = 1; number <= ReplanScene::kScenes; ++number) {
    const ReplanScene scene = replan_scene(number);
    ++groups[scene.group];
    EXPECT_GE(scene.movers.size(), 1u) << number;
    EXPECT_LE(scene.movers.size(), 8u) << number;
    bool meets = false;
    for (const SceneMover& mover : scene.movers) {
      const double touch_m = mover.radius_m + ReplanScene::kRobotRadius_m;
      EXPECT_GE(mover.start.norm(), touch_m + 1.5) << number;
      for (double t = 0.0; undisturbed_m(scene, t) < scene.goal.x(); t += 0.05) {
        const Vector2 robot(undisturbed_m(scene, t), 0.0);
        const bool touches = (truth(mover, t).centre - robot).norm() < touch_m;
        EXPECT_FALSE(touches && t < 2.0) << number;
        meets = meets || touches;
      }
    }
    meetings += meets;
  }
  EXPECT_EQ(groups["constant_velocity"], 140);
  EXPECT_EQ(groups["accelerating"], 60);
  EXPECT_GE(meetings, 0.7 * ReplanScene::kScenes);
}

TEST(ReplanScenes, MoversGoTheirLegs) {
  const SceneMover mover{
      0.3, {1.0, 2.0}, 0.0, 1.0, {{2.0, 0.0, 0.0}, {1.0, -0.5, 0.0}, {M_PI, 0.0, 0.5}}};
  EXPECT_LT((truth(mover, 2.0).centre - Vector2(3.0, 2.0)).norm(), 1e-12);
  EXPECT_LT((truth(mover, 3.0).centre - Vector2(3.75, 2.0)).norm(), 1e-12);
  // A quarter of a circle of radius v / omega = 1 m to the left.
  EXPECT_LT((truth(mover, 3.0 + M_PI).centre - Vector2(4.75, 3.0)).norm(), 1e-12);
  EXPECT_LT((truth(mover, 5.0 + M_PI).centre - Vector2(4.75, 4.0)).norm(), 1e-12);
  for (const double t : {0.5, 2.5, 4.0, 8.0}) {
    const double h = 1e-5;
    const Vector2 slope = (truth(mover, t + h).centre - truth(mover, t - h).centre) / (2.0 * h);
    EXPECT_LT((slope - truth(mover, t).velocity).norm(), 1e-6) << t;
  }
}

}  // namespace
}  // namespace mocha
