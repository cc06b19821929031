#include "planning/local/local_options.h"

namespace mocha {

LocalOptions LocalOptions::from(const ParameterTable& values) {
  LocalOptions options;
  static_cast<DriveOptions&>(options) = DriveOptions::from(values);
  options.open_knot_spacing_m = options.knot_spacing_m;  // the paths have times
  options.weight_delay = values.number("weight_delay");
  options.mu_s = values.number("rejoin_horizon");
  options.t_epsilon_s = values.number("longest_local_drive");
  options.samples = values.integer("samples");
  options.classes = values.integer("classes");
  options.longest_ratio = values.number("longest_ratio");
  options.switch_margin = values.number("switch_margin");
  options.switch_gain = values.number("switch_gain");
  options.smooth_start_rad = values.number("smooth_start");
  options.threads = values.integer("planning_threads");
  return options;
}

}  // namespace mocha
