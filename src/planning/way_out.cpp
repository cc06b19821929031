#include "planning/way_out.h"

#include <algorithm>
#include <string>
#include <utility>

#include "planning/conflict.h"
#include "planning/dodge.h"
#include "planning/evasion.h"
#include "safety/margin_budget.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kWorthwhile_m = 0.02;  // of room, for which stepping aside is worth while
constexpr double kEnough_m = 0.05;      // of room; of what has it, the one soonest done is the best
// So far ahead an escape looks at who is in the way: to step straight back is to be met again soon,
// to step aside is not.
constexpr double kForeseen_s = 15.0;
// Bodies that would overlap by less than this may as well miss each other: no prediction is as good
// as that.
constexpr double kGraze_m = 0.15;
constexpr double kBrakingOvershoot = 1.15;  // of a braking motion over its deceleration
constexpr double kAlone_m = 5.0;  // what two robots drive towards each other in a few seconds

}  // namespace

WayOut::WayOut(const RobotModel& robot)
    : robot_(robot),
      hard_robot_(hardened(robot)),
      escape_limits_(hard_robot_.limits),
      builder_(robot) {
  escape_limits_.max_acceleration *= kBrakingOvershoot;
}

RobotModel WayOut::hardened(RobotModel robot) {
  robot.limits.max_acceleration =
      std::max(robot.limits.max_acceleration, PromiseBuilder(robot).hard_deceleration());
  return robot;
}

Motion WayOut::hard_stop(const Motion& committed, const Times& times) const {
  return with_brake(committed, committed.cut_time(times.now_s), times.emergency_s,
                    builder_.hard_deceleration());
}

std::vector<Motion> WayOut::evasions_from(const Motion& committed, double start_time_s,
                                          double deceleration, const RobotModel& robot,
                                          const PromiseScene& scene) const {
  const double clear_m =
      robot.footprint.circumscribed_radius_m() + MarginBudget::of(robot).static_margin_m();
  return evasions(committed, start_time_s, deceleration, robot,
                  {*scene.obstacles, clear_m, looked_at(committed, start_time_s, scene),
                   start_time_s + kForeseen_s});
}

std::vector<MovingThing> WayOut::looked_at(const Motion& committed, double from_s,
                                           const PromiseScene& scene) const {
  const Motion stop =
      with_brake(committed, committed.cut_time(from_s), from_s, builder_.hard_deceleration());
  std::vector<MovingThing> things = builder_.kept_from(scene, from_s, 1.0);
  const std::vector<MovingThing> for_good = foreseen(things);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const auto meets = [&](const Motion& motion) {
      return least_room_m(motion, {things[i]}, from_s, scene.predicted_until_s, 0.0) < 0.0;
    };
    if (meets(committed) || meets(stop)) things[i] = for_good[i];
  }
  return things;
}

/// No team-mate is so near that it could be about to promise, unheard yet, what an emergency takes.
bool WayOut::is_alone(const Motion& committed, const Times& times,
                      const PromiseScene& scene) const {
  const Vector2 place = committed.position(times.now_s);
  return std::all_of(scene.others.begin(), scene.others.end(), [&](const auto& other) {
    return (other->at(times.now_s).centre - place).norm() > kAlone_m;
  });
}

std::optional<WayOut::Choice> WayOut::braking(const Motion& committed, const Times& times,
                                              const PromiseScene& scene, bool soon) const {
  if (soon) {
    // Late braking leaves nothing to somebody who then comes faster than he was expected to.
    const bool emergency = is_alone(committed, times, scene);
    const double brake_s = emergency ? times.emergency_s : times.settled_s;
    Motion stop =
        with_brake(committed, committed.cut_time(times.now_s), brake_s, builder_.deceleration());
    if (!builder_.certify(stop, scene, times.now_s)) {
      if (!emergency) stop = remainder(stop, brake_s);
      return Choice{"brakes", std::move(stop), emergency, brake_s};
    }
  }
  const auto safe =
      builder_.longest(committed, scene, times.now_s, times.emergency_s, committed.end_time());
  if (!safe) return std::nullopt;
  const bool time_to_settle = safe->follows_until_s > times.settled_s;
  return Choice{"brakes in time",
                time_to_settle ? remainder(safe->motion, times.settled_s) : safe->motion,
                !time_to_settle, safe->follows_until_s};
}

