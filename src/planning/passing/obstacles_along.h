#pragma once

#include <vector>

#include "topology/static_map/static_map.h"

namespace mocha {

/// The obstacles of a map that come clearly closer to a path, straight between its places, than
/// `clearance_m`, and closer than where it begins: of each, places at least a tenth of a metre
/// apart. Map frame [m].
std::vector<Vector2> obstacles_along(const std::vector<Vector2>& path, const StaticMap& static_map,
                                     double clearance_m);

}  // namespace mocha
