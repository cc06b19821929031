#pragma once

#include <memory>
#include <string>
#include <vector>

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
  double anchor_s = 0.0;    ///< time of the plan at which `driven` comes back to it; 0: never left
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
  PlanReason reason = PlanReason::kNoPath;  ///< kSolved: there is a motion, proved as `proof` says
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

}  // namespace mocha
