#pragma once

#include <string>

#include "world/world_file.h"

namespace mocha {

/// The stack of each robot plans with the footprint that the world gives it: a robot whose stack
/// takes it for smaller drives into walls. Throws WorldError, `path` being the world's, where the
/// parameters of a robot (`/ugv1/robot`) say otherwise.
void check_footprints(const World& world, const std::string& path);

}  // namespace mocha
