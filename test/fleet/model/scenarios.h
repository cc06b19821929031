#pragma once

#include <vector>

#include "fleet/model/scenario.h"

namespace mocha::test {

/// Two robots that want to cross, at the same time or one after the other.
Scenario two_cross(const Harm& harm);

/// Three robots, each of whose motions meets both others.
Scenario three_cross(const Harm& harm);

/// The first robot drives as its broadcaster is started anew; the second wants to cross its way.
Scenario one_restarts(const Harm& harm);

/// Two robots that want to cross; the first one may brake.
Scenario one_brakes(const Harm& harm);

/// Two robots that want to cross, and whose clocks differ so.
Scenario clocks_differ(const Harm& harm, double ahead_s);

}  // namespace mocha::test
