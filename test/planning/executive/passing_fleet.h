#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "planning/candidates/peer_discs.h"
#include "planning/candidates/start_maneuver.h"
#include "planning/executive/passing_policy.h"
#include "planning/global/front_end.h"
#include "planning/passing/few_places.h"
#include "planning/worlds.h"
#include "topology/paths/grid_path.h"
#include "trajectory/rover_braking.h"

namespace mocha {

/// A corridor for one along x, from -5 to 5 m, with a siding above it from -1 to 1 m.
inline std::shared_ptr<const StaticMap> corridor_with_siding() {
  OccupancyGrid grid = free_grid({-5.2, -0.8}, {5.2, 2.2});
  fill_box(grid, {-5.2, -0.8}, {5.2, -0.6});
  fill_box(grid, {-5.2, 0.6}, {-1.0, 2.2});
  fill_box(grid, {1.0, 0.6}, {5.2, 2.2});
  fill_box(grid, {-5.2, 2.0}, {5.2, 2.2});
  fill_box(grid, {-5.2, -0.8}, {-5.0, 2.2});
  fill_box(grid, {5.0, -0.8}, {5.2, 2.2});
  return static_map_of(grid);
}

/// From rest to rest along straight lines, with turns in place between.
inline Motion drive_along(const std::vector<Vector2>& path, double start_s, double yaw_rad,
                          double speed) {
  std::vector<Phase> phases;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 step = path[i] - path[i - 1];
    if (step.norm() < 1e-3) continue;
    const double to_rad = std::atan2(step.y(), step.x());
    if (const auto turn = turn_in_place({path[i - 1], yaw_rad}, to_rad, rover().limits))
      phases.emplace_back(*turn);
    const Motion leg = straight_drive(0.0, path[i - 1], to_rad, step.norm(), speed, 0.5);
    phases.insert(phases.end(), leg.phases().begin(), leg.phases().end());
    yaw_rad = to_rad;
  }
  if (phases.empty()) return standing(start_s, path.front(), yaw_rad);
  return Motion(start_s, std::move(phases));
}

/// Robots that stand until an order lets them drive, and tell each other what their policies say.
/// Those that an order is over for drive on to their goals, where others leave a way.
class PassingFleet : public ::testing::Test {
 protected:
  struct Robot {
    std::string name;
    std::unique_ptr<PassingPolicy> policy;
    Motion committed;
    std::optional<Vector2> goal;
    bool takes_part = true;
    bool drives = true;  ///< what its order lets it
    bool keeps = false;  ///< says that it keeps to an order, or is through
    std::vector<PassingMessage> said;
    std::shared_ptr<const StaticMap> own_map = nullptr;  ///< null: it knows what all know

    Vector2 place(double now_s) const { return committed.at(now_s).pose.position; }
    bool is_there(double now_s) const { return goal && (place(now_s) - *goal).norm() < 0.15; }
  };

  Robot& add(const std::string& name, const Vector2& place, std::optional<Vector2> goal = {},
             int priority = 0) {
    robots_.push_back({name,
                       std::make_unique<PassingPolicy>(name, priority, rover(), default_options()),
                       standing(now_s_ - 5.0, place, 0.0),
                       goal,
                       true,
                       true,
                       false,
                       {},
                       nullptr});
    return robots_.back();
  }

  PlanningScene scene_of(const Robot& self) const {
    PlanningScene scene{self.own_map ? self.own_map : static_map_, {}};
    for (const Robot& robot : robots_) {
      if (robot.name == self.name) continue;
      scene.peers.push_back(std::make_shared<PeerObstacle>(
          robot.name, std::make_shared<const Motion>(robot.committed), 0.3, test::kRoverBraking));
    }
    return scene;
  }

  /// Returns what it says.
  std::vector<PassingMessage> step(Robot& robot) {
    if (!robot.takes_part) {
      robot.policy->stay_out();
      return {};
    }
    const MotionState state = robot.committed.at(now_s_);
    RobotState measured;
    measured.stamp_s = now_s_;
    measured.pose = state.pose;
    measured.twist = {state.at_rest ? 0.0 : std::max(state.speed, 0.2), 0.0};
    const auto messages =
        robot.policy->step({now_s_, measured, robot.committed, robot.goal},
                           [&](const std::vector<Vector2>&) { return scene_of(robot); });
    robot.said.insert(robot.said.end(), messages.begin(), messages.end());
    for (const PassingMessage& message : messages) {
      if (const auto* intent = std::get_if<PassingIntent>(&message))
        robot.keeps = intent->follows.number > 0;
    }
    if (!robot.drives || !state.at_rest) return messages;
    if (const auto& stretch = robot.policy->stretch()) {
      drive(robot, stretch->path);
    } else if (robot.keeps && !robot.policy->follows() && robot.goal) {
      drive(robot, way(robot));
    }
    return messages;
  }

