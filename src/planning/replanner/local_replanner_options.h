#pragma once

#include "config/parameter_table.h"
#include "world/robot_model.h"
#include "world/speed_margin.h"

namespace mocha {

/// Times and bounds of the local replanner; each stands in config/local_replanner.yaml.
struct LocalReplannerOptions {
  double settle_s;          ///< a proposal made now is binding after this time
  double emergency_s;       ///< the same for an emergency motion
  double horizon_s;         ///< promises reach about this far, then brake
  double extend_every_s;    ///< a promise is extended when this much of its horizon is used up
  double answer_timeout_s;  ///< a proposal without answer is given up after this time
  SpeedMargin max_error;    ///< actual against promised position, under way
  double max_standing_error_m;
  double max_error_rad;    ///< the same for the heading
  double mu_pre_s;         ///< paper (37): so far ahead the plan is held against what moves
  double promise_reach_m;  ///< from where it is, the robot promises no farther

  static LocalReplannerOptions from(const ParameterTable& values, const RobotModel& robot,
                                    double promise_reach_m);
};

}  // namespace mocha
