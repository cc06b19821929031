#pragma once

namespace mocha {

/// [s] What sums of steps may be off the time that they are compared with.
constexpr double kTimeSlack_s = 1e-9;

}  // namespace mocha
