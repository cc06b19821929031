#include "fleet/protocol/reservation_chain.h"

#include <algorithm>
#include <utility>

#include "trajectory/separation.h"
#include "trajectory/splice.h"

namespace mocha {
namespace {

constexpr double kTolerance_m = 0.005;  // of a distance that is only reported

/// Makes one claim of two that follow each other; false where their motions do not join.
bool append(Reservation& reservation, const Reservation& next, double now) {
  const Motion& first = *reservation.trajectory.motion;
  const double switch_s = std::max({now, first.start_time(), next.from_s});
  MotionOrFault joined = splice(first, now, switch_s, *next.trajectory.motion);
  if (!joined) return false;
  const double radius_m =
      std::max(reservation.trajectory.footprint_radius_m, next.trajectory.footprint_radius_m);
  reservation.trajectory = next.trajectory;
  reservation.trajectory.motion = std::make_shared<const Motion>(std::move(joined.motion));
  reservation.trajectory.footprint_radius_m = radius_m;
  reservation.until_s = next.until_s;
  return true;
}

}  // namespace

Reservation reservation_of(const CommittedTrajectory& proposal) {
  return {proposal, proposal.motion->start_time()};
}

std::optional<Conflict> first_conflict(const Reservation& mine, const Reservation& theirs,
                                       double required_m, double now) {
  const double from = std::max({mine.from_s, theirs.from_s, now});
  const double until = std::min(mine.until_s, theirs.until_s);
  if (from >= until) return std::nullopt;
  const Motion& own = *mine.trajectory.motion;
  const Motion& other = *theirs.trajectory.motion;
  const auto time = first_time_closer_than(own, other, required_m, from, until);
  if (!time) return std::nullopt;
  const Vector2 place = own.position(*time);
  const double distance = closest_approach(own, other, *time, until, kTolerance_m).distance_m;
  return Conflict{theirs.trajectory.agent, *time, distance, required_m, place};
}

bool ReservationChain::bind(CommittedTrajectory trajectory) {
  const double start = trajectory.motion->start_time();
  const auto later = std::find_if(reservations_.begin(), reservations_.end(),
                                  [&trajectory](const Reservation& reservation) {
                                    return trajectory.id < reservation.trajectory.id;
                                  });
  if (later != reservations_.end() && later->trajectory.motion->start_time() <= start) return false;
  const auto replaced =
      std::find_if(reservations_.begin(), later, [start](const Reservation& reservation) {
        return reservation.trajectory.motion->start_time() >= start;
      });
  reservations_.insert(reservations_.erase(replaced, later), {std::move(trajectory)});
  join();
  return true;
}

bool ReservationChain::holds(TrajectoryId id) const {
  return std::any_of(
      reservations_.begin(), reservations_.end(),
      [id](const Reservation& reservation) { return reservation.trajectory.id == id; });
}

void ReservationChain::reclock(double later_s) {
  for (Reservation& reservation : reservations_)
    reservation.trajectory = reclocked(reservation.trajectory, later_s);
  join();
}

void ReservationChain::prune(double now) {
  const auto later = std::find_if(reservations_.begin(), reservations_.end(),
                                  [now](const Reservation& reservation) {
                                    return reservation.trajectory.motion->start_time() > now;
                                  });
  if (later - reservations_.begin() <= 1) return;
  reservations_.erase(reservations_.begin(), later - 1);
  join();
}

/// Each reservation ends where the next one begins.
void ReservationChain::join() {
  constexpr double kForever_s = std::numeric_limits<double>::infinity();
  double from_s = -kForever_s;
  for (std::size_t i = 0; i < reservations_.size(); ++i) {
    const bool last = i + 1 == reservations_.size();
    reservations_[i].from_s = from_s;
    from_s = reservations_[i].until_s =
        last ? kForever_s : reservations_[i + 1].trajectory.motion->start_time();
  }
}

std::vector<Reservation> ReservationChain::parts(double now) const {
  std::vector<Reservation> parts;
  for (const Reservation& reservation : reservations_) {
    if (!parts.empty() && append(parts.back(), reservation, now)) continue;
    parts.push_back(reservation);
  }
  return parts;
}

std::shared_ptr<const Motion> ReservationChain::composed(double now) const {
  return parts(now).back().trajectory.motion;
}

Eigen::AlignedBox2d ReservationChain::box(double now) const {
  Eigen::AlignedBox2d box;
  for (const Reservation& part : parts(now))
    box.extend(rest_of(*part.trajectory.motion, now).box());
  return box;
}

Vector2 ReservationChain::position(double t) const {
  const auto in_force =
      std::find_if(reservations_.begin(), reservations_.end() - 1,
                   [t](const Reservation& reservation) { return t < reservation.until_s; });
  return in_force->trajectory.motion->position(t);
}

}  // namespace mocha
