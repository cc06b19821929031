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
  while (!claims_.empty() && newest().motion->start_time() >= start) claims_.pop_back();
  claims_.push_back({std::move(promise)});
  join();
}

void PromiseChain::reclock(double later_s, double less_sure_s) {
  for (Claim& claim : claims_) claim.promise = reclocked(claim.promise, later_s, less_sure_s);
  join();
}

void PromiseChain::prune(double now) {
  const auto later = std::find_if(claims_.begin(), claims_.end(), [now](const Claim& claim) {
    return claim.promise.motion->start_time() > now;
  });
  if (later - claims_.begin() <= 1) return;
  claims_.erase(claims_.begin(), later - 1);
  join();
}

/// Each claim ends where the next one begins.
void PromiseChain::join() {
  constexpr double kForever_s = std::numeric_limits<double>::infinity();
  double from_s = -kForever_s;
  for (std::size_t i = 0; i < claims_.size(); ++i) {
    const bool last = i + 1 == claims_.size();
    claims_[i].from_s = from_s;
    from_s = claims_[i].until_s = last ? kForever_s : claims_[i + 1].promise.motion->start_time();
  }
}

std::shared_ptr<const Motion> PromiseChain::composed(double now) const {
  if (claims_.size() == 1) return newest().motion;
  try {
    const Motion& first = *claims_.front().promise.motion;
    const double begin = std::max(first.cut_time(now), first.start_time());
    std::vector<Phase> phases;
    for (const Claim& claim : claims_) {
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
  const auto in_force = std::find_if(claims_.begin(), claims_.end() - 1,
                                     [t](const Claim& claim) { return t < claim.until_s; });
  return in_force->promise.motion->position(t);
}

}  // namespace mocha
