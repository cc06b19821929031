#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

#include "camouflage/reference_point.h"

namespace mocha {

/// What planning does in place of what it does as a rule, as that failed; the same list as in
/// Fallback.msg.
enum class FallbackKind {
  kLatticePath = 1,        ///< the roadmap led nowhere; where the path is narrowest
  kCoincidentPoints = 2,   ///< waypoints instead of camouflage: see ReferenceFault
  kSharpBend = 3,          ///< the same
  kCamouflageGivenUp = 4,  ///< waypoints instead of camouflage; where the proof failed with it
  kSlowedDown = 5          ///< slower than optimised; where the proof failed before
};

inline constexpr std::array kFallbackKinds = {
    FallbackKind::kLatticePath, FallbackKind::kCoincidentPoints, FallbackKind::kSharpBend,
    FallbackKind::kCamouflageGivenUp, FallbackKind::kSlowedDown};

template <int D>
struct BasicFallback {
  FallbackKind kind;
  Eigen::Matrix<double, D, 1> place;  ///< [m] map frame
};

using Fallback = BasicFallback<2>;

/// Why a path without reference points has waypoints as variables.
template <int D>
BasicFallback<D> fallback_of(const ReferencesOrFault<D>& chosen) {
  const bool bends = chosen.fault == ReferenceFault::kSharpBend;
  return {bends ? FallbackKind::kSharpBend : FallbackKind::kCoincidentPoints, chosen.place};
}

/// What is done instead of what, and why, such as "plain waypoints instead of camouflage: the path
/// bends too sharply for a reference point".
const char* to_text(FallbackKind kind);

/// The same, with the place.
std::string describe(const BasicFallback<2>& fallback);
std::string describe(const BasicFallback<3>& fallback);

}  // namespace mocha
