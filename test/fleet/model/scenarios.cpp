#include "fleet/model/scenarios.h"

#include <utility>

namespace mocha::test {
namespace {

constexpr int kStart = 12;  // the step in which motions start
constexpr int kLate = 20;   // the same, where there is to be time before

ModelledRobot along_x(int until_step, int start_step) {
  return {{-2.0, 0.0}, {{0, until_step, start_step, {{2.0, 0.0}}}}};
}
ModelledRobot along_y(int from_step, int until_step, int start_step) {
  return {{0.0, -2.0}, {{from_step, until_step, start_step, {{0.0, 2.0}}}}};
}

Scenario scenario(std::string name, std::vector<ModelledRobot> robots, int steps,
                  const Harm& harm) {
  Scenario scenario;
  scenario.name = std::move(name);
  scenario.robots = std::move(robots);
  scenario.harm = harm;
  scenario.steps = steps;
  return scenario;
}

Harm harm(int losses, int delays, int duplicates) {
  Harm harm;
  harm.losses = losses;
  harm.delays = delays;
  harm.duplicates = duplicates;
  return harm;
}
Harm with_restarts(Harm harm, int restarts) {
  harm.restarts = restarts;
  return harm;
}
Harm with_cuts(Harm harm, int cuts) {
  harm.cuts = cuts;
  return harm;
}
Harm with_brakes(Harm harm, int brakes) {
  harm.brakes = brakes;
  return harm;
}

}  // namespace

Scenario two_cross(const Harm& harm) {
  return scenario("two cross", {along_x(1, kStart), along_y(0, 2, kStart)}, kStart, harm);
}

Scenario three_cross(const Harm& harm) {
  const ModelledRobot diagonal = {{2.0, 2.0}, {{0, 0, kStart, {{-2.0, -2.0}}}}};
  return scenario("three cross", {along_x(0, kStart), along_y(0, 0, kStart), diagonal}, kStart,
                  harm);
}

Scenario out_of_reach(const Harm& harm) {
  return scenario("out of reach", {along_x(2, kLate), along_y(2, 8, kLate)}, kLate, harm);
}

Scenario one_changes_its_mind(const Harm& harm) {
  constexpr int kPastTheCrossing = kStart + 40;
  ModelledRobot first = along_x(0, kStart);
  first.script.push_back({1, 4, kPastTheCrossing, {{2.0, 2.0}}});
  return scenario("one changes its mind", {first, along_y(0, 9, kLate)}, kLate, harm);
}

Scenario one_restarts(const Harm& harm) {
  ModelledRobot first = along_x(0, kStart);
  first.script.push_back({14, 14, kLate + 4, {{0.0, 0.0}, {2.0, 2.0}}});
  first.may_restart = true;
  return scenario("one restarts", {first, along_y(1, 8, kLate)}, kLate, harm);
}

Scenario both_restart(const Harm& harm) {
  Scenario restart =
      scenario("both restart", {along_x(1, kStart), along_y(2, 8, kLate)}, kLate, harm);
  for (ModelledRobot& robot : restart.robots) robot.may_restart = true;
  return restart;
}

Scenario one_brakes(const Harm& harm) {
  Scenario brakes = two_cross(harm);
  brakes.name = "one brakes";
  brakes.robots[0].may_brake = true;
  return brakes;
}

Scenario clocks_differ(const Harm& harm, double ahead_s) {
  Scenario differ = two_cross(harm);
  differ.name = "clocks differ by " + std::to_string(ahead_s) + " s";
  differ.robots[1].clock_ahead_s = ahead_s;
  return differ;
}

Scenario one_comes_near(const Harm& harm) {
  constexpr int kThere = 20;
  constexpr int kOnward = 26;
  constexpr double kSpeed = 2.0;
  const ModelledRobot comes = {
      {-4.4, 0.0},
      {{0, 1, 4, {{-2.4, 0.0}}, kSpeed}, {kThere, kThere + 2, kOnward, {{-0.4, 0.0}}, kSpeed}}};
  const ModelledRobot goes_there = {{2.0, 0.0}, {{16, 22, kOnward, {{0.2, 0.0}}, kSpeed}}};
  Scenario near = scenario("one comes near", {comes, goes_there}, kOnward, harm);
  near.reach = {100.0, 2.0 * kSpeed, 2.1};
  return near;
}

std::vector<Scenario> short_scenarios() {
  return {two_cross(harm(1, 2, 1)),
          three_cross(harm(1, 1, 0)),
          out_of_reach(with_cuts(harm(1, 1, 0), 1)),
          one_changes_its_mind(with_cuts(harm(1, 0, 0), 1)),
          one_restarts(with_cuts(with_restarts(harm(0, 0, 0), 1), 1)),
          one_restarts(with_restarts(harm(0, 1, 0), 1)),
          both_restart(with_restarts(harm(0, 0, 0), 2)),
          one_brakes(with_brakes(harm(1, 1, 1), 1)),
          clocks_differ(harm(1, 1, 0), kStep_s),
          clocks_differ(harm(1, 1, 0), -3.0),
          one_comes_near(with_cuts(harm(1, 0, 0), 1))};
}

std::vector<Scenario> long_scenarios() {
  return {two_cross(harm(3, 2, 1)),
          three_cross(harm(1, 2, 1)),
          out_of_reach(with_cuts(harm(1, 1, 1), 2)),
          one_changes_its_mind(with_cuts(harm(1, 1, 1), 1)),
          one_restarts(with_cuts(with_restarts(harm(1, 1, 0), 1), 1)),
          one_restarts(with_restarts(harm(2, 1, 1), 1)),
          both_restart(with_cuts(with_restarts(harm(1, 0, 0), 2), 1)),
          one_brakes(with_brakes(harm(2, 2, 1), 1)),
          clocks_differ(harm(2, 2, 1), kStep_s),
          clocks_differ(harm(2, 2, 1), -3.0),
          one_comes_near(with_cuts(harm(2, 1, 1), 2))};
}

}  // namespace mocha::test
