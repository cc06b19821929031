#pragma once

#include <optional>

#include "benchmarks/bitstar.h"
#include "benchmarks/table2_plan.h"

namespace mocha {

/// What SST's model does with a control that would drive faster than the limit.
enum class Overspeed {
  kForbidden,  ///< such states are invalid: the limits as bounds, as OMPL's models have them
  kClipped     ///< the speed stays at the limit: the same drives, more easily found
};

/// SST on the double integrator in the plane with the robot's limits of speed and acceleration; the
/// cost is the time. It may end at any speed within 1 m of the target. Without a budget the first
/// solution is taken, whenever it comes within 30 s.
Table2Plan plan_with_sst(const Table2World& world, const Vector2& target,
                         std::optional<double> budget_s, Overspeed overspeed);

/// BIT* in the plane, for `budget_s` or to its first solution, then PathSimplifier::simplifyMax. A
/// path has no timing: the curve drives its length from rest to rest within the limits, as if
/// corners cost no time, so that its duration is the kinematic limit.
Table2Plan plan_with_bitstar(const Table2World& world, const Vector2& target,
                             std::optional<double> budget_s);

}  // namespace mocha
