#include "fleet/beat_datagrams.h"

#include <stdexcept>
#include <utility>

#include "fleet/wire_format.h"

namespace mocha {

std::vector<std::vector<std::uint8_t>> datagrams(const Beat& beat) {
  try {
    return {encode(beat)};
  } catch (const std::invalid_argument&) {
    if (beat.seen.size() <= 2) throw;
  }
  const auto middle = beat.seen.begin() + static_cast<std::ptrdiff_t>(beat.seen.size() / 2);
  Beat first = beat;
  Beat second = beat;
  first.seen.assign(beat.seen.begin(), middle);
  second.seen.assign(middle, beat.seen.end());
  auto bytes = datagrams(first);
  for (auto& each : datagrams(second)) bytes.push_back(std::move(each));
  return bytes;
}

}  // namespace mocha
