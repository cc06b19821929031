#include "planning/maneuvers/most_room.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "planning/candidates/exposure.h"
#include "planning/maneuvers/emergency_swerve.h"
#include "planning/maneuvers/sidestep.h"
#include "planning/maneuvers/weave.h"
#include "trajectory/splice.h"
#include "trajectory/stopping.h"
#include "world/margin_budget.h"

namespace mocha {
namespace {

constexpr double kWorthwhile_m = 0.02;  // of room, for which leaving the motion is worth while
constexpr double kEnough_m = 0.05;      // of room; of what has it, the one soonest done is the best
constexpr double kForeseen_s = 15.0;
// Bodies that would overlap by less than this may as well miss each other: no prediction is as good
// as that.
constexpr double kGraze_m = 0.15;

/// A team-mate that hears in time of what meets its promise: it goes on as promised, or brakes.
struct TeamMate {
  MovingThing goes_on;
  MovingThing brakes;
};

/// How much room the motions in hand keep.
class Room {
 public:
  explicit Room(const ManeuverStart& start)
      : start_(start),
        things_(exposed_to(start, start.now_s)),
        team_mates_(taken_from(things_, start)),
        brake_m_(of(with_brake(start.committed, start.now_s, start.emergency_s,
                               start.robot.hard_braking()))),
        on_m_(of(start.committed)),
        contact_m_(-(MarginBudget::of(start.robot).own_margin_m() + start.robot.moving_clearance_m +
                     kGraze_m)) {}

  double of(const Motion& motion) const { return of(motion, -1e9); }
  double of(const Motion& motion, double of_no_use_m) const {
    const auto to = [&](const std::vector<MovingThing>& things) {
      return least_room_m(motion, things, start_.now_s, start_.now_s + kForeseen_s, of_no_use_m);
    };
    double least_m = to(things_);
    for (const TeamMate& each : team_mates_) {
      const double goes_on_m = to({each.goes_on});
      if (goes_on_m < least_m) least_m = std::min(least_m, std::max(goes_on_m, to({each.brakes})));
    }
    return least_m;
  }
  /// Where the bodies would meet whatever the robot does, they had better meet slowly.
  double to_beat_m() const { return std::max({brake_m_, on_m_, contact_m_}) + kWorthwhile_m; }
  bool going_on_is_better() const { return on_m_ > std::max(brake_m_ + kWorthwhile_m, contact_m_); }

 private:
  /// Takes them out of `things`.
  static std::vector<TeamMate> taken_from(std::vector<MovingThing>& things,
                                          const ManeuverStart& start);

  const ManeuverStart& start_;
  std::vector<MovingThing> things_;  // that promise nothing, or will not brake any more
  const std::vector<TeamMate> team_mates_;
  const double brake_m_;
  const double on_m_;
  const double contact_m_;
};

std::vector<TeamMate> Room::taken_from(std::vector<MovingThing>& things,
                                       const ManeuverStart& start) {
  std::vector<TeamMate> team_mates;
  std::vector<MovingThing> others;
  const double hears_s = start.now_s + start.robot.peer_reaction_s;
  for (const MovingThing& thing : things) {
    const auto promised = thing.obstacle->promised();
    if (!promised || thing.obstacle->rest_time() <= hears_s) {
      others.push_back(thing);
      continue;
    }
    const MotionOrFault stop = try_brake(promised->motion, start.now_s, hears_s, promised->braking);
    if (!stop) {
      others.push_back(thing);
      continue;
    }
    MovingThing brakes = thing;
    brakes.obstacle = std::make_shared<PeerObstacle>(
        thing.obstacle->name(), std::make_shared<const Motion>(stop.motion),
        thing.obstacle->at(start.now_s).radius_m, promised->braking);
    team_mates.push_back({thing, std::move(brakes)});
  }
  things = std::move(others);
  return team_mates;
}

struct Escape {
  double room_m;  ///< enough is enough
  double end_s;
  Maneuver maneuver;
};

}  // namespace

Maneuvers most_room(const ManeuverStart& start) {
  const Room room(start);
  Maneuvers all = hard_sidesteps(start);
  for (Maneuver& each : emergency_swerves(start)) all.push_back(std::move(each));
  for (Maneuver& each : ways_out(start)) all.push_back(std::move(each));
  std::vector<Escape> escapes;
  for (Maneuver& each : all) {
    const auto onward = splice(start.committed, start.now_s, each.join_s, each.motion);
    if (!onward) continue;
    const double room_m = room.of(onward.motion, room.to_beat_m());
    if (room_m < room.to_beat_m()) continue;
    escapes.push_back({std::min(room_m, kEnough_m), onward.motion.end_time(), std::move(each)});
  }
  std::stable_sort(escapes.begin(), escapes.end(), [](const Escape& a, const Escape& b) {
    return a.room_m != b.room_m ? a.room_m > b.room_m : a.end_s < b.end_s;
  });
  Maneuvers maneuvers;
  for (Escape& escape : escapes) maneuvers.push_back(std::move(escape.maneuver));
  return maneuvers;
}

Maneuvers last_resort(const ManeuverStart& start) {
  const bool stands = start.committed.end_time() <= start.now_s;
  if (stands || Room(start).going_on_is_better()) return {};
  return {whole(rest_of(with_brake(start.committed, start.now_s, start.emergency_s,
                                   start.robot.hard_braking()),
                        start.emergency_s),
                start.emergency_s, true, "brakes all the same")};
}

}  // namespace mocha
