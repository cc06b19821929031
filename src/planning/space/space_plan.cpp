#include "planning/space/space_plan.h"

namespace mocha {

std::string outcome(const SpaceCandidate& candidate) {
  return candidate.violation ? describe(candidate.violation) : to_text(candidate.reason);
}

}  // namespace mocha
