#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "fleet/protocol/commitment_options.h"
#include "fleet/protocol/committed_trajectory.h"

namespace mocha::test {

using Message = std::variant<CommittedTrajectory, Heartbeat>;

/// One step of a model's time, short in binary, so that sums of it are exact.
constexpr double kStep_s = 0.0625;

/// A motion that a robot may propose once, in one of these steps: from where it will be when the
/// motion starts, through the places.
struct ScriptedMotion {
  int from_step;
  int until_step;
  int start_step;
  std::vector<Vector2> through;
  double speed = 1.0;  ///< [m/s]
};

struct ModelledRobot {
  Vector2 home;  ///< where it stands at first
  std::vector<ScriptedMotion> script;
  int priority = 0;
  double clock_ahead_s = 0.0;
  bool may_restart = false;
  bool may_brake = false;
};

/// How often the world does each harm, at most.
struct Harm {
  int losses = 0;
  int delays = 0;  ///< of one message by one step
  int duplicates = 0;
  int restarts = 0;
  int cuts = 0;
  int brakes = 0;
};

/// What a broadcaster that was started again promises first of all.
enum class Restart {
  kAsDriven,   ///< what the tracker drives
  kNothing,    ///< a planted fault: it does not know what the tracker drives
  kStandHere,  ///< a planted fault: it says that it stands, while the tracker drives on
};

/// A small world: robots, what they want, and what may go wrong.
struct Scenario {
  std::string name;
  std::vector<ModelledRobot> robots;
  Harm harm;
  int steps = 0;  ///< the model ends after these
  Restart restart = Restart::kAsDriven;
  Reach reach{1000.0, 4.0, 1000.0};  ///< so that all are near
  /// Plants a fault: changes a message on its way between two robots; false: it is lost.
  std::function<bool(int from, int to, Message&)> tamper;

  int size() const { return static_cast<int>(robots.size()); }
};

/// The options of robot i: an endorsement and a heartbeat take whole steps.
CommitmentOptions options_of(const Scenario& scenario, int i, std::uint32_t epoch);

/// "ugv1" for 0.
std::string name_of_robot(int i);

}  // namespace mocha::test
