#include "fleet/promise_chain.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "trajectory/separation.h"

namespace mocha {
namespace {

constexpr double kTolerance_m = 0.005;  // of a distance that is only reported

}  // namespace

Claim claim_of(const Promise& proposal) { return {proposal, proposal.motion->start_time()}; }

std::optional<Conflict> first_conflict(const Claim& mine, const Claim& theirs, double required_m,
                                       double now) {
  const double from = std::max({mine.from_s, theirs.from_s, now});
  const double until = std::min(mine.until_s, theirs.until_s);
  if (from >= until) return std::nullopt;
  const Motion& own = *mine.promise.motion;
  const Motion& other = *theirs.promise.motion;
  const auto time = first_time_closer_than(own, other, required_m, from, until);
  if (!time) return std::nullopt;
  const Vector2 place = own.position(*time);
  const double distance = closest_approach(own, other, *time, until, kTolerance_m).distance_m;
  return Conflict{theirs.promise.agent, *time, distance, required_m, place};
}

void PromiseChain::bind(Promise promise) {
  const double start = promise.motion->start_time();
  while (!promises_.empty() && promises_.back().motion->start_time() >= start) {
    promises_.pop_back();
  }
  promises_.push_back(std::move(promise));
}

void PromiseChain::reclock(double later_s, double less_sure_s) {
  for (Promise& promise : promises_) promise = reclocked(promise, later_s, less_sure_s);
}

void PromiseChain::prune(double now) {
  const auto later =
      std::find_if(promises_.begin(), promises_.end(),
                   [now](const Promise& promise) { return promise.motion->start_time() > now; });
  if (later - promises_.begin() > 1) promises_.erase(promises_.begin(), later - 1);
}

std::vector<Claim> PromiseChain::claims() const {
  std::vector<Claim> claims;
  for (const Promise& promise : promises_) {
    Claim claim;
    claim.promise = promise;
    if (!claims.empty()) {
      claim.from_s = promise.motion->start_time();
      claims.back().until_s = claim.from_s;
    }
    claims.push_back(std::move(claim));
  }
  return claims;
}

std::shared_ptr<const Motion> PromiseChain::composed(double now) const {
  if (promises_.size() == 1) return newest().motion;
  try {
    const Motion& first = *promises_.front().motion;
    const double begin = std::max(first.cut_time(now), first.start_time());
    std::vector<Phase> phases;
    for (const Claim& claim : claims()) {
      const Motion& motion = *claim.promise.motion;
      const double from = std::max(begin, claim.from_s);
      const double until = std::min(claim.until_s, std::max(from, motion.end_time()));
      for (Phase& phase : motion.phases_between(from, until)) phases.push_back(std::move(phase));
      const bool waits =
          claim.until_s > until && claim.until_s < std::numeric_limits<double>::infinity();
      if (waits) phases.emplace_back(StandPhase{motion.end_pose(), claim.until_s - until});
    }
    return std::make_shared<const Motion>(begin, std::move(phases));
  } catch (const std::invalid_argument&) {
    return newest().motion;
  }
}

Vector2 PromiseChain::position(double t) const {
  const Promise* in_force = &promises_.front();
  for (const Promise& promise : promises_) {
    if (promise.motion->start_time() <= t) in_force = &promise;
  }
  return in_force->motion->at(t).pose.position;
}

}  // namespace mocha
