#pragma once

#include "safety/requirement.h"
#include "safety/scene.h"
#include "safety/violation.h"

namespace mocha {

/// Returns the first violation of what is required of a motion in the stretch of time that the
/// requirement names; no violation means that the motion is certified.
///
/// This is the only place that says what may be driven: every candidate, promise and renewed lease
/// passes through it. A proof holds in continuous time; see certificate.h for what is refused
/// though it may hold.
Violation certify(const Motion& motion, const Footprint& footprint, const Scene& scene,
                  const Requirement& requirement);

}  // namespace mocha
