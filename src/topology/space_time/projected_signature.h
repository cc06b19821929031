#pragma once

#include <optional>
#include <vector>

#include "topology/paths/class_search.h"
#include "topology/space_time/space_time.h"

namespace mocha {

/// The signature of a path in (x, y, z, t) by its projections onto (x, y, t), (x, z, t) and
/// (y, z, t) (paper V-C): SpaceTime<3>'s entries, but nothing where an entry abstains. That of a
/// moving ball in a projection does if the path comes closer than some c > 0 to the ball's shadow
/// there (Remark 1): the projected path may then pass through the ball's place, in front of it or
/// behind. Entries of static obstacles never abstain; they are invariants in space.
///
/// What a difference proves. A ball is bounded, so a path can be led around it along the axis that
/// is projected out: in space and time the free space around balls has but one class. That entries
/// differ says that the paths pass the ball on different sides, and that any deformation of one
/// into the other has to leave the projected free space, that is, pass the ball's shadow. It proves
/// that they are not homotopic (Prop. 1) only where the shadow is the obstacle, which then spans
/// all of that axis. Equal entries prove nothing (Remark 2).
///
/// With straight motion between its points a path's crossings are exact. One that stands for a
/// curve, sampled every dt, has the curve's entries if L dt < c, where L is the speed of the curve
/// relative to the balls: curve and path then are less than c apart, and neither reaches a shadow.
using ProjectedSignature = std::vector<std::optional<int>>;

/// `clearance_m`: c, at least 0. `path` is in order in `space`.
ProjectedSignature projected_signature(const SpaceTime<3>& space,
                                       const std::vector<Eigen::Vector4d>& path,
                                       double clearance_m);

/// Whether some entry differs from which neither abstains, of two paths with the same ends.
bool differ(const ProjectedSignature& a, const ProjectedSignature& b);

/// Of paths that are given shortest first, some that differ pairwise, shortest first. One that
/// abstains differs from none; so of the choices that begin with some path and take on, in order,
/// whatever differs from all before it, this is the largest.
std::vector<ClassPath<4>> pairwise_different(std::vector<ClassPath<4>> paths,
                                             const SpaceTime<3>& space, double clearance_m);

}  // namespace mocha
