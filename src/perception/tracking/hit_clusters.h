#pragma once

#include <vector>

#include "perception/sensor/beam.h"
#include "trajectory/motion.h"

namespace mocha {

/// Indices of beams of one scan, ascending.
using BeamIndices = std::vector<int>;

/// Groups of the ends of `hits`: each is reached from any other of its group by steps of at most
/// `gap_m`, and no step that short leads to another group.
std::vector<BeamIndices> cluster_hits(const std::vector<Beam>& beams, const BeamIndices& hits,
                                      double gap_m);

/// Parts a cluster: each end goes to the nearest of the centres. Parts may be empty.
std::vector<BeamIndices> part_cluster(const std::vector<Beam>& beams, const BeamIndices& cluster,
                                      const std::vector<Vector2>& centres);

/// Parts a cluster at its deepest notch, and its parts again: where beams pass between its hits,
/// and where the ranges of its beams, in their order, jump by more than `notch_m`, or rise by more
/// than that above what is nearest on either side, as they do between two discs and not along one.
std::vector<BeamIndices> part_at_notches(const std::vector<Beam>& beams, const BeamIndices& cluster,
                                         double notch_m);

/// Greatest distance between two ends [m].
double extent_m(const std::vector<Beam>& beams, const BeamIndices& cluster);

}  // namespace mocha
