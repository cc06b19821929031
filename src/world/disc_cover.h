#pragma once

#include <vector>

#include "trajectory/piecewise_polynomial.h"

namespace mocha {

/// A disc that moves with a body.
struct CoverDisc {
  Vector2 offset_m;  ///< of its centre, body frame
  double radius_m;
};

/// Discs that together hold every point of the simple polygon with these corners, none of which
/// reaches more than `tolerance_m` > 0 out of it. The same for the same corners on every machine.
///
/// A disc whose centre is `depth` below the outline and whose radius is the depth and the tolerance
/// sticks out no farther; the polygon is the union of such discs. The cover is greedy: what is
/// farthest out and not held yet gets the largest such disc that holds it.
std::vector<CoverDisc> disc_cover(const std::vector<Vector2>& corners, double tolerance_m);

/// Fewer discs, which leave corners out: no point of the polygon is farther than `tolerance_m` > 0
/// from all of them, and none reaches farther than that out of it. Of the covers with as few discs
/// as the tolerance allows disc_cover(), nearly the closest that it finds.
std::vector<CoverDisc> soft_disc_cover(const std::vector<Vector2>& corners, double tolerance_m);

}  // namespace mocha
