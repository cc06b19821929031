#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planning/executive/goal_executive.h"
#include "planning/worlds.h"
#include "trajectory/rover_braking.h"

namespace mocha {

constexpr double kPeriod_s = 0.05;
constexpr double kBraking = 0.5;  // [m/s^2]
constexpr double kLength_m = 6.0;
constexpr double kHandover_s = 0.4;

inline GoalExecutiveOptions options() {
  return GoalExecutiveOptions::from(ParameterTable::from_schema("config/global_planner.yaml"),
                                    kHandover_s);
}

/// A robot that stands, or is where its plan says, and a planner that finds what it is told to.
class ExecutiveFixture : public ::testing::Test {
 protected:
  /// It came from two metres behind.
  ExecutiveFixture() {
    for (const double x : {-2.0, -1.7, -1.4, -1.1, -0.8, -0.5, -0.2, 0.0}) {
      state_.pose.position = {x, 0.0};
      executive_.step(now_s_, state_, committed_, {});
    }
    executive_.take({Goal{{kLength_m, 0.0}, std::nullopt}}, committed_, now_s_);
  }

  PlanResult answer(const PlanQuery& query) {
    PlanResult result;
    result.reason = reason_;
    result.goal = goal_.value_or(query.goal);
    const Pose from = query.committed.at(query.start_time_s).pose;
    if (reason_ == PlanReason::kSolved) {
      const Vector2 along = result.goal - from.position;
      result.motion =
          straight_drive(query.start_time_s, from.position, std::atan2(along.y(), along.x()),
                         along.norm(), speed_, kBraking);
    }
    return result;
  }

  GoalExecutive::Output step() {
    now_s_ += kPeriod_s;
    state_.stamp_s = now_s_;
    return executive_.step(now_s_, state_, committed_,
                           {[this](const PlanQuery& query) {
                              asked_.push_back(query);
                              query_ = query;
                            },
                            [this] { return late_ ? std::nullopt : std::optional(answer(query_)); },
                            [this](const std::vector<Vector2>&) { return scene_; }});
  }

  /// The last step of so many that said anything; the number of plans asked for is in asked_.
  GoalExecutive::Output run(double time_s) {
    GoalExecutive::Output last;
    asked_.clear();
    said_.clear();
    for (const double end_s = now_s_ + time_s; now_s_ < end_s - 1e-6;) {
      GoalExecutive::Output output = step();
      if (output.request) said_.push_back(*output.request);
      if (output.planned || output.ending != GoalExecutive::Ending::kNone) last = std::move(output);
    }
    return last;
  }

  double now_s_ = 1.7e9;
  GoalExecutive executive_{options(), rover(),
                           Yielding({false, 0, "ugv5"}, rover(), default_options())};
  PlanningScene scene_{static_map_of(free_grid({-5.0, -5.0}, {12.0, 5.0})), {}};
  RobotState state_;
  Motion committed_ = standing(now_s_, {0.0, 0.0}, 0.0);
  PlanReason reason_ = PlanReason::kSolved;
  std::optional<Vector2> goal_;  // where the plan leads instead
  double speed_ = 0.8;
  bool late_ = false;  // plans are under way, and stay so
  PlanQuery query_;    // asked last
  std::vector<PlanQuery> asked_;
  std::vector<YieldRequest> said_;

  void stand_ahead(const std::string& name) {
    scene_.peers = {std::make_shared<PeerObstacle>(
        name, std::make_shared<const Motion>(standing(now_s_ - 5.0, {1.0, 0.0}, 0.0)), 0.3,
        test::kRoverBraking)};
  }

  /// A team-mate asks for a way, now and for the time of a run of `time_s`.
  GoalExecutive::Output run_while_asked(const YieldRequest& request, double time_s) {
    GoalExecutive::Output last;
    std::vector<PlanQuery> asked;
    std::vector<YieldRequest> said;
    for (const double end_s = now_s_ + time_s; now_s_ < end_s - 1e-6;) {
      executive_.hear(request, now_s_);
      GoalExecutive::Output output = run(0.5);
      if (output.planned || output.ending != GoalExecutive::Ending::kNone) last = std::move(output);
      asked.insert(asked.end(), asked_.begin(), asked_.end());
      said.insert(said.end(), said_.begin(), said_.end());
    }
    asked_ = asked;
    said_ = said;
    return last;
  }

  static YieldRequest way_of(const std::string& agent, std::vector<Vector2> path) {
    return {agent, 1, {false, 0, agent}, 0.3, 1.0, std::move(path)};
  }
};

}  // namespace mocha
