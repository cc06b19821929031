#include "stack/timing.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace mocha {
namespace {

constexpr double kRounding_s = 1e-9;

std::string node_of(const std::string& term) { return term.substr(0, term.find('/')); }

/// Reads each node's values once.
class Values {
 public:
  explicit Values(const ParameterSource& source) : source_(source) {}

  const Parameter& of(const std::string& term) {
    const std::string node = node_of(term);
    if (tables_.count(node) == 0) tables_.emplace(node, source_(node));
    return tables_.at(node).parameters().at(term.substr(node.size() + 1));
  }

 private:
  const ParameterSource& source_;
  std::map<std::string, ParameterTable> tables_;
};

double value_of(const Parameter& parameter) {
  const int* integer = std::get_if<int>(&parameter.value);
  return integer ? *integer : std::get<double>(parameter.value);
}

double seconds(const Parameter& parameter) {
  const double value = value_of(parameter);
  if (parameter.unit == "Hz") return 1.0 / value;
  return parameter.unit == "ms" ? 1e-3 * value : value;
}

double sum_s(const std::vector<std::string>& terms, Values& values) {
  double sum_s = 0.0;
  for (const std::string& term : terms) sum_s += seconds(values.of(term));
  return sum_s;
}

std::string in_words(const std::vector<std::string>& terms, Values& values) {
  std::ostringstream words;
  for (const std::string& term : terms) {
    const Parameter& parameter = values.of(term);
    words << (&term == &terms.front() ? "" : " + ")
          << (parameter.unit == "Hz" ? "a period of " : "") << term << " = " << value_of(parameter)
          << " " << parameter.unit;
  }
  return words.str();
}

bool involves(const TimingRule& rule, const std::string& node) {
  const auto is_its = [&](const std::string& term) { return node_of(term) == node; };
  return std::any_of(rule.left.begin(), rule.left.end(), is_its) ||
         std::any_of(rule.right.begin(), rule.right.end(), is_its);
}

bool holds(const TimingRule& rule, Values& values) {
  if (!rule.where.empty() && !std::get<bool>(values.of(rule.where).value)) return true;
  const double room_s = sum_s(rule.left, values) - sum_s(rule.right, values);
  return rule.relation == TimingRule::Relation::kAtLeast ? room_s > -kRounding_s
                                                         : room_s > kRounding_s;
}

}  // namespace

const std::vector<TimingRule>& timing_rules() {
  constexpr auto kLonger = TimingRule::Relation::kLongerThan;
  constexpr auto kAtLeast = TimingRule::Relation::kAtLeast;
  static const std::vector<TimingRule> rules = {
      {{"local_replanner/settle_time"},
       kLonger,
       {"trajectory_broadcaster/delta_dc"},
       "a proposal would start before it can be binding"},
      {{"global_planner/planning_time"},
       kLonger,
       {"local_replanner/settle_time", "local_replanner/period"},
       "a plan would start before it can be promised"},
      {{"local_replanner/lease"},
       kLonger,
       {"local_replanner/period"},
       "the lease would end between two steps"},
      {{"trajectory_tracker/max_lease"},
       kAtLeast,
       {"local_replanner/lease"},
       "the tracker would refuse each lease"},
      {{"robot/peer_reaction"},
       kAtLeast,
       {"trajectory_broadcaster/delta_dc", "local_replanner/period",
        "local_replanner/emergency_time"},
       "the robot would brake later than its peers count on",
       "robot/stops_checked"},
      {{"trajectory_broadcaster/reach_timeout"},
       kLonger,
       {"trajectory_broadcaster/heartbeat_rate"},
       "peers would be out of reach between two heartbeats"},
      {{"local_replanner/horizon"},
       kLonger,
       {"local_replanner/extend_every", "local_replanner/settle_time"},
       "the robot would brake before its promise is extended"},
      {{"local_replanner/prediction_horizon"},
       kAtLeast,
       {"local_replanner/trigger_horizon"},
       "the plan would be held against predictions that are not believed"},
      {{"local_replanner/max_map_age"},
       kLonger,
       {"perception/map_rate"},
       "the robot would brake between two maps"},
      {{"local_replanner/max_prediction_age"},
       kLonger,
       {"robot/lidar_rate"},
       "the robot would brake between two scans"},
      {{"perception/track_timeout"},
       kLonger,
       {"robot/lidar_rate"},
       "moving things would be forgotten between two scans"},
      {{"perception/occlusion_timeout"},
       kAtLeast,
       {"perception/track_timeout"},
       "hidden things would be forgotten sooner than those in sight"},
      {{"perception/scan_timeout"}, kLonger, {"robot/lidar_rate"}, "each scan would be late"},
      {{"scan_localizer/scan_timeout"}, kLonger, {"robot/lidar_rate"}, "each scan would be late"},
      {{"base_driver/feedback_timeout"},
       kLonger,
       {"base_driver/feedback_interval"},
       "the base would be stopped between two lines of feedback"},
      {{"trajectory_tracker/max_pose_age"},
       kLonger,
       {"base_driver/feedback_interval", "base_driver/feedback_delay"},
       "the robot would be stopped between two lines of feedback"},
  };
  return rules;
}

void check_timing(const std::string& node, const ParameterSource& values_of) {
  Values values(values_of);
  for (const TimingRule& rule : timing_rules()) {
    if (!involves(rule, node) || holds(rule, values)) continue;
    const bool at_least = rule.relation == TimingRule::Relation::kAtLeast;
    throw ParameterError(in_words(rule.left, values) + " must be " +
                         (at_least ? "at least " : "longer than ") + in_words(rule.right, values) +
                         ": else " + rule.why);
  }
}

}  // namespace mocha
