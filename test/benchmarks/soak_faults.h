#pragma once

#include <cstdint>
#include <vector>

#include "benchmarks/robot_nodes.h"
#include "simulation/lossy_network.h"

namespace mocha {

/// Something that happens to one robot, and is over at `end_s`.
struct SoakFault {
  enum class Kind {
    kNode,     ///< a node does not run
    kRobot,    ///< all nodes but the tracker do not run, which starts anew with them
    kBlackout  ///< the network does not reach it
  };
  Kind kind;
  int robot;
  RobotNode node;  ///< of kNode
  double begin_s;
  double end_s;
};

/// From a time on the network is so.
struct LinkChange {
  double begin_s;
  NetworkLink link;
};

struct SoakFaults {
  std::vector<SoakFault> faults;  ///< by begin; one robot's do not overlap
  std::vector<LinkChange> links;  ///< by begin

  /// Until `duration_s`, which changes nothing before then; the same for the same seed, on every
  /// machine.
  static SoakFaults drawn(double duration_s, int robots, std::uint64_t seed);
};

}  // namespace mocha
