#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planning/passing/passing_duration.h"
#include "planning/passing/passing_order.h"

namespace mocha {

/// A robot of a group that is to pass.
struct PassingMember {
  std::string name;
  Vector2 place;                ///< where it rests, or will come to rest; map frame
  std::optional<Vector2> goal;  ///< none: it makes room as it likes
};

struct GroupOrder {
  PassingOrder order;
  /// Of each member: whether it gets to its goal. All do where that is possible.
  std::vector<bool> gets_there;
};

/// In which order a group passes, the quickest of some; the members highest rank first. Where not
/// all can get to their goals, those of the lowest rank give theirs up, and make room. Robots make
/// room near by if that suffices, and on ground that was not seen only if nothing else does. What
/// `ground` refers to must live as long as the call. Nothing where not even the first can get to
/// its goal, there are more than JointStep::kMostRobots, or it was stopped.
std::optional<GroupOrder> order_group(
    const PassingGround& ground, const std::vector<PassingMember>& members,
    const PlaceGraphOptions& options, const PassingPace& pace,
    const std::function<bool()>& should_stop = [] { return false; });

}  // namespace mocha
