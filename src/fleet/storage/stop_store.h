#pragma once

#include <string>

#include "fleet/protocol/emergency_stop.h"

namespace mocha {

/// The emergency stops of the file, as save_stops() wrote them; none where there is no file. What
/// cannot be read may have been a stop, and is one of this robot: the reason says so.
StopRecord load_stops(const std::string& path);

/// So that they survive a restart and a loss of power. Throws std::runtime_error, naming the file
/// and the trouble, where that is impossible.
void save_stops(const std::string& path, const StopRecord& record);

}  // namespace mocha
