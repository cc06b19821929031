#include "ros_bridge/runtime/node_help.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace mocha {
namespace {

TEST(NodeHelp, NamesEachParameterWithUnitDefaultRangeAndMeaning) {
  const auto table = ParameterTable::from_schema("config/fleet_simulator.yaml");
  const std::string help = help_of("fleet_simulator", table);
  EXPECT_EQ(help.rfind("usage: rosrun mocha_ugv fleet_simulator ", 0), 0u) << help;
  for (const char* line :
       {"\n  step: 0.02 s (0.001 to 0.1)\n      Between two ticks of /clock.\n",
        "\n  world: empty\n      Path of the world file.\n",
        "\n  sensor_fault: none (none, scan_frozen, ", "odometry_slipping), live\n",
        "\n  publish_map_to_odom: true\n", "\n  seed: 1 (0 to 2147483647)\n"}) {
    EXPECT_NE(help.find(line), std::string::npos) << line;
  }
  for (const auto& [name, parameter] : table.parameters())
    EXPECT_NE(help.find("\n  " + name + ": "), std::string::npos) << name;
}

}  // namespace
}  // namespace mocha
