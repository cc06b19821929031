#pragma once

#include <vector>

#include "fleet/model/scenario.h"

namespace mocha::test {

// Motions of different robots meet, all in the same place. All robots are near, but where one comes
// near.

/// Two robots that want to cross, at the same time or one after the other.
Scenario two_cross(const Harm& harm);

/// Three robots that want to cross, at the same time.
Scenario three_cross(const Harm& harm);

/// Two robots that want to cross while they may fall out of reach of each other.
Scenario out_of_reach(const Harm& harm);

/// The first robot proposes where to drive on past the crossing, before or after its first motion
/// is settled; the second one wants to cross, and they may fall out of reach of each other.
Scenario one_changes_its_mind(const Harm& harm);

/// The first robot drives as its broadcaster is started anew, and then drives on; the second wants
/// to cross its way.
Scenario one_restarts(const Harm& harm);

/// Two robots that want to cross; the broadcasters of both may be started anew.
Scenario both_restart(const Harm& harm);

/// Two robots that want to cross; the first one may brake.
Scenario one_brakes(const Harm& harm);

/// Two robots that want to cross, and whose clocks differ so.
Scenario clocks_differ(const Harm& harm, double ahead_s);

/// The first robot comes from where its promises cannot meet those of the second, which it need not
/// ask then, and drives on until they do; the second one wants to go there.
Scenario one_comes_near(const Harm& harm);

/// All of these: as much of each as takes some seconds, or minutes.
std::vector<Scenario> short_scenarios();
std::vector<Scenario> long_scenarios();

}  // namespace mocha::test
