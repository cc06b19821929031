#pragma once

#include <functional>
#include <string>

#include "topology/roadmaps/roadmap.h"
#include "topology/signatures/h_signature.h"
#include "topology/static_map/travel_cost.h"

namespace mocha {

enum class RoadmapKind { kBest, kApollonius, kVisibilityPrm };

/// By its name: `apollonius`, `visibility_prm`, or `best`: the skeleton that a map keeps, else the
/// former where it was built, else the latter. Throws std::invalid_argument for other names, and
/// for `apollonius` where it was not built.
RoadmapKind roadmap_kind(const std::string& name);

/// What paths of different classes are searched on.
struct ClassRoadmap {
  Roadmap<2> roadmap;  ///< the lengths of its edges are costs
  Cuts<2> cuts;        ///< of what the classes pass on either side
};

/// From the start that `cost` knows. `prm_samples`: of a sampled roadmap. Where it is stopped, the
/// roadmap is empty.
ClassRoadmap class_roadmap(const TravelCost& cost, const Vector2& goal, RoadmapKind kind,
                           int prm_samples, const std::function<bool()>& should_stop);

}  // namespace mocha
