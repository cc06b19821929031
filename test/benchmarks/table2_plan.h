#pragma once

#include <vector>

#include "benchmarks/table2_world.h"
#include "trajectory/piecewise_polynomial.h"
#include "world/primitive_field.h"

namespace mocha {

/// What a planner found from rest at the start to a target of Table II.
struct Table2Plan {
  double t_plan_s = 0.0;               ///< wall time, from the list of circles to `curve`
  int classes = 0;                     ///< of paths, that were optimised
  PlanarPath curve;                    ///< without pieces if nothing was found
  std::vector<PlanarPath> candidates;  ///< of all classes, to be drawn; the selected one included
};

/// The figures of Table II, all of them taken from the curve.
struct Table2Measures {
  double length_m;
  double duration_s;
  double top_speed;   ///< [m/s]
  double mean_speed;  ///< [m/s]
  double
      kinematic_s;  ///< L / v_max + v_max / a_max: rest to rest on a straight line of that length
  bool
      feasible;  ///< certified: clear of the true circles, within the limits of speed, acceleration
};

/// What all planners and the certificate ask about the circles.
PrimitiveField<2> obstacle_field(const Table2World& world);

/// Requires a curve with pieces.
Table2Measures measure(const PlanarPath& curve, const Table2World& world);

}  // namespace mocha
