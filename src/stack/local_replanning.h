#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "config/parameter_table.h"
#include "control/lease.h"
#include "planning/replanner/local_replanner.h"

namespace mocha {

/// How long a plan takes until the robot is bound to it [s]: the wait for the next step of the
/// local replanner, and settling. `values` are those of config/local_replanner.yaml.
double handover_s(const ParameterTable& values);

/// How old data may be without which nothing is certified, and how long a lease lasts [s]; each
/// stands in config/local_replanner.yaml.
struct LocalReplanningOptions {
  double lease_s;
  double max_map_age_s;
  double max_fleet_age_s;
  double max_prediction_age_s;

  static LocalReplanningOptions from(const ParameterTable& values);
};

/// Where the data come from, in messages to people.
struct DataNames {
  std::string map = "map";
  std::string fleet = "fleet/trajectories";
  std::string predictions = "predicted_obstacles";
};

/// What a step knows. Ages [s] are infinite before the first data.
struct LocalKnowledge {
  static constexpr double kNever_s = std::numeric_limits<double>::infinity();

  std::string stop;  ///< why the robot is stopped for an emergency; empty: it is not
  std::optional<RobotState> measured;
  std::string no_pose;  ///< why nothing is measured
  double map_age_s = kNever_s;
  double fleet_age_s = kNever_s;
  double prediction_age_s = kNever_s;
  std::string sensor_fault;  ///< which sensor lies, so that nothing can be certified; empty: none
  /// What is around the robot, which is at that place (map frame). Asked for where all data are
  /// fresh.
  std::function<LocalScene(const Vector2&)> scene;
};

/// What became of a proposal, or of the motion in force.
struct Answer {
  enum class Kind {
    kSettled,
    kRefused,
    kBreached,  ///< a peer's promise meets the motion in force
  };
  Kind kind = Kind::kSettled;
  std::uint32_t sequence = 0;
  std::string words;
};

/// The local replanner and what is decided around it: whether the data suffice for a step, when one
/// is due at once, and until when the motion in force may be driven.
class LocalReplanning {
 public:
  struct Output : LocalReplanner::Output {
    std::optional<Lease> lease;       ///< the renewed one
    std::optional<LocalScene> scene;  ///< what was looked at; nothing where the robot only stops
  };

  LocalReplanning(
      const RobotModel& robot, const ParameterTable& values, double promise_reach_m,
      DataNames names = {}, const LocalPlanner::Watch& watch = [](LocalStage) {});

  /// As LocalReplanner::set_plan(); where there is nothing to drive to, a step is due at once.
  void set_plan(Motion plan, PlanKind kind = PlanKind::kFree);
  void set_committed(const MotionId& id, Motion motion);
  void hear(const Answer& answer);

  /// Before the period is over: the motion in force meets a peer's promise, or is to be stopped.
  bool step_is_due() const { return step_is_due_; }
  Output step(double now_s, const LocalKnowledge& known);

  const LocalReplanner& replanner() const { return replanner_; }
  const MotionId& committed_id() const { return committed_id_; }
  int refused() const { return refused_; }
  /// Why the last proposal was refused.
  const std::string& refusal() const { return refusal_; }

 private:
  struct Missing {
    PlanReason reason;  ///< of the first
    std::string words;
  };
  /// All without what nothing can be certified; nothing where all data are there.
  std::optional<Missing> what_is_missing(const LocalKnowledge& known) const;
  LocalReplanner::Output stop_without(const Missing& missing, double now_s);
  LocalReplanner::Output halt(double now_s, const LocalKnowledge& known);

  const LocalReplanningOptions options_;
  const DataNames names_;
  LocalReplanner replanner_;
  MotionId committed_id_;
  bool step_is_due_ = false;
  int refused_ = 0;
  std::string refusal_;
};

}  // namespace mocha
