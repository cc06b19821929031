#pragma once

#include "planning/candidates/drive_options.h"

namespace mocha {

/// Weights and sizes of local planning; each stands with unit, range and default in
/// config/local_replanner.yaml.
struct LocalOptions : DriveOptions {
  double weight_delay;
  double mu_s;         ///< how far ahead on the plan the rejoin point stands
  double t_epsilon_s;  ///< paper (42): a local drive that takes longer wants a new global plan
  int samples;         ///< of the roadmap in space-time
  int classes;
  double longest_ratio;
  double switch_margin;
  double switch_gain;
  double smooth_start_rad;
  int threads;

  static LocalOptions from(const ParameterTable& values);
};

}  // namespace mocha
