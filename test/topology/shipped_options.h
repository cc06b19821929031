#pragma once

#include "config/parameter_table.h"
#include "topology/paths/homotopy_paths.h"
#include "topology/roadmaps/skeleton.h"
#include "topology/roadmaps/visibility_prm.h"
#include "topology/space_time/space_time_paths.h"

namespace mocha {

/// What config/ ships, for a robot that keeps 0.3 m; tests say by themselves what they vary.

constexpr double kRequiredClearance_m = 0.3;
constexpr double kEscapeRadius_m = 0.6;

inline const ParameterTable& shipped_global_values() {
  static const ParameterTable values = ParameterTable::from_schema("config/global_planner.yaml");
  return values;
}

inline TravelOptions shipped_travel_options() {
  const ParameterTable& values = shipped_global_values();
  return {kRequiredClearance_m, kRequiredClearance_m + values.number("preferred_clearance"),
          values.number("clearance_weight"), kEscapeRadius_m};
}

inline HomotopyPathOptions shipped_path_options() {
  const ParameterTable& values = shipped_global_values();
  return {shipped_travel_options(), roadmap_kind(values.text("roadmap")), values.integer("classes"),
          values.number("longest_ratio"), values.integer("prm_samples")};
}

inline SpaceTimeOptions shipped_space_time_options(double max_speed) {
  const ParameterTable values = ParameterTable::from_schema("config/local_replanner.yaml");
  return {max_speed,
          kRequiredClearance_m,
          kEscapeRadius_m,
          values.integer("samples"),
          1,
          values.integer("classes"),
          values.number("longest_ratio")};
}

inline ClearanceOptions shipped_clearance() { return {kRequiredClearance_m, kEscapeRadius_m}; }

/// Roadmaps of many samples, which see far.
inline VisibilityPrmOptions prm_options(int samples = 3000, std::uint64_t seed = 1) {
  return {samples, seed, 20.0};
}

inline SkeletonOptions shipped_skeleton_options() {
  return {kRequiredClearance_m, kEscapeRadius_m};
}

}  // namespace mocha
