#include "planning/replanner/local_replanner_options.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

TEST(LocalReplannerOptions, APromiseIsGivenUpOnlyAfterTheTrackerHasBraked) {
  const ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  for (const RobotModel& robot : {rover(), jackal()}) {
    const auto options = LocalReplannerOptions::from(values, robot, 12.5);
    const SpeedMargin tracking = MarginBudget::of(robot).tracking();
    for (const double speed : {0.0, 0.3, robot.limits.max_speed}) {
      EXPECT_GT(options.max_error.at(speed), tracking.at(speed)) << robot.name;
      EXPECT_LE(options.max_error.at(speed), 2.0 * tracking.at(speed)) << robot.name;
    }
    EXPECT_EQ(options.max_standing_error_m, options.max_error.at(robot.limits.max_speed));
  }
}

TEST(LocalReplannerOptions, EachValueGoesToItsPlace) {
  ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  values.assign(YAML::Load("{settle_time: 0.31, emergency_time: 0.12, horizon: 5.5, "
                           "extend_every: 0.7, max_heading_error: 0.9, "
                           "trigger_horizon: 2.5}"),
                "the test");
  const LocalReplannerOptions options = LocalReplannerOptions::from(values, rover(), 12.5);
  EXPECT_EQ(options.settle_s, 0.31);
  EXPECT_EQ(options.emergency_s, 0.12);
  EXPECT_EQ(options.horizon_s, 5.5);
  EXPECT_EQ(options.extend_every_s, 0.7);
  EXPECT_GT(options.answer_timeout_s, options.settle_s) << "the answer comes by then";
  EXPECT_EQ(options.max_error_rad, 0.9);
  EXPECT_EQ(options.mu_pre_s, 2.5);
}

}  // namespace
}  // namespace mocha
