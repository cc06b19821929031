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
      said_.insert(said_.end(), output.messages.begin(), output.messages.end());
      if (output.planned || output.ending != GoalExecutive::Ending::kNone) last = std::move(output);
    }
    return last;
  }

  double now_s_ = 1.7e9;
  GoalExecutive executive_{options(), rover(),
                           PassingPolicy("ugv5", 0, rover(), default_options())};
  PlanningScene scene_{static_map_of(free_grid({-5.0, -5.0}, {12.0, 5.0})), {}};
  RobotState state_;
  Motion committed_ = standing(now_s_, {0.0, 0.0}, 0.0);
  PlanReason reason_ = PlanReason::kSolved;
  std::optional<Vector2> goal_;  // where the plan leads instead
  double speed_ = 0.8;
  bool late_ = false;  // plans are under way, and stay so
  PlanQuery query_;    // asked last
  std::vector<PlanQuery> asked_;
  std::vector<PassingMessage> said_;

  void stand_ahead(const std::string& name) {
    scene_.peers = {std::make_shared<PeerObstacle>(
        name, std::make_shared<const Motion>(standing(now_s_ - 5.0, {1.0, 0.0}, 0.0)), 0.3,
        test::kRoverBraking)};
  }

  /// What ugv2 orders: straight moves from place to place, each after so many of its own.
  static PassingInstruction ordered(const std::vector<Vector2>& places,
                                    const std::vector<std::uint32_t>& after = {}) {
    PassingInstruction instruction{{"ugv2", 1, 1}, "ugv5", {"ugv2", "ugv5"}, 0, 0, 0, {}};
    for (std::size_t i = 1; i < places.size(); ++i) {
      PassingTurn turn{{places[i - 1], places[i]}, {}};
      if (i <= after.size() && after[i - 1] > 0) turn.after = {{0, after[i - 1]}};
      instruction.part.push_back(turn);
    }
    instruction.turns = static_cast<std::uint32_t>(instruction.part.size());
    instruction.alone_from = instruction.turns;
    return instruction;
  }

  /// What ugv2 says, that keeps to its order.
  void hear_promised(std::uint32_t moves) {
    executive_.hear(PassingIntent{"ugv2", 1, 0, false, 0.3, std::nullopt, {"ugv2", 1, 1}, moves},
                    now_s_);
  }

  void stand_at(const Vector2& place) {
    state_.pose.position = place;
    committed_ = standing(now_s_, place, 0.0);
  }
};

}  // namespace mocha