std::optional<WayOut::Choice> WayOut::aside_in(const Motion& committed, const Times& times,
                                               const PromiseScene& scene) const {
  for (Motion& motion :
       evasions_from(committed, times.settled_s, builder_.deceleration(), robot_, scene)) {
    const Motion onward = continued(committed, times.now_s, times.settled_s, motion);
    if (builder_.certify(onward, scene, times.now_s)) continue;
    return Choice{"steps aside", std::move(motion), false, 0.0};
  }
  return std::nullopt;
}

std::optional<WayOut::Choice> WayOut::aside(const Motion& committed, const Times& times,
                                            const PromiseScene& scene) const {
  auto choice = aside_in(committed, times, scene);
  return choice ? choice : aside_in(committed, times, scene.most_likely());
}

std::optional<WayOut::Choice> WayOut::proved(const Motion& committed, const Times& times,
                                             const PromiseScene& scene,
                                             bool something_moves) const {
  if (auto choice = braking(committed, times, scene, something_moves)) return choice;
  if (auto choice = braking(committed, times, scene.most_likely(), something_moves)) return choice;
  if (auto choice = aside(committed, times, scene)) return choice;
  Motion stop = hard_stop(committed, times);
  if (builder_.certify_in_force(stop, scene, times.now_s)) return std::nullopt;
  return Choice{"brakes hard", std::move(stop), true, 0.0};
}

/// All that is left but braking and going on.
std::vector<WayOut::Choice> WayOut::escapes(const Motion& committed, const Times& times,
                                            const PromiseScene& likely) const {
  std::vector<Choice> choices;
  const auto add = [&](std::vector<Motion> motions, const std::string& what, bool emergency) {
    for (Motion& motion : motions) choices.push_back({what, std::move(motion), emergency, 0.0});
  };
  const std::string aside = "steps aside, which keeps the most room";
  add(evasions_from(committed, times.settled_s, builder_.deceleration(), hard_robot_, likely),
      aside, false);
  if (is_alone(committed, times, likely)) {
    add(evasions_from(committed, times.emergency_s, builder_.hard_deceleration(), hard_robot_,
                      likely),
        aside, true);
    add(dodges(committed, times.emergency_s, hard_robot_.limits),
        "dodges, which keeps the most room", true);
  }
  return choices;
}

WayOut::Choice WayOut::least_bad(const Motion& committed, const Times& times,
                                 const PromiseScene& scene, bool something_moves) const {
  const PromiseScene likely = scene.most_likely();
  const auto things = looked_at(committed, times.now_s, likely);
  const double until_s = times.now_s + kForeseen_s;
  Choice brake{"brakes at once all the same", hard_stop(committed, times), true, 0.0};
  if (!something_moves) return brake;
  const double brake_m = least_room_m(brake.motion, things, times.now_s, until_s);
  const double on_m = least_room_m(committed, things, times.now_s, until_s);
  // Where the bodies would meet whatever it does, they had better meet slowly.
  const double contact_m =
      -(MarginBudget::of(robot_).own_margin_m() + robot_.moving_clearance_m + kGraze_m);
  const double to_beat_m = std::max({brake_m, on_m, contact_m}) + kWorthwhile_m;
  struct Escape {
    double room_m;  ///< enough is enough
    Motion onward;
    Choice choice;
  };
  std::vector<Escape> escapes;
  for (Choice& choice : this->escapes(committed, times, likely)) {
    Motion onward = continued(committed, times.now_s, choice.motion.start_time(), choice.motion);
    const double room_m = least_room_m(onward, things, times.now_s, until_s, to_beat_m);
    if (room_m < to_beat_m) continue;
    escapes.push_back({std::min(room_m, kEnough_m), std::move(onward), std::move(choice)});
  }
  std::stable_sort(escapes.begin(), escapes.end(), [](const Escape& a, const Escape& b) {
    return a.room_m != b.room_m ? a.room_m > b.room_m : a.onward.end_time() < b.onward.end_time();
  });
  PromiseScene still = likely;
  still.moving.clear();
  for (Escape& escape : escapes) {
    if (builder_.certify(escape.onward, still, times.now_s)) continue;
    if (check_limits(escape.choice.motion, escape_limits_, escape.choice.motion.start_time()))
      continue;
    return std::move(escape.choice);
  }
  if (on_m > std::max(brake_m + kWorthwhile_m, contact_m))
    return {"goes on, which keeps more room than braking", {}, false, 0.0};
  return brake;
}

}  // namespace mocha
