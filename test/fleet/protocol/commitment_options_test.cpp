#include "fleet/protocol/commitment_options.h"

#include <gtest/gtest.h>

#include "fleet/protocol/shipped_options.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

TEST(CommitmentOptions, TakeClearancesFromTheRobotAndTimesFromTheTable) {
  RobotModel robot = load_robot_model("config", "rover");
  ParameterTable values = ParameterTable::from_schema("config/trajectory_broadcaster.yaml");
  YAML::Node changes;
  changes["delta_dc"] = 0.12;
  changes["heartbeat_rate"] = 20.0;
  changes["priority"] = 3;
  values.assign(changes, "test");
  const auto options = CommitmentOptions::from(values, robot, {30.0, 2.0, 6.0}, "ugv7", 4);
  EXPECT_EQ(options.agent, "ugv7");
  EXPECT_EQ(options.epoch, 4u);
  EXPECT_EQ(options.priority, 3);
  EXPECT_EQ(options.delta_dc_s, 0.12);
  EXPECT_EQ(options.heartbeat_period_s, 0.05);
  const double margin_m = MarginBudget::of(robot).peer_margin_m();
  EXPECT_EQ(options.stop_clearance_m, margin_m);
  EXPECT_EQ(options.peer_clearance_m, robot.peer_clearance_m + margin_m);
  EXPECT_EQ(options.clocks.tolerance_s, 2.0 * robot.margins.clock_s);
  EXPECT_EQ(options.stop_reaction_s, robot.peer_reaction_s);
  robot.stops_checked = false;
  EXPECT_FALSE(CommitmentOptions::from(values, robot, {30.0, 2.0, 6.0}, "ugv7", 4).stop_reaction_s);
}

TEST(CommitmentOptions, NameWhatIsOutOfRange) {
  CommitmentOptions options = test::shipped_options("m");
  EXPECT_NO_THROW(options.validate());
  options.resend_period_s = 0.0;
  try {
    options.validate();
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("resend period = 0"), std::string::npos);
  }
}

}  // namespace
}  // namespace mocha
