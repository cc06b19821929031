#include "planning/candidates/fallback.h"

#include <cstdio>

namespace mocha {

const char* to_text(FallbackKind kind) {
  switch (kind) {
    case FallbackKind::kLatticePath:
      return "a path of the lattice: the roadmap led nowhere";
    case FallbackKind::kCoincidentPoints:
      return "plain waypoints instead of camouflage: points of the path coincide, without a "
             "reference point";
    case FallbackKind::kSharpBend:
      return "plain waypoints instead of camouflage: the path bends too sharply for a reference "
             "point";
    case FallbackKind::kCamouflageGivenUp:
      return "plain waypoints instead of camouflage: with it, proofs failed";
    case FallbackKind::kSlowedDown:
      return "a slower drive than optimised: faster, the proof failed";
  }
  return "unknown";
}

std::string describe(const BasicFallback<2>& fallback) {
  char place[64];
  std::snprintf(place, sizeof(place), ", at (%.2f, %.2f)", fallback.place.x(), fallback.place.y());
  return to_text(fallback.kind) + std::string(place);
}

std::string describe(const BasicFallback<3>& fallback) {
  char place[80];
  std::snprintf(place, sizeof(place), ", at (%.2f, %.2f, %.2f)", fallback.place.x(),
                fallback.place.y(), fallback.place.z());
  return to_text(fallback.kind) + std::string(place);
}

}  // namespace mocha
