#include "planning/way_out.h"

#include <algorithm>
#include <utility>

#include "planning/conflict.h"
#include "planning/evasion.h"
#include "safety/margin_budget.h"
#include "trajectory/stopping.h"

namespace mocha {
namespace {

constexpr double kWorthwhile_m = 0.02;  // of room, for which stepping aside is worth while

}  // namespace

WayOut::WayOut(const RobotModel& robot)
    : robot_(robot), hard_robot_(hardened(robot)), builder_(robot) {}

RobotModel WayOut::hardened(RobotModel robot) {
  robot.limits.max_acceleration =
      std::max(robot.limits.max_acceleration, PromiseBuilder(robot).hard_deceleration());
  return robot;
}

Motion WayOut::hard_stop(const Motion& committed, const Times& times) const {
  return with_brake(committed, committed.cut_time(times.now_s), times.emergency_s,
                    builder_.hard_deceleration());
}

std::vector<Motion> WayOut::evasions_from(const Motion& committed, const Times& times,
                                          const RobotModel& robot,
                                          const PromiseScene& scene) const {
  const double clear_m =
      robot.footprint.circumscribed_radius_m() + MarginBudget::of(robot).static_margin_m();
  return evasions(committed, times.settled_s, builder_.deceleration(), robot,
                  {*scene.obstacles, clear_m, builder_.kept_from(scene, times.now_s, 1.0),
                   scene.predicted_until_s});
}

std::optional<WayOut::Choice> WayOut::braking(const Motion& committed, const Times& times,
                                              const PromiseScene& scene) const {
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
  for (Motion& motion : evasions_from(committed, times, robot_, scene)) {
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
                                             const PromiseScene& scene) const {
  if (auto choice = braking(committed, times, scene)) return choice;
  if (auto choice = braking(committed, times, scene.most_likely())) return choice;
  if (auto choice = aside(committed, times, scene)) return choice;
  Motion stop = hard_stop(committed, times);
  if (builder_.certify_in_force(stop, scene, times.now_s)) return std::nullopt;
  return Choice{"brakes hard", std::move(stop), true, 0.0};
}

WayOut::Choice WayOut::least_bad(const Motion& committed, const Times& times,
                                 const PromiseScene& scene, bool something_moves,
                                 double until_s) const {
  const PromiseScene likely = scene.most_likely();
  const auto things = builder_.kept_from(likely, times.now_s, 1.0);
  const auto room_m = [&](const Motion& motion) {
    return least_room_m(motion, things, times.now_s, until_s);
  };
  Choice brake{"brakes at once all the same", hard_stop(committed, times), true, 0.0};
  if (!something_moves) return brake;
  const double brake_m = room_m(brake.motion);
  const double on_m = room_m(committed);
  // Where the bodies would meet all the same, they had better meet slowly.
  const double contact_m = -(MarginBudget::of(robot_).own_margin_m() + robot_.moving_clearance_m);
  PromiseScene still = likely;
  still.moving.clear();
  for (Motion& motion : evasions_from(committed, times, hard_robot_, likely)) {
    const Motion onward = continued(committed, times.now_s, times.settled_s, motion);
    if (builder_.certify(onward, still, times.now_s)) continue;
    if (room_m(onward) < std::max({brake_m, on_m, contact_m}) + kWorthwhile_m) break;
    return {"steps aside, which keeps the most room", std::move(motion), false, 0.0};
  }
  if (on_m > std::max(brake_m, contact_m))
    return {"goes on, which keeps more room than braking", {}, false, 0.0};
  return brake;
}

}  // namespace mocha
