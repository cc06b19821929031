#pragma once

#include "benchmarks/table2_plan.h"

namespace mocha {

/// The planner of this package, from rest to rest.
Table2Plan plan_with_mocha(const Table2World& world, const Vector2& target);

}  // namespace mocha
