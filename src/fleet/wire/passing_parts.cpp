#include "fleet/wire/passing_parts.h"

#include <string>

#include "fleet/wire/message_fields.h"
#include "fleet/wire/wire_format.h"

namespace mocha {

PassingInstruction quantised(PassingInstruction instruction) {
  for (PassingTurn& turn : instruction.part) {
    for (Vector2& place : turn.path) place = place_of(counts_of(place));
  }
  return instruction;
}

PassingInstruction fitting_part(const PassingInstruction& whole, std::uint32_t first) {
  require_said(first >= whole.first && first - whole.first <= whole.part.size(),
               "there is no turn " + std::to_string(first));
  const auto from = whole.part.begin() + (first - whole.first);
  PassingInstruction part = whole;
  part.first = first;
  part.part.assign(from, whole.part.end());
  if (fits(part)) return part;
  auto fitting = from;
  for (auto most = whole.part.end(); fitting != most;) {
    const auto tried = most - (most - fitting) / 2;
    part.part.assign(from, tried);
    if (fits(part)) {
      fitting = tried;
    } else {
      most = tried - 1;
    }
  }
  part.part.assign(from, fitting);
  return part;
}

}  // namespace mocha
