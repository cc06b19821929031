#include "planning/replanner/proposals.h"

#include <algorithm>
#include <utility>

namespace mocha {

ProposedMotion Proposals::make(double now_s, Motion motion, bool emergency,
                               const PromiseSource& source, bool brakes) {
  ++sequence_;
  sources_[sequence_] = source;
  pending_until_s_ = now_s + answer_timeout_s_;
  newest_ = motion;
  newest_source_ = source;
  newest_brakes_ = brakes;
  return {sequence_, std::move(motion), emergency};
}

PromiseSource Proposals::settled(std::uint32_t sequence) {
  const auto found = sources_.find(sequence);
  const PromiseSource source = found == sources_.end() ? PromiseSource{} : found->second;
  sources_.erase(sources_.begin(), sources_.upper_bound(sequence));
  if (sequence >= sequence_) pending_until_s_ = 0.0;
  sequence_ = std::max(sequence_, sequence);
  return source;
}

void Proposals::refused(std::uint32_t sequence) {
  sources_.erase(sequence);
  if (sequence == sequence_) pending_until_s_ = 0.0;
}

}  // namespace mocha
