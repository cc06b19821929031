#pragma once

#include "perception/localization/scan_localizer.h"
#include "perception/tracking/moving_object_filter.h"

namespace mocha {

/// What config/ ships, for a robot of the default model; tests say by themselves what they vary.

inline RobotModel shipped_robot() { return load_robot_model("config", "rover"); }

inline OccupancyMapOptions shipped_map_options() {
  return OccupancyMapOptions::from(ParameterTable::from_schema("config/perception.yaml"),
                                   shipped_robot().map_resolution_m);
}

inline double shipped_smoothing_m() {
  return ParameterTable::from_schema("config/perception.yaml").number("smoothing_reach");
}

inline MovingObjectFilterOptions shipped_sorter_options() {
  return MovingObjectFilterOptions::from(ParameterTable::from_schema("config/perception.yaml"));
}

inline ScanLocalizerOptions shipped_localizer_options(const RobotModel& model = shipped_robot()) {
  return ScanLocalizerOptions::from(ParameterTable::from_schema("config/scan_localizer.yaml"),
                                    model);
}

}  // namespace mocha
