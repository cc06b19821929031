#include "fleet/wire/replay_guard.h"

#include <algorithm>
#include <bitset>

namespace mocha {

bool ReplayGuard::take(std::uint32_t epoch, std::uint32_t number) {
  if (epoch < epoch_) return false;
  if (epoch > epoch_ || watched_ == 0) {
    epoch_ = epoch;
    newest_ = number;
    watched_ = 1;
    came_ = 1;
    return true;
  }
  if (number > newest_) {
    const std::uint32_t step = number - newest_;
    came_ = step < kWindow ? came_ << step | 1 : 1;
    watched_ = step < kWindow ? std::min(kWindow, watched_ + step) : kWindow;
    newest_ = number;
    return true;
  }
  const std::uint32_t behind = newest_ - number;
  if (behind >= kWindow || (came_ >> behind & 1) != 0) return false;
  came_ |= std::uint64_t{1} << behind;
  watched_ = std::max(watched_, behind + 1);
  return true;
}

double ReplayGuard::loss() const {
  if (watched_ == 0) return 0.0;
  return 1.0 - static_cast<double>(std::bitset<kWindow>(came_).count()) / watched_;
}

}  // namespace mocha
