#include "ros_bridge/rviz/local_drawing.h"

#include <vector>

namespace mocha {
namespace {

constexpr double kTimeStep_s = 0.1;
constexpr double kRejoinPoint_m = 0.3;
constexpr float kFaint = 0.7F;
constexpr std::size_t kFirstColor = 5;  // another than that of the best global way

std::vector<Vector2> drawn_swerve(const PlanCandidate& candidate) {
  std::vector<Vector2> places;
  for (double t = candidate.motion.start_time(); t < candidate.drive_ends_s; t += kTimeStep_s)
    places.push_back(candidate.motion.position(t));
  places.push_back(candidate.motion.position(candidate.drive_ends_s));
  return places;
}

}  // namespace

void draw_local_plan(const LocalPlan& plan, Drawing& drawing) {
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const PlanCandidate& candidate = plan.candidates[i];
    std_msgs::ColorRGBA own = class_color(kFirstColor + i);
    if (candidate.selected) drawing.add_line("detour", drawn_swerve(candidate), 0.07, own, false);
    own.a = kFaint;
    drawing.add_line("local paths", evenly(candidate.path), 0.03, own, true);
  }
  if (plan.reason == PlanReason::kSolved)
    drawing.add_square("rejoin point", plan.rejoin_point.place(), kRejoinPoint_m,
                       color(0.9, 0.05, 0.05));
}

}  // namespace mocha
