#include "fleet/model/scenarios.h"

#include <utility>

namespace mocha::test {
namespace {

constexpr int kStart = 12;  // the step in which scripted motions start

ModelledRobot along_x() { return {{-2.0, 0.0}, {{0, 1, kStart, {{2.0, 0.0}}}}}; }
ModelledRobot along_y() { return {{0.0, -2.0}, {{0, 2, kStart, {{0.0, 2.0}}}}}; }

Scenario scenario(const std::string& name, std::vector<ModelledRobot> robots, const Harm& harm) {
  Scenario scenario;
  scenario.name = name;
  scenario.robots = std::move(robots);
  scenario.harm = harm;
  scenario.steps = kStart;
  return scenario;
}

}  // namespace

Scenario two_cross(const Harm& harm) { return scenario("two cross", {along_x(), along_y()}, harm); }

Scenario three_cross(const Harm& harm) {
  const ModelledRobot diagonal = {{2.0, 2.0}, {{0, 1, kStart, {{-2.0, -2.0}}}}};
  Scenario three = scenario("three cross", {along_x(), along_y(), diagonal}, harm);
  for (ModelledRobot& robot : three.robots) robot.script[0].until_step = 0;
  return three;
}

Scenario one_restarts(const Harm& harm) {
  Scenario restarts = scenario("one restarts", {along_x(), along_y()}, harm);
  restarts.robots[0].may_restart = true;
  restarts.robots[0].script[0].until_step = 0;
  restarts.robots[1].script = {{1, 8, 20, {{0.0, 2.0}}}};
  restarts.steps = 20;
  return restarts;
}

Scenario one_brakes(const Harm& harm) {
  Scenario brakes = two_cross(harm);
  brakes.name = "one brakes";
  brakes.robots[0].may_brake = true;
  return brakes;
}

Scenario clocks_differ(const Harm& harm, double ahead_s) {
  Scenario differ = two_cross(harm);
  differ.name = "clocks " + std::to_string(ahead_s) + " s apart";
  differ.robots[1].clock_ahead_s = ahead_s;
  return differ;
}

}  // namespace mocha::test
