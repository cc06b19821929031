#include "planning/executive/yield_policy.h"

#include "planning/global/front_end.h"

namespace mocha {
namespace {

constexpr double kLookPeriod_s = 0.25;
constexpr double kNear_m = 1.0;       // a team-mate this near beside the way may come into it again
constexpr double kOnMotion_m = 0.5;   // a robot farther off its motion drives something else
constexpr double kSamePlace_m = 0.5;  // of the end of a motion and where the robot wants to be
constexpr double kSampleSpeed_mps = 1.0;

}  // namespace

void YieldPolicy::set_options(const PlannerOptions& options, double tolerance_m) {
  yielding_.set_options(options);
  tolerance_m_ = tolerance_m;
}

void YieldPolicy::begin_goal(bool parked) {
  yielding_.set_parked(parked);
  yielding_.set_stuck(false);
  begin_path();
}

bool YieldPolicy::due(double now_s) {
  if (now_s < looked_s_ + kLookPeriod_s) return false;
  looked_s_ = now_s;
  return true;
}

std::optional<Rank> YieldPolicy::in_way_of(const RobotIntent& intent, double now_s) const {
  if (intent.pull_over) return yielding_.in_way_of(intent.pull_over->position, now_s);
  if (intent.motion) return yielding_.in_way_of(*intent.motion, now_s);
  return yielding_.in_way_of(intent.state.pose.position, now_s);
}

std::optional<YieldAdvice> YieldPolicy::advise(const RobotIntent& intent, const Vector2& stop,
                                               const SceneSource& scene, double now_s) const {
  if (intent.pull_over && !yielding_.yields(now_s))
    return YieldAdvice{ExecutiveEvent::kWayIsClear, std::nullopt};
  const auto whose = in_way_of(intent, now_s);
  if (!whose) return std::nullopt;
  return pull_over(*whose, intent.pull_over, stop, scene, now_s);
}

std::optional<YieldAdvice> YieldPolicy::pull_over(const Rank& whose,
                                                  const std::optional<PullOverPoint>& present,
                                                  const Vector2& stop, const SceneSource& scene,
                                                  double now_s) const {
  const auto place = yielding_.pull_over_point(stop, scene({stop}), now_s);
  if (!place) return YieldAdvice{ExecutiveEvent::kNowhereToPullOver, std::nullopt};
  if (present && (*place - present->position).norm() < tolerance_m_) return std::nullopt;
  const bool here = (*place - stop).norm() <= tolerance_m_;
  return YieldAdvice{here ? ExecutiveEvent::kPullOverHere : ExecutiveEvent::kPullOver,
                     PullOverPoint{*place, whose}};
}

/// The way of the motion that is being driven there, or else that on the map.
std::vector<Vector2> YieldPolicy::wanted_path(const RobotIntent& intent, const Vector2& there,
                                              const PlanningScene& scene, double now_s) const {
  const Vector2& here = intent.state.pose.position;
  const bool on_motion = intent.motion &&
                         (intent.motion->position(now_s) - here).norm() < kOnMotion_m &&
                         (intent.motion->end_pose().position - there).norm() < kSamePlace_m;
  if (!on_motion) return yielding_.path(here, there, scene);
  std::vector<Vector2> path = path_of(*intent.motion, now_s, kSampleSpeed_mps);
  path.insert(path.begin(), here);
  return path;
}

std::optional<YieldRequest> YieldPolicy::ask(const RobotIntent& intent, const Vector2& there,
                                             const SceneSource& scene, double now_s) {
  if (!asking_.due(now_s, stands(intent.state))) return std::nullopt;
  const Vector2& here = intent.state.pose.position;
  const PlanningScene around = scene({here, there});
  const std::vector<Vector2> path = wanted_path(intent, there, around, now_s);
  const bool on_it = yielding_.is_near(path, around, now_s, 0.0);
  const bool near_it = yielding_.is_near(path, around, now_s, kNear_m);
  if (!asking_.look(now_s, on_it, near_it) || path.empty()) return std::nullopt;
  // The robot that made this one pull over may need the way no more, while another does.
  const auto in_way_of = yielding_.in_way_of(here, now_s);
  return yielding_.request_for(path, in_way_of ? *in_way_of : yielding_.own());
}

std::optional<YieldRequest> YieldPolicy::withdrawal() {
  if (!asking_.take_withdrawal()) return std::nullopt;
  return yielding_.request_for({}, yielding_.own());
}

}  // namespace mocha
