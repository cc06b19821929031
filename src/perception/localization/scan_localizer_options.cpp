#include "perception/localization/scan_localizer_options.h"

namespace mocha {
namespace {

// More than is likely: a place that is not looked for far enough away may be taken for another one.
constexpr double kSlip = 0.1;

}  // namespace

ScanLocalizerOptions ScanLocalizerOptions::from(const ParameterTable& values,
                                                const RobotModel& model) {
  ScanLocalizerOptions options;
  options.hits = values.integer("hits");
  // The faces of a map that is only being made are not worn yet.
  options.wall_depth_m = values.flag("mapping") ? 0.0 : values.number("wall_depth");
  options.matcher.hit_noise_m = values.number("hit_noise");
  options.matcher.hit_reach_m = values.number("hit_reach");
  options.matcher.independent_hits = values.integer("independent_hits");
  options.tolerance_m = values.number("tolerance");
  options.least_hits = values.integer("least_hits");
  options.places.good_quality = values.number("good_quality");
  options.places.poor_quality = values.number("poor_quality");
  options.places.rivalry = values.number("rivalry");
  options.trial_s = values.number("trial_time");
  options.search_interval_s = values.number("search_interval");
  options.search_budget = values.integer("search_budget");
  options.max_sigma_m = values.number("max_sigma");
  options.max_sigma_yaw_rad = values.number("max_sigma_yaw");
  options.max_speed = model.limits.max_speed;
  options.odometry = OdometryNoise(model, kSlip);
  return options;
}

}  // namespace mocha
