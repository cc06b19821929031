#include "stack/timing.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "stack/commitment_keeping.h"

namespace mocha {
namespace {

/// The shipped values, with some of them replaced.
class Nodes {
 public:
  explicit Nodes(const std::string& node = "", const std::string& values = "{}")
      : node_(node), values_(YAML::Load(values)) {}

  ParameterTable operator()(const std::string& node) const {
    ParameterTable table = ParameterTable::from_schema("config/" + node + ".yaml");
    if (node == node_) table.assign(values_, "test");
    return table;
  }

 private:
  const std::string node_;
  const YAML::Node values_;
};

/// One row for each rule: values that just work, values that just do not, and what is said of
/// these.
struct Row {
  std::string node;
  std::string works;
  std::string fails;
  std::string words;
};

const std::vector<Row> kRows = {
    {"local_replanner", "{settle_time: 0.07}", "{settle_time: 0.06}",
     "local_replanner/settle_time = 0.06 s must be longer than trajectory_broadcaster/delta_dc = "
     "0.06 s: else a proposal would start before it can be binding"},
    {"global_planner", "{planning_time: 0.41}", "{planning_time: 0.4}",
     "global_planner/planning_time = 0.4 s must be longer than local_replanner/settle_time = 0.3 s "
     "+ local_replanner/period = 0.1 s"},
    {"local_replanner", "{lease: 0.11}", "{lease: 0.1}",
     "local_replanner/lease = 0.1 s must be longer than local_replanner/period = 0.1 s"},
    {"trajectory_tracker", "{max_lease: 0.5}", "{max_lease: 0.49}",
     "trajectory_tracker/max_lease = 0.49 s must be at least local_replanner/lease = 0.5 s"},
    {"trajectory_broadcaster", "{delta_dc: 0.1}", "{delta_dc: 0.11}",
     "robot/peer_reaction = 0.3 s must be at least trajectory_broadcaster/delta_dc = 0.11 s + "
     "local_replanner/period = 0.1 s + local_replanner/emergency_time = 0.1 s"},
    {"trajectory_broadcaster", "{heartbeat_rate: 1.1}", "{heartbeat_rate: 1.0}",
     "trajectory_broadcaster/reach_timeout = 1 s must be longer than a period of "
     "trajectory_broadcaster/heartbeat_rate = 1 Hz"},
    {"local_replanner", "{extend_every: 3.6}", "{extend_every: 3.7}",
     "local_replanner/horizon = 4 s must be longer than local_replanner/extend_every = 3.7 s + "
     "local_replanner/settle_time = 0.3 s"},
    {"local_replanner", "{prediction_horizon: 3.0}", "{prediction_horizon: 2.9}",
     "local_replanner/prediction_horizon = 2.9 s must be at least local_replanner/trigger_horizon "
     "= 3 s"},
    {"perception", "{map_rate: 1.1}", "{map_rate: 1.0}",
     "local_replanner/max_map_age = 1 s must be longer than a period of perception/map_rate = 1 "
     "Hz"},
    {"local_replanner", "{max_prediction_age: 0.11}", "{max_prediction_age: 0.1}",
     "local_replanner/max_prediction_age = 0.1 s must be longer than a period of robot/lidar_rate "
     "= 10 Hz"},
    {"perception", "{track_timeout: 0.11}", "{track_timeout: 0.1}",
     "perception/track_timeout = 0.1 s must be longer than a period of robot/lidar_rate = 10 Hz"},
    {"perception", "{occlusion_timeout: 0.7}", "{occlusion_timeout: 0.6}",
     "perception/occlusion_timeout = 0.6 s must be at least perception/track_timeout = 0.7 s"},
    {"perception", "{scan_timeout: 0.11}", "{scan_timeout: 0.1}",
     "perception/scan_timeout = 0.1 s must be longer than a period of robot/lidar_rate = 10 Hz"},
    {"scan_localizer", "{scan_timeout: 0.11}", "{scan_timeout: 0.1}",
     "scan_localizer/scan_timeout = 0.1 s must be longer than a period of robot/lidar_rate = 10 "
     "Hz"},
    {"base_driver", "{feedback_interval: 200, feedback_timeout: 0.21, feedback_delay: 0.0}",
     "{feedback_interval: 200, feedback_timeout: 0.2, feedback_delay: 0.0}",
     "base_driver/feedback_timeout = 0.2 s must be longer than base_driver/feedback_interval = 200 "
     "ms"},
    {"base_driver", "{feedback_interval: 200, feedback_delay: 0.04}",
     "{feedback_interval: 200, feedback_delay: 0.05}",
     "trajectory_tracker/max_pose_age = 0.25 s must be longer than base_driver/feedback_interval = "
     "200 ms + base_driver/feedback_delay = 0.05 s"},
};

/// What is said; nothing where the values work.
std::string refusal(const std::string& node, const ParameterSource& values_of) {
  try {
    check_timing(node, values_of);
    return "";
  } catch (const ParameterError& error) {
    return error.what();
  }
}

TEST(Timing, EachRuleHasARow) { EXPECT_EQ(kRows.size(), timing_rules().size()); }

TEST(Timing, CombinationsThatCannotWorkAreRefusedWithAllNames) {
  for (const Row& row : kRows) {
    SCOPED_TRACE(row.fails);
    EXPECT_EQ(refusal(row.node, Nodes(row.node, row.works)), "");
    const std::string said = refusal(row.node, Nodes(row.node, row.fails));
    EXPECT_EQ(said.substr(0, row.words.size()), row.words);
  }
}

TEST(Timing, AnyNodeThatIsInvolvedRefuses) {
  const Nodes nodes("trajectory_tracker", "{max_lease: 0.2}");
  EXPECT_NE(refusal("trajectory_tracker", nodes), "");
  EXPECT_EQ(refusal("local_replanner", nodes), refusal("trajectory_tracker", nodes));
  EXPECT_EQ(refusal("perception", nodes), "");
}

TEST(Timing, WhereStopsAreNotCheckedReactionsDoNotMatter) {
  const std::string slow = "{peer_reaction: 0.2}";
  EXPECT_NE(refusal("local_replanner", Nodes("robot", slow)), "");
  EXPECT_EQ(
      refusal("local_replanner", Nodes("robot", "{peer_reaction: 0.2, stops_checked: false}")), "");
}

TEST(Timing, WhatIsShippedWorks) {
  std::set<std::string> nodes;
  for (const TimingRule& rule : timing_rules()) {
    for (const std::string& term : rule.left) nodes.insert(term.substr(0, term.find('/')));
    for (const std::string& term : rule.right) nodes.insert(term.substr(0, term.find('/')));
  }
  for (const std::string model : {"rover", "jackal", "waveshare_rover"}) {
    const auto values_of = [&](const std::string& node) {
      ParameterTable table = ParameterTable::from_schema("config/" + node + ".yaml");
      if (node == "robot") table.assign_file("config/robots/" + model + ".yaml");
      return table;
    };
    for (const std::string& node : nodes) EXPECT_EQ(refusal(node, values_of), "") << model;
  }
}

/// What comes at a fixed rate is waited for longer than that, whatever the parameters say.
TEST(Timing, RangesKeepToFixedPeriods) {
  const auto least = [](const std::string& node, const std::string& name) {
    return ParameterTable::from_schema("config/" + node + ".yaml").parameters().at(name).min;
  };
  EXPECT_GT(least("local_replanner", "max_map_age"), kMapPeriod_s);
  EXPECT_GT(least("local_replanner", "max_fleet_age"), kFleetPeriod_s);
  EXPECT_GT(least("perception", "peer_timeout"), kFleetPeriod_s);
}

}  // namespace
}  // namespace mocha
