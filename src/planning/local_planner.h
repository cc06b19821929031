#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planning/drive_optimizer.h"
#include "planning/local_rules.h"
#include "planning/opening.h"
#include "planning/plan_result.h"
#include "planning/rejoining.h"
#include "topology/space_time_ways.h"
#include "topology/terrain.h"

namespace mocha {

/// What is around: static obstacles (unknown space counts as free), and what moves, with the
/// distance that is to be kept.
struct LocalScene {
  std::shared_ptr<const Terrain> terrain;
  std::vector<MovingThing> moving;    ///< as surely as is asked for
  std::vector<MovingThing> expected;  ///< on its most likely course; empty: the same
};

/// What was proved of a motion, from the best on. In any case it keeps clear of what stands.
enum class LocalProof {
  kAsked,      ///< keeps from what moves, as surely as is asked for
  kLikely,     ///< keeps from its most likely course
  kEmergency,  ///< the same, but more abruptly than the robot is wanted to drive
  kNone
};

/// Out of which motion, and back into which plan. Map frame, absolute times.
struct LocalQuery {
  Motion committed;
  double start_time_s = 0.0;  ///< the local drive leaves `committed` here, a switch time of it
  Motion plan;
  double progress_s = 0.0;  ///< time of the plan at which it is where the robot is
  Motion driven;            ///< what is being followed, for its class; may be empty
};

/// One way through space-time that was optimised, certified or not.
struct LocalCandidate {
  TimedPath way;  ///< of the front end, from which the optimisation started
  Signature signature;
  PlanReason reason = PlanReason::kNotCertified;
  LocalProof proof = LocalProof::kNone;
  Violation violation;  ///< the first one before the anchor, of what is asked for
  double cost = 0.0;    ///< J (14) with (39), (40)
  CostTerms terms;
  Motion motion;         ///< up to the plan's end
  double rejoins_s = 0;  ///< absolute time at which it is back on the plan
  bool driven = false;   ///< of the class that the plan itself has
  bool selected = false;
};

struct LocalPlan {
  PlanReason reason = PlanReason::kNoPath;
  std::string message = "no plan to come back to";
  Violation violation;  ///< of the first candidate, where none is certified
  LocalProof proof = LocalProof::kNone;
  /// From start_time_s past everything that moves to the anchor, and on along the plan, shifted in
  /// time. Proved up to the anchor as `proof` says; empty unless solved.
  Motion motion;
  RejoiningPoint anchor;        ///< where it is back on the plan, or would be
  double rejoins_s = 0.0;       ///< absolute time at which the motion is at the anchor
  double delay_s = 0.0;         ///< by how much it is later there than the plan would have been
  bool late = false;            ///< (42): longer than T_epsilon, or as late at a farther anchor
  Violation beyond;             ///< what the plan violates after the anchor, shifted as it is
  bool switches_class = false;  ///< other than the plan's
  std::vector<LocalCandidate> candidates;
};

/// What a search is doing.
enum class LocalStage { kFrontEnd, kOptimisation, kDone };

/// Section V: leaves a plan in order to avoid what moves, and comes back to it.
class LocalPlanner {
 public:
  /// Told when a stage begins, for whoever measures; called by several threads at once.
  using Watch = std::function<void(LocalStage)>;

  LocalPlanner(
      const RobotModel& robot, const LocalRules& rules, Watch watch = [](LocalStage) {});

  /// Tries what is driven first, then other ways.
  LocalPlan plan(const LocalQuery& query, const LocalScene& scene) const;
  /// What is driven, made to fit; other ways are not looked for. No candidate where nothing is
  /// driven.
  LocalPlan keep_on(const LocalQuery& query, const LocalScene& scene) const;
  /// Other ways too, without a preference for what is driven; against scene.moving.
  LocalPlan anew(const LocalQuery& query, const LocalScene& scene) const;
  /// On the ways of a plan for the same query that came to nothing, perhaps by a planner for a
  /// robot that may do less.
  LocalPlan again(const LocalQuery& query, const LocalScene& scene, const LocalPlan& failed) const;

 private:
  /// To come back to the plan at one place and time.
  struct Task {
    RejoiningPoint anchor;
    double earliest_s;
    SpaceTimeQuery ways;
  };

  /// About the least time to the anchor.
  double earliest_s(const LocalQuery& query, const RejoiningPoint& anchor) const;
  /// With anchors ever farther and arrivals ever later.
  std::vector<Task> tasks(const LocalQuery& query, const LocalScene& scene) const;
  Cuts<2> cuts_for(const std::vector<Task>& tasks, const LocalScene& scene) const;
  /// Past scene.moving; scene.expected is what else is proved of what comes out.
  LocalPlan search(const LocalQuery& query, const LocalScene& scene) const;
  LocalPlan along(const std::vector<SpaceTimeWay>& ways, const LocalQuery& query,
                  const LocalScene& scene, const Task& task) const;
  LocalPlan attempt(const LocalQuery& query, const LocalScene& scene, const Task& task,
                    const Cuts<2>& cuts) const;
  LocalCandidate candidate(const LocalQuery& query, const LocalScene& scene, const Task& task,
                           const SpaceTimeWay& way) const;
  /// How to begin on a way: at once, or after braking and turning.
  std::vector<Opening> openings(const LocalQuery& query, std::vector<Vector2> path) const;
  void drive(const LocalQuery& query, const LocalScene& scene, const Task& task,
             const Opening& opening, LocalCandidate& candidate) const;
  Violation certify(const Motion& motion, const std::vector<MovingThing>& moving,
                    double from_s) const;
  /// Up to until_s, which is the beginning of what is only planned.
  LocalProof proof_of(const Motion& motion, const LocalScene& scene, double from_s, double until_s,
                      Violation& violation) const;
  void select(const LocalQuery& query, const LocalScene& scene, const Task& task,
              LocalPlan& plan) const;

  const Watch watch_;
  const RobotModel robot_;
  const MotionLimits emergency_limits_;
  const LocalRules rules_;
  const SpaceTimeRules space_time_rules_;
  const double margin_m_;
  const DriveOptimizer optimizer_;
  const Openings openings_;
};

}  // namespace mocha
