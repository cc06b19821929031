#pragma once

#include <vector>

#include "topology/static_map/static_map.h"

namespace mocha {

/// Returns where obstacles of a map are clearly closer to a path than `clearance_m`, and closer
/// than where it begins: places on them at least a tenth of a metre apart. The path has a place,
/// and is straight between its places. Map frame [m].
std::vector<Vector2> obstacles_along(const std::vector<Vector2>& path, const StaticMap& static_map,
                                     double clearance_m);

}  // namespace mocha
