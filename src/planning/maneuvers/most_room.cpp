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

/// How much room the motions in hand keep.
class Room {
 public:
  explicit Room(const ManeuverStart& start)
      : start_(start),
        things_(exposed_to(start, start.now_s)),
        brake_m_(of(with_brake(start.committed, start.now_s, start.emergency_s,
                               start.robot.hard_braking()))),
        on_m_(of(start.committed)),
        contact_m_(-(MarginBudget::of(start.robot).own_margin_m() + start.robot.moving_clearance_m +
                     kGraze_m)) {}

  double of(const Motion& motion) const { return of(motion, -1e9); }
  double of(const Motion& motion, double of_no_use_m) const {
    return least_room_m(motion, things_, start_.now_s, start_.now_s + kForeseen_s, of_no_use_m);
  }
  /// Where the bodies would meet whatever the robot does, they had better meet slowly.
  double to_beat_m() const { return std::max({brake_m_, on_m_, contact_m_}) + kWorthwhile_m; }
  bool going_on_is_better() const { return on_m_ > std::max(brake_m_ + kWorthwhile_m, contact_m_); }

 private:
  const ManeuverStart& start_;
  const std::vector<MovingThing> things_;
  const double brake_m_;
  const double on_m_;
  const double contact_m_;
};

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
