#include "planning/global/planner_options.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

TEST(PlannerOptions, EachValueGoesToItsPlace) {
  ParameterTable values = ParameterTable::from_schema("config/global_planner.yaml");
  values.assign(
      YAML::Load("{weight_effort: 1.5, weight_duration: 2.5, open_knot_spacing: 3.5, "
                 "preferred_clearance: 0.4, clearance_weight: 5.5, smooth_start: 0.6, "
                 "goal_search_radius: 0.7, roadmap: visibility_prm, prm_samples: 800, classes: 9, "
                 "longest_ratio: 1.1, switch_margin: 0.12, planning_threads: 13}"),
      "the test");
  const PlannerOptions options = PlannerOptions::from(values);
  EXPECT_EQ(options.weight_effort, 1.5);
  EXPECT_EQ(options.weight_duration, 2.5);
  EXPECT_EQ(options.open_knot_spacing_m, 3.5);
  EXPECT_EQ(options.preferred_clearance_m, 0.4);
  EXPECT_EQ(options.clearance_weight, 5.5);
  EXPECT_EQ(options.smooth_start_rad, 0.6);
  EXPECT_EQ(options.goal_search_radius_m, 0.7);
  EXPECT_EQ(options.roadmap, RoadmapKind::kVisibilityPrm);
  EXPECT_EQ(options.prm_samples, 800);
  EXPECT_EQ(options.classes, 9);
  EXPECT_EQ(options.longest_ratio, 1.1);
  EXPECT_EQ(options.switch_margin, 0.12);
  EXPECT_EQ(options.threads, 13);
}

}  // namespace
}  // namespace mocha
