#include "planning/candidates/drive_options.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

/// Each of the same name in either node's parameters, which have values of their own.
TEST(DriveOptions, EachValueGoesToItsPlace) {
  for (const std::string node : {"global_planner", "local_replanner"}) {
    ParameterTable values = ParameterTable::from_schema("config/" + node + ".yaml");
    values.assign(YAML::Load("{weight_effort: 1.5, weight_obstacle: 2.5, weight_dynamics: 3.5, "
                             "weight_turning: 4.5, weight_moving: 5.5, samples_per_piece: 6, "
                             "knot_spacing: 0.7, knot_travel: 0.8, soft_margin: 0.9, "
                             "moving_soft_margin: 1.1, max_evaluations: 12}"),
                  "the test");
    const DriveOptions options = DriveOptions::from(values);
    EXPECT_EQ(options.weight_effort, 1.5) << node;
    EXPECT_EQ(options.weight_obstacle, 2.5) << node;
    EXPECT_EQ(options.weight_dynamics, 3.5) << node;
    EXPECT_EQ(options.weight_turning, 4.5) << node;
    EXPECT_EQ(options.weight_moving, 5.5) << node;
    EXPECT_EQ(options.samples_per_piece, 6) << node;
    EXPECT_EQ(options.knot_spacing_m, 0.7) << node;
    EXPECT_EQ(options.knot_travel_m, 0.8) << node;
    EXPECT_EQ(options.soft_margin_m, 0.9) << node;
    EXPECT_EQ(options.moving_soft_margin_m, 1.1) << node;
    EXPECT_EQ(options.max_evaluations, 12) << node;
  }
}

}  // namespace
}  // namespace mocha
