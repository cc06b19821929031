#include "planning/replanner/local_replanner_options.h"

#include <gtest/gtest.h>

#include "planning/worlds.h"

namespace mocha {
namespace {

TEST(LocalReplannerOptions, APromiseIsGivenUpOnlyAfterTheTrackerHasBraked) {
  const ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  for (const RobotModel& robot : {rover(), jackal()}) {
    const double max_error_m = LocalReplannerOptions::from(values, robot).max_error_m;
    EXPECT_GT(max_error_m, robot.margins.tracking_m) << robot.name;
    EXPECT_LE(max_error_m, 2.0 * robot.margins.tracking_m) << robot.name;
  }
}

TEST(LocalReplannerOptions, EachValueGoesToItsPlace) {
  ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  values.assign(YAML::Load("{settle_time: 0.31, emergency_time: 0.12, horizon: 5.5, "
                           "extend_every: 0.7, max_heading_error: 0.9, "
                           "trigger_horizon: 2.5}"),
                "the test");
  const LocalReplannerOptions options = LocalReplannerOptions::from(values, rover());
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
