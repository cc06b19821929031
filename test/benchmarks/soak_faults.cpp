#include "benchmarks/soak_faults.h"

#include <random>

namespace mocha {
namespace {

// Mean times between faults anywhere in the fleet.
constexpr double kNodeEvery_s = 20.0;
constexpr double kRobotEvery_s = 90.0;
constexpr double kBlackoutEvery_s = 30.0;
constexpr double kLinkEvery_s = 20.0;
constexpr double kFirst_s = 10.0;    // all have got going by then
constexpr double kRecovery_s = 5.0;  // between two faults of one robot
constexpr double kMaxDelay_s = 0.1;

/// The same with every standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  int below(int count) { return static_cast<int>(engine_() % count); }

 private:
  std::mt19937_64 engine_;
};

/// How long it lasts. Launch files start a node again after half a second.
double lasts_s(SoakFault::Kind kind, Draw& draw) {
  switch (kind) {
    case SoakFault::Kind::kNode:
      return draw.between(0.6, 1.6);
    case SoakFault::Kind::kRobot:
      return draw.between(3.0, 8.0);
    case SoakFault::Kind::kBlackout:
      return draw.between(1.0, 3.0);
  }
  return 0.0;
}

SoakFault::Kind kind_of(Draw& draw, double every_s) {
  const double share = draw.between(0.0, 1.0 / every_s);
  if (share < 1.0 / kNodeEvery_s) return SoakFault::Kind::kNode;
  if (share < 1.0 / kNodeEvery_s + 1.0 / kRobotEvery_s) return SoakFault::Kind::kRobot;
  return SoakFault::Kind::kBlackout;
}

}  // namespace

SoakFaults SoakFaults::drawn(double duration_s, int robots, std::uint64_t seed) {
  const double every_s = 1.0 / (1.0 / kNodeEvery_s + 1.0 / kRobotEvery_s + 1.0 / kBlackoutEvery_s);
  SoakFaults drawn;
  Draw draw(seed);
  std::vector<double> free_s(robots, 0.0);
  for (double now_s = kFirst_s; now_s < duration_s; now_s += draw.between(0.0, 2.0 * every_s)) {
    SoakFault fault{kind_of(draw, every_s), draw.below(robots), kRobotNodes[draw.below(4)], now_s,
                    0.0};
    fault.end_s = now_s + lasts_s(fault.kind, draw);
    if (now_s < free_s[fault.robot]) continue;
    free_s[fault.robot] = fault.end_s + kRecovery_s;
    drawn.faults.push_back(fault);
  }
  Draw link(~seed);
  for (double now_s = 0.0; now_s < duration_s; now_s += link.between(0.0, 2.0 * kLinkEvery_s)) {
    const double most_s = link.between(0.02, kMaxDelay_s);
    const double least_s = link.between(0.0, most_s);
    drawn.links.push_back({now_s, {least_s, most_s, link.between(0.05, 0.2)}});
  }
  return drawn;
}

}  // namespace mocha
