#pragma once

#include <optional>

#include "planning/candidates/maneuver.h"

namespace mocha {

/// What of a maneuver may be promised.
struct CertifiedPart {
  Motion motion;           ///< from the maneuver's join_s on, to rest; as all others will hear it
  double follows_until_s;  ///< absolute; from here on it brakes
  Violation cut_by;  ///< why it does not go farther; nothing where only the horizon or the end did
};

/// The longest part of a maneuver that is certified, from `start.now_s` on and together with what
/// is committed until the maneuver joins, and that fits into one datagram and leads no farther than
/// the robot may promise. It brakes within the maneuver's window; or later, up to the end of the
/// predictions, where only to stop is in the way of something. Nothing where not even the earliest
/// braking is certified, or where the maneuver does not meet the committed motion.
///
/// With RequirementName::kNone nothing is certified: the last resort of a robot.
///
/// What is certified is the motion as it will be driven: rounded as a message rounds it.
std::optional<CertifiedPart> certified_part(const ManeuverStart& start, const Maneuver& maneuver,
                                            RequirementName required);

}  // namespace mocha
