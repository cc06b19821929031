#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "topology/paths/class_roadmap.h"
#include "topology/paths/grid_path.h"
#include "topology/signatures/h_signature.h"
#include "topology/static_map/travel_cost.h"

namespace mocha {

/// What is left of the cost of a path through a roadmap when it is shortened, at least: measured on
/// maps of 100 m.
constexpr double kShortened = 0.9;

struct HomotopyPathOptions {
  TravelOptions travel;
  RoadmapKind roadmap;
  int classes;           ///< at most this many paths
  double longest_ratio;  ///< a path that costs more than the cheapest by this is none
  int prm_samples;       ///< of the visibility roadmap
};

/// A path from start to goal of one class.
struct HomotopyPath {
  std::vector<Vector2> points;  ///< straight between them
  double cost_m = 0.0;          ///< length, longer where it is narrow
  double least_length_m = 0.0;  ///< of any path of this class, proved
  Signature signature;          ///< lead-in included
  /// Where the path is narrowest, if it is one of the lattice, as the roadmap led nowhere [m].
  std::optional<Vector2> narrowest_on_lattice = std::nullopt;
};

struct HomotopyPaths {
  GridPath::Outcome outcome = GridPath::Outcome::kNoPath;
  std::vector<HomotopyPath>
      paths;         ///< of pairwise different classes, cheapest first; empty unless found
  Cuts<2> cuts{{}};  ///< that tell the classes apart
  std::optional<Signature> driven;  ///< class of the path that is being driven
};

/// From where to where.
struct HomotopyPathQuery {
  /// What is driven before the paths begin, in any case: from where the robot is to their start. It
  /// counts for their classes. At least one point.
  std::vector<Vector2> lead_in;
  Vector2 goal = Vector2::Zero();
  /// Obstacles besides the static map, to be passed on either side.
  std::vector<BlockedDisc> blocked;
  /// The path that is being driven to the same goal, from the front of `lead_in` on; or empty.
  std::vector<Vector2> driven;
  /// If set, only the driven path is looked for, and those that cost less than this ratio of it
  /// before they are shortened; nothing, where it is not possible any more.
  std::optional<double> below_driven;
  /// Ends the search early; several threads may call it at once.
  std::function<bool()> should_stop = [] { return false; };

  const Vector2& start() const { return lead_in.back(); }
};

/// The cheapest paths of pairwise different classes (paper IV-E). The path that is being driven is
/// classified anew among the obstacles of now; if it is still possible, and there is no lead-in,
/// its class is among the paths even where it is not among the cheapest.
HomotopyPaths find_homotopy_paths(const StaticMap& static_map, const HomotopyPathQuery& query,
                                  const HomotopyPathOptions& options);

}  // namespace mocha
