#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "safety/certificate.h"
#include "safety/margin_budget.h"
#include "trajectory/unicycle.h"
#include "world/distance_field.h"
#include "world/robot_model.h"

namespace mocha {

/// What a promise is proved against.
struct PromiseScene {
  std::shared_ptr<const DistanceField> obstacles;                  ///< occupied cells
  std::shared_ptr<const DistanceField> unseen;                     ///< occupied or unknown cells
  std::vector<std::shared_ptr<const MovingObstacle>> others = {};  ///< team-mates on their promises
  /// People and other things that promise nothing, as predicted: discs that hold them with the
  /// confidence that is asked for ...
  std::vector<std::shared_ptr<const MovingObstacle>> moving = {};
  /// ... and, as a narrow place may leave nothing better, those of their most likely course; where
  /// there are none, the former stand for both.
  std::vector<std::shared_ptr<const MovingObstacle>> expected = {};
  double predicted_until_s = 0.0;  ///< absolute; later, predictions say nothing

  /// With what is most likely in the place of what is asked for.
  PromiseScene most_likely() const;
};

/// A certified motion that ends at rest, and how far it follows what it was cut from.
struct CertifiedMotion {
  Motion motion;
  double follows_until_s;  ///< absolute; from here on it brakes
  Violation
      cut_by;  ///< why it does not go farther; nothing where only the horizon or the end cut it
};

/// What is left of a motion from a time on, which must be a switch time of it; a stand if nothing
/// is left.
Motion remainder(const Motion& motion, double from_s);

/// What is in force from `now_s` (or from the last time at which it can be cut) until `join_s`, a
/// switch time of it, and then `next`, which begins there. Throws std::invalid_argument where they
/// do not meet, as Motion does.
Motion continued(const Motion& committed, double now_s, double join_s, const Motion& next);

/// Cuts motions to what may be promised: all of it certified on the newest map, inside space seen
/// free, apart from the peers' promises, and ending at rest.
class PromiseBuilder {
 public:
  explicit PromiseBuilder(RobotModel robot);

  /// The first violation of a motion to be promised, from a time on.
  Violation certify(const Motion& motion, const PromiseScene& scene, double from_s) const;

  /// The same for a promise in force: the margin for surfaces nearer than the map said is there to
  /// be used up as the map gets better, and part of the clearance to people, on their most likely
  /// course, as they change their minds.
  Violation certify_in_force(const Motion& motion, const PromiseScene& scene, double from_s) const;

  /// The longest part of `motion` from `from_s` on that may be promised, and fits into one
  /// datagram, when braking begins no earlier than `earliest_s` and no later than `latest_s`; or
  /// later, up to the end of the predictions, where only to stop is in somebody's way. Nothing if
  /// even braking at `earliest_s` is not certified.
  std::optional<CertifiedMotion> longest(const Motion& motion, const PromiseScene& scene,
                                         double from_s, double earliest_s, double latest_s) const;

  /// What moves in the scene, and what the centre of the robot keeps from it: all that a new
  /// promise must keep from team-mates, and `share` of the clearance that it must keep from other
  /// things.
  std::vector<MovingThing> kept_from(const PromiseScene& scene, double now_s, double share) const;

  /// Deceleration [m/s^2] of promised braking.
  double deceleration() const { return 0.6 * robot_.limits.max_acceleration; }
  /// The same where nothing gentler helps: what the wheels can do, with something to spare.
  double hard_deceleration() const;
  /// Of an emergency stop [m/s^2], in which the faster wheel slows down as hard as it can.
  double stop_deceleration(const UnicycleState& twist) const;

 private:
  struct Kept {
    double obstacles_m;   ///< margin
    double peer_slack_m;  ///< beyond what is required
    double moving_share;  ///< of the clearance required
    double reserve_s;     ///< at the end of the predictions, of which nothing is asked
  };
  std::vector<MovingThing> kept_from(const PromiseScene& scene, double now_s,
                                     const Kept& kept) const;
  Violation check(const Motion& motion, const PromiseScene& scene, double from_s,
                  const Kept& kept) const;

  RobotModel robot_;
  MarginBudget margins_;
};

}  // namespace mocha
