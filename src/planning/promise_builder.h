#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "safety/certificate.h"
#include "safety/margin_budget.h"
#include "world/distance_field.h"
#include "world/robot_model.h"

namespace mocha {

/// What a promise is proved against.
struct PromiseScene {
  std::shared_ptr<const DistanceField> obstacles;  ///< occupied cells
  std::shared_ptr<const DistanceField> unseen;     ///< occupied or unknown cells
  std::vector<std::shared_ptr<const MovingObstacle>> others;
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

/// Cuts motions to what may be promised: all of it certified on the newest map, inside space seen
/// free, apart from the peers' promises, and ending at rest.
class PromiseBuilder {
 public:
  explicit PromiseBuilder(RobotModel robot);

  /// The first violation of a motion to be promised, from a time on.
  Violation certify(const Motion& motion, const PromiseScene& scene, double from_s) const;

  /// The same for a promise in force: the margin for surfaces nearer than the map said is there to
  /// be used up as the map gets better.
  Violation certify_in_force(const Motion& motion, const PromiseScene& scene, double from_s) const;

  /// The longest part of `motion` from `from_s` on that may be promised when braking begins no
  /// earlier than `earliest_s` and no later than `latest_s`. Nothing if even braking at
  /// `earliest_s` is not certified.
  std::optional<CertifiedMotion> longest(const Motion& motion, const PromiseScene& scene,
                                         double from_s, double earliest_s, double latest_s) const;

  /// Deceleration [m/s^2] of promised braking.
  double deceleration() const { return 0.6 * robot_.limits.max_acceleration; }

 private:
  struct Margins {
    double obstacles_m;
    double others_m;
  };
  Violation check(const Motion& motion, const PromiseScene& scene, double from_s,
                  const Margins& margins) const;

  RobotModel robot_;
  MarginBudget margins_;
};

}  // namespace mocha
