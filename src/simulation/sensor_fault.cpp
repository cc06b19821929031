#include "simulation/sensor_fault.h"

#include <utility>

namespace mocha {
namespace {

using Values = ParameterTable;
using Injection = std::pair<const char*, void (*)(const Values&, SensorFault&)>;

constexpr Injection kInjections[] = {
    {"none", [](const Values&, SensorFault&) {}},
    {"scan_frozen", [](const Values&, SensorFault& fault) { fault.lidar.frozen = true; }},
    {"scan_delayed",
     [](const Values& values, SensorFault& fault) {
       fault.lidar.delay_s = values.number("fault_delay");
     }},
    {"scan_rotated",
     [](const Values& values, SensorFault& fault) {
       fault.lidar.turn_rad = values.number("fault_rotation");
     }},
    {"scan_noisy",
     [](const Values& values, SensorFault& fault) {
       fault.lidar.noise_factor = values.number("fault_noise");
     }},
    {"scan_blind_sector",
     [](const Values& values, SensorFault& fault) {
       fault.lidar.blind_rad = values.number("fault_sector");
     }},
    {"odometry_frozen", [](const Values&, SensorFault& fault) { fault.odometry.frozen = true; }},
    {"odometry_slipping",
     [](const Values& values, SensorFault& fault) {
       fault.odometry.slip = values.number("fault_slip");
     }},
};

}  // namespace

SensorFault SensorFault::from(const ParameterTable& values) {
  SensorFault fault;
  for (const auto& [name, inject] : kInjections) {
    if (values.text("sensor_fault") == name) inject(values, fault);
  }
  return fault;
}

}  // namespace mocha
