#include "world/margin_budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace mocha {
namespace {

TEST(MarginBudget, AddsUpEveryContributionOnce) {
  const MarginBudget budget{0.05, 0.02, 0.015, 0.01, 2.0};
  EXPECT_NEAR(budget.static_margin_m(), 0.085, 1e-12);
  EXPECT_NEAR(budget.peer_margin_m(), 0.14 + 0.01 * 4.0, 1e-12);
  const MarginBudget peer{0.1, 0.03, 0.5, 0.02, 1.0};
  EXPECT_NEAR(budget.peer_margin_m(peer), 0.07 + 0.13 + 0.02 * 3.0, 1e-12);
  EXPECT_NEAR(budget.peer_margin_m(peer), peer.peer_margin_m(budget), 1e-12);
}

TEST(MarginBudget, TheStaticMarginGrowsWithTheSquareOfTheSpeed) {
  const MarginBudget budget{0.05, 0.02, 0.015, 0.01, 2.0, 0.01, 0.005};
  EXPECT_NEAR(budget.static_margin().at(0.0), 0.035, 1e-12);
  EXPECT_NEAR(budget.static_margin().at(2.0), budget.static_margin_m(), 1e-12);
  EXPECT_NEAR(budget.without_map().at(0.0), 0.03, 1e-12);
  EXPECT_NEAR(budget.without_map().at(2.0), 0.07, 1e-12);
  EXPECT_NEAR(budget.tracking().at(0.0), 0.01, 1e-12);
  EXPECT_NEAR(budget.tracking().at(1.0), 0.02, 1e-12);
  EXPECT_NEAR(budget.own_margin_m(), 0.07, 1e-12);
}

TEST(MarginBudget, ListsItselfForDiagnostics) {
  const MarginBudget budget{0.05, 0.02, 0.015, 0.01, 2.0, 0.01, 0.005};
  const auto listed = budget.listed();
  const std::map<std::string, double> values(listed.begin(), listed.end());
  EXPECT_EQ(values.size(), 10u);
  EXPECT_EQ(values.at("tracking_m"), 0.05);
  EXPECT_EQ(values.at("clock_s"), 0.01);
  EXPECT_EQ(values.at("static_margin_m"), budget.static_margin_m());
  EXPECT_EQ(values.at("static_margin_still_m"), budget.static_margin().still_m);
  EXPECT_EQ(values.at("peer_margin_m"), budget.peer_margin_m());
}

TEST(MarginBudget, RefusesNegativeAndNotFiniteNamingTheContribution) {
  EXPECT_NO_THROW(MarginBudget{}.validate());
  const auto refused = [](const MarginBudget& budget, const std::string& name) {
    try {
      budget.validate();
      ADD_FAILURE() << name << " was accepted";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  refused({-0.01, 0, 0, 0, 0}, "tracking_m = -0.01");
  refused({0, std::nan(""), 0, 0, 0}, "localisation_m");
  refused({0, 0, INFINITY, 0, 0}, "map_m");
  refused({0, 0, 0, -1, 0}, "clock_s");
  refused({0, 0, 0, 0, -2}, "max_speed_mps");
  refused({0, 0, 0, 0, 0, -0.02}, "tracking_still_m");
  refused({0, 0, 0, 0, 0, 0, NAN}, "map_still_m");
}

TEST(MarginBudget, ComesFromTheRobotModel) {
  const RobotModel robot = load_robot_model("config", "jackal");
  const MarginBudget budget = MarginBudget::of(robot);
  EXPECT_EQ(budget.max_speed, robot.limits.max_speed);
  EXPECT_EQ(budget.static_margin_m(),
            robot.margins.tracking_m + robot.margins.localisation_m + robot.margins.map_m);
  EXPECT_EQ(
      budget.static_margin().still_m,
      robot.margins.tracking_still_m + robot.margins.localisation_m + robot.margins.map_still_m);
  EXPECT_EQ(budget.clock_s, robot.margins.clock_s);
  EXPECT_NO_THROW(budget.validate());
}

}  // namespace
}  // namespace mocha