  /// Unless it is to be there already.
  void drive(Robot& robot, const std::vector<Vector2>& path) const {
    const Pose end = robot.committed.end_pose();
    if (!path.empty() && (path.back() - end.position).norm() > 1e-3)
      robot.committed = drive_along(path, now_s_ + 0.3, end.yaw_rad, speed_);
  }

  /// To its goal, where others leave one; else empty.
  std::vector<Vector2> way(const Robot& robot) const {
    const Vector2 from = robot.committed.end_pose().position;
    std::vector<BlockedDisc> blocked;
    for (const auto& peer : scene_of(robot).peers)
      blocked.push_back(peer_keep_out(*peer, peer->rest_time(), rover(), 0.0));
    const TravelCost cost(*static_map_, from, std::move(blocked),
                          homotopy_path_options(rover(), default_options()).travel);
    const auto path = find_grid_path(*static_map_, from, *robot.goal, cost, kLatticeStep_m).points;
    return path.empty() ? path : few_places(path, 8);
  }

  /// All step, and hear what the others say a moment later.
  void step() {
    now_s_ += kStep_s;
    std::vector<std::pair<std::string, PassingMessage>> messages;
    for (Robot& robot : robots_) {
      for (PassingMessage& message : step(robot)) messages.emplace_back(robot.name, message);
    }
    for (const auto& [from, message] : messages) {
      for (Robot& robot : robots_) {
        if (robot.name == from || lost_(random_) < loss_) continue;
        robot.policy->hear(message, now_s_);
      }
    }
  }

  void run(double time_s) {
    for (Robot& robot : robots_) robot.said.clear();
    for (const double end_s = now_s_ + time_s - 1e-6; now_s_ < end_s;) step();
  }

  /// Until all that have goals are there, or for so long at most.
  bool all_get_there(double time_s) {
    for (const double end_s = now_s_ + time_s; now_s_ < end_s;) {
      step();
      if (std::all_of(robots_.begin(), robots_.end(), [&](const Robot& robot) {
            return !robot.goal || (robot.is_there(now_s_) && !robot.policy->follows());
          }))
        return true;
    }
    return false;
  }

  template <typename Message>
  static std::vector<Message> said(const Robot& robot) {
    std::vector<Message> found;
    for (const PassingMessage& each : robot.said) {
      if (const auto* message = std::get_if<Message>(&each)) found.push_back(*message);
    }
    return found;
  }

  /// What a robot orders another to do; leaders say what they do themselves, too.
  static std::vector<PassingInstruction> told(const Robot& leader, const std::string& robot) {
    std::vector<PassingInstruction> found = said<PassingInstruction>(leader);
    found.erase(std::remove_if(found.begin(), found.end(),
                               [&](const auto& each) { return each.robot != robot; }),
                found.end());
    return found;
  }

  static constexpr double kStep_s = 0.1;
  double now_s_ = 1.7e9;
  double speed_ = 0.8;
  double loss_ = 0.0;  // of messages
  std::deque<Robot> robots_;
  std::shared_ptr<const StaticMap> static_map_ = corridor_with_siding();

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> lost_{0.0, 1.0};
};

/// What a robot without a goal says.
inline PassingIntent intent_of(const std::string& agent, bool calls, PassingOrderId follows = {},
                               std::uint32_t moves = 0) {
  return {agent, 1, 0, calls, 0.3, std::nullopt, std::move(follows), moves};
}

/// What ugv1 orders ugv2 to do: straight moves from place to place, the first after so many of its
/// own.
inline PassingInstruction order(const std::vector<Vector2>& places, std::uint32_t after = 0,
                                std::uint32_t number = 1) {
  PassingInstruction instruction{{"ugv1", 1, number}, "ugv2", {"ugv1", "ugv2"}, 0, 0, 0, {}};
  for (std::size_t i = 1; i < places.size(); ++i)
    instruction.part.push_back({{places[i - 1], places[i]}, {}});
  if (after > 0) instruction.part.front().after = {{0, after}};
  instruction.turns = static_cast<std::uint32_t>(instruction.part.size());
  instruction.alone_from = instruction.turns;
  return instruction;
}

}  // namespace mocha
