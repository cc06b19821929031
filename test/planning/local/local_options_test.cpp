#include "planning/local/local_options.h"

#include <gtest/gtest.h>

#include <string>

#include "planning/global/planner_options.h"

namespace mocha {
namespace {

ParameterTable values_of(const std::string& node, const std::string& changes) {
  ParameterTable values = ParameterTable::from_schema("config/" + node + ".yaml");
  values.assign(YAML::Load(changes), "the test");
  return values;
}

/// One is a weight of the time that a drive takes, the other of the cube of a delay.
TEST(LocalOptions, TheWeightOfADelayIsNotThatOfTheDuration) {
  EXPECT_EQ(LocalOptions::from(values_of("local_replanner", "{weight_delay: 2.5}")).weight_delay,
            2.5);
  EXPECT_EQ(
      PlannerOptions::from(values_of("global_planner", "{weight_duration: 3.5}")).weight_duration,
      3.5);
  try {
    values_of("local_replanner", "{weight_duration: 2.5}");
    FAIL() << "the former name is taken";
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find("weight_delay"), std::string::npos) << error.what();
  }
}

/// Local paths have times; what follows the room beside a path is not for them.
TEST(LocalOptions, KnotsAreAsFarApartInTheOpen) {
  const LocalOptions options = LocalOptions::from(values_of("local_replanner", "{}"));
  EXPECT_EQ(options.open_knot_spacing_m, options.knot_spacing_m);
}

}  // namespace
}  // namespace mocha
