#include "trajectory/descriptor.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "trajectory/minco.h"

namespace mocha {
namespace {

// Knots are told in hundredths of a millimetre. Rebuilt from one that is 4 ms from an end, a drive
// would be up to 6 cm off; from 50 ms, 0.2 mm. Without such a knot it is the same to a micrometre.
constexpr double kLever_s = 0.05;

void require_of_descriptor(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(std::string("rebuild: ") + what);
}

PhaseDescriptor describe_phase(const TurnPhase& turn) {
  PhaseDescriptor phase;
  phase.kind = PhaseDescriptor::Kind::kTurn;
  phase.yaw_start_rad = turn.start.yaw_rad;
  phase.yaw_change_rad = turn.yaw_change_rad;
  phase.start_rates = turn.from;
  phase.end_rates = turn.to;
  phase.durations_s = {turn.duration_s};
  phase.points = {turn.start.position};
  return phase;
}

PhaseDescriptor describe_phase(const StandPhase& stand) {
  PhaseDescriptor phase;
  phase.kind = PhaseDescriptor::Kind::kStand;
  phase.yaw_start_rad = stand.pose.yaw_rad;
  phase.durations_s = {stand.duration_s};
  phase.points = {stand.pose.position};
  return phase;
}

/// Leaves out the knot between two pieces.
void join_pieces(int first, PhaseDescriptor& phase) {
  phase.durations_s[first] += phase.durations_s[first + 1];
  phase.durations_s.erase(phase.durations_s.begin() + first + 1);
  phase.points.erase(phase.points.begin() + first + 1);
}

/// Leaves out knots so close to an end, where the drive was cut, that their rounding would bend it.
void leave_out_levers(PhaseDescriptor& phase) {
  const auto& durations_s = phase.durations_s;
  while (durations_s.size() > 1 && durations_s.front() < kLever_s) join_pieces(0, phase);
  while (durations_s.size() > 1 && durations_s.back() < kLever_s)
    join_pieces(static_cast<int>(durations_s.size()) - 2, phase);
}

PhaseDescriptor describe_phase(const DrivePhase& drive) {
  PhaseDescriptor phase;
  phase.kind = PhaseDescriptor::Kind::kDrive;
  phase.direction = drive.direction;
  phase.durations_s = drive.path.durations();
  for (int i = 0; i < drive.path.pieces(); ++i) {
    phase.points.push_back(drive.path.derivative({i, 0.0}, 0));
  }
  const PlanarPath::Location end{drive.path.pieces() - 1, 1.0};
  phase.points.push_back(drive.path.derivative(end, 0));
  for (int order = 1; order <= 2; ++order) {
    phase.start_derivatives.col(order - 1) = drive.path.derivative({0, 0.0}, order);
    phase.end_derivatives.col(order - 1) = drive.path.derivative(end, order);
  }
  leave_out_levers(phase);
  return phase;
}

DrivePhase rebuild_drive(const PhaseDescriptor& phase) {
  const int pieces = static_cast<int>(phase.durations_s.size());
  require_of_descriptor(phase.direction == 1 || phase.direction == -1,
                        "a drive's direction is not +1 or -1");
  require_of_descriptor(pieces >= 1 && phase.points.size() == phase.durations_s.size() + 1,
                        "a drive needs one duration a piece and one point more");
  Eigen::VectorXd durations(pieces);
  for (int i = 0; i < pieces; ++i) {
    durations[i] = phase.durations_s[i];
    require_of_descriptor(std::isfinite(durations[i]) && durations[i] > 0.0,
                          "a duration is not positive");
  }
  PlanarMinco::Knots knots(2, pieces - 1);
  for (int k = 0; k + 1 < pieces; ++k) knots.col(k) = phase.points[k + 1];
  PlanarMinco::State start;
  PlanarMinco::State end;
  start << phase.points.front(), phase.start_derivatives;
  end << phase.points.back(), phase.end_derivatives;
  require_of_descriptor(start.allFinite() && end.allFinite() && knots.allFinite(),
                        "a drive is not finite");
  PlanarMinco minco;
  minco.resize(pieces);
  minco.solve(start, end, knots, durations);
  return DrivePhase{phase.direction, minco.curve()};
}

Phase rebuild_phase(const PhaseDescriptor& phase) {
  if (phase.kind == PhaseDescriptor::Kind::kDrive) return rebuild_drive(phase);
  require_of_descriptor(
      phase.kind == PhaseDescriptor::Kind::kTurn || phase.kind == PhaseDescriptor::Kind::kStand,
      "a phase is of no known kind");
  require_of_descriptor(phase.points.size() == 1 && phase.durations_s.size() == 1,
                        "a turn or a stand needs exactly one point and one duration");
  require_of_descriptor(phase.durations_s[0] >= 0.0, "a duration is negative");
  const Pose pose{phase.points[0], phase.yaw_start_rad};
  if (phase.kind == PhaseDescriptor::Kind::kTurn) {
    require_of_descriptor(phase.durations_s[0] > 0.0, "a turn takes no time");
    return TurnPhase{pose, phase.yaw_change_rad, phase.durations_s[0], phase.start_rates,
                     phase.end_rates};
  }
  return StandPhase{pose, phase.durations_s[0]};
}

}  // namespace

MotionDescriptor describe(const Motion& motion) {
  MotionDescriptor descriptor;
  descriptor.start_time_s = motion.start_time();
  for (const Phase& phase : motion.phases()) {
    descriptor.phases.push_back(
        std::visit([](const auto& each) { return describe_phase(each); }, phase));
  }
  return descriptor;
}

Motion rebuild(const MotionDescriptor& descriptor) {
  std::vector<Phase> phases;
  for (const PhaseDescriptor& phase : descriptor.phases) phases.push_back(rebuild_phase(phase));
  return Motion(descriptor.start_time_s, std::move(phases));
}

}  // namespace mocha
