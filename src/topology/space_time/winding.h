#pragma once

#include <vector>

#include "topology/space_time/space_time_tube.h"
#include "topology/space_time/timed_path.h"

namespace mocha {

/// By how many full turns the direction from `tube`'s centre to `a` turns farther counter-clockwise
/// than that to `b`, over the time that all three share: the difference of the swept angles of
/// paper (35), exact as everything is straight in time. For paths that meet at both ends it is the
/// integer by which their signatures differ; else a share of a turn for how far apart their ends
/// are seen from the obstacle is left over. 0 without a common time.
double winding_difference(const TimedPath& a, const TimedPath& b, const Tube<2>& tube);

/// Whether the winding differences about all obstacles, rounded to the nearest integer, are 0: the
/// two could be deformed into each other, their ends sliding along. For paths whose ends do not
/// quite agree, such as the one that is driven and a new one. What stands is a tube of velocity 0
/// about a point of its solid matter.
bool same_class(const TimedPath& a, const TimedPath& b, const std::vector<Tube<2>>& obstacles);

}  // namespace mocha
