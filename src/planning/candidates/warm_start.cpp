#include "planning/candidates/warm_start.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr double kSamePlace_m = 0.1;
constexpr double kSameSpeed_mps = 0.2;
constexpr double kShortest = 0.5;  // piece, of the one after it: a shorter one is joined to that
constexpr double kLeast_s = 0.1;   // of a drive

/// What is left, if it is one drive forward and what does not move the base.
std::optional<PlanarPath> remaining_drive(const Motion& motion, double from_s) {
  std::optional<PlanarPath> left;
  double start_s = motion.start_time();
  for (const Phase& phase : motion.phases()) {
    const double end_s = start_s + duration_s(phase);
    const auto* drive = std::get_if<DrivePhase>(&phase);
    if (drive && end_s > from_s + kLeast_s) {
      if (left || drive->direction != 1) return std::nullopt;
      left = drive->path.slice(std::max(0.0, from_s - start_s), drive->path.duration());
    }
    start_s = end_s;
  }
  return left;
}

}  // namespace

std::optional<InitialKnots<2>> remaining_knots(const Motion& motion, double from_s,
                                               const PlanarMinco::State& start,
                                               const Vector2& end) {
  const std::optional<PlanarPath> left = remaining_drive(motion, from_s);
  if (!left || (left->position(0.0) - start.col(0)).norm() > kSamePlace_m ||
      (left->derivative(0.0, 1) - start.col(1)).norm() > kSameSpeed_mps ||
      (left->position(left->duration()) - end).norm() > kSamePlace_m)
    return std::nullopt;
  const bool joins =
      left->pieces() > 1 && left->piece_duration(0) < kShortest * left->piece_duration(1);
  const int first = joins ? 1 : 0;
  const int pieces = left->pieces() - first;
  InitialKnots<2> knots;
  knots.path.resize(2, pieces + 1);
  knots.durations_s.resize(pieces);
  for (int i = 0; i < pieces; ++i) {
    knots.path.col(i) = left->position(left->piece_start(first + i));
    knots.durations_s[i] = left->piece_duration(first + i);
  }
  if (joins) knots.durations_s[0] += left->piece_duration(0);
  knots.path.col(0) = start.col(0);
  knots.path.col(pieces) = end;
  return knots;
}

}  // namespace mocha
