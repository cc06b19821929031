#pragma once

namespace mocha {

/// What a plan is for.
enum class PlanKind {
  kFree,    ///< to get somewhere, by whatever way
  kInTurn,  ///< a stretch of an order of passing: it is driven as it is, or later
};

}  // namespace mocha
