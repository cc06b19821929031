#pragma once

#include <cstdint>
#include <map>

#include "trajectory/motion.h"

namespace mocha {

/// A motion to take over from the one in force at its start time once it is settled with the peers,
/// or at once. It is rounded as all others will hear it.
struct ProposedMotion {
  std::uint32_t sequence;
  Motion motion;
  bool emergency;
};

/// What a promise was made from.
struct PromiseSource {
  std::uint32_t plan = 0;        ///< 0: none
  double follows_until_s = 0.0;  ///< absolute
};

/// Numbers a robot's proposals, and knows which of them is still to be answered.
class Proposals {
 public:
  /// A proposal without answer is given up after `answer_timeout_s`.
  explicit Proposals(double answer_timeout_s) : answer_timeout_s_(answer_timeout_s) {}

  /// The next one, which supersedes what was pending. `brakes`: it brakes for a violation.
  ProposedMotion make(double now_s, Motion motion, bool emergency, const PromiseSource& source,
                      bool brakes);
  /// That number is in force now. What it was made from; nothing where it was not made here, as
  /// after a restart. Own numbers go on after it.
  PromiseSource settled(std::uint32_t sequence);
  void refused(std::uint32_t sequence);

  bool pending(double now_s) const { return now_s < pending_until_s_; }
  /// What is pending, or was last.
  const Motion& newest() const { return newest_; }
  bool newest_brakes() const { return newest_brakes_; }
  /// What it was made from.
  const PromiseSource& newest_source() const { return newest_source_; }

 private:
  const double answer_timeout_s_;
  std::uint32_t sequence_ = 0;
  std::map<std::uint32_t, PromiseSource> sources_;  // by sequence, until answered
  double pending_until_s_ = 0.0;
  Motion newest_;
  PromiseSource newest_source_;
  bool newest_brakes_ = false;
};

}  // namespace mocha
