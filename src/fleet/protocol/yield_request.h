#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// Which robot goes first where robots stand in each other's way: one that cannot get out of the
/// way, then the higher priority, then the smaller name. A total order over the fleet.
struct Rank {
  bool stuck = false;  ///< there is no place to go to that would leave the way free
  int priority = 0;
  std::string agent;
};

bool outranks(const Rank& a, const Rank& b);

/// "Keep out of this way of mine": sent by a robot whose team-mates stand in it, again and again
/// until it is where it wants to be. The request lapses when it is not heard any more. It binds no
/// robot: what may be driven is settled by promises alone.
struct YieldRequest {
  std::string agent;
  std::uint32_t epoch = 0;
  /// Its own, or that of the robot that it makes room for: what is in its way is in the way of that
  /// robot, too.
  Rank rank;
  double radius_m = 0.0;   ///< circumscribed
  double speed_mps = 0.0;  ///< it comes no faster
  /// Places of the centre from where it is to where it wants to be, straight between. Map frame.
  /// None: the request is withdrawn.
  std::vector<Vector2> path;
};

constexpr std::size_t kMostPathPlaces = 64;

/// Throws std::invalid_argument, saying what is wrong, for a request that no robot can have meant:
/// no name, a radius outside (0, 10] m, a speed outside (0, 50] m/s, too many places or places that
/// are not finite.
void validate(const YieldRequest& request);

/// The same way, at most kMostPathPlaces of its places, as near to it as these allow.
std::vector<Vector2> said_shortly(const std::vector<Vector2>& path);

}  // namespace mocha
