// What makes no motion, of trajectory/motion.cpp.
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <string>

#include "trajectory/random_motion.h"

namespace mocha {
namespace {

/// One list of phases for each fault that phases can have.
TEST(MotionFault, EachIsNamed) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const StandPhase stand{{Vector2::Zero(), 0.0}, 1.0};
  const auto stands_at = [](const Vector2& place, double yaw_rad, double duration_s) {
    return StandPhase{{place, yaw_rad}, duration_s};
  };
  const DrivePhase drive = random_drive(1, 3);
  const double half_s = 0.5 * drive.path.duration();
  const DrivePhase begins{1, drive.path.slice(0.0, half_s)};
  const DrivePhase ends{1, drive.path.slice(half_s, drive.path.duration())};
  PlanarPath::Piece far = PlanarPath::Piece::Zero();
  far(0, 0) = 1e13;
  const TurnPhase turn{{Vector2::Zero(), 0.0}, 1.0, 2.0};
  const StandPhase stand_in_turn = stands_at(Vector2::Zero(), state_of(turn, 0.5).yaw_rad, 1.0);
  struct Case {
    double start_time_s;
    std::vector<Phase> phases;
    MotionFault fault;
  };
  const Case cases[] = {
      {0.0, {begins, ends}, MotionFault::kNone},
      {std::nan(""), {stand}, MotionFault::kStartTime},
      {kInfinity, {stand}, MotionFault::kStartTime},
      {0.0, {}, MotionFault::kNoPhases},
      {0.0, {DrivePhase{0, drive.path}}, MotionFault::kDirection},
      {0.0, {DrivePhase{1, PlanarPath({far}, {1.0})}}, MotionFault::kOutOfRange},
      {0.0, {DrivePhase{1, PlanarPath()}}, MotionFault::kOutOfRange},
      {0.0, {stands_at(Vector2::Zero(), 0.0, -1.0)}, MotionFault::kDuration},
      {0.0, {stands_at(Vector2::Zero(), 0.0, kInfinity)}, MotionFault::kDuration},
      {0.0, {TurnPhase{{Vector2::Zero(), 0.0}, 1.0, -1.0}}, MotionFault::kDuration},
      {0.0, {stands_at({kInfinity, 0.0}, 0.0, 1.0)}, MotionFault::kNotFinite},
      {0.0, {TurnPhase{{Vector2::Zero(), 0.0}, std::nan(""), 1.0}}, MotionFault::kNotFinite},
      {0.0, {stand, stands_at({0.002, 0.0}, 0.0, 1.0)}, MotionFault::kPositionJump},
      {0.0, {stand, stands_at(Vector2::Zero(), 0.02, 1.0)}, MotionFault::kHeadingJump},
      {0.0, {begins, DrivePhase{1, ends.path.stretched(1.5)}}, MotionFault::kVelocityJump},
      {0.0, {part_of(turn, 0.5, 1.0)}, MotionFault::kMoves},
      {0.0, {part_of(turn, 0.0, 0.5), stand_in_turn}, MotionFault::kYawRateJump},
      {0.0, {part_of(turn, 0.0, 0.5), part_of(turn, 0.5, 2.0)}, MotionFault::kNone},
      {0.0, {begins}, MotionFault::kMoves},
  };
  std::set<std::string> words;
  for (const Case& each : cases) {
    const auto made = Motion::make(each.start_time_s, each.phases);
    EXPECT_EQ(made.fault, each.fault) << describe(made.fault);
    EXPECT_EQ(static_cast<bool>(made), each.fault == MotionFault::kNone);
    EXPECT_EQ(made.motion.empty(), each.fault != MotionFault::kNone) << describe(each.fault);
    words.insert(describe(each.fault));
    if (each.fault == MotionFault::kNone) continue;
    try {
      Motion(each.start_time_s, each.phases);
      ADD_FAILURE() << describe(each.fault);
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), std::string("Motion: ") + describe(each.fault));
    }
  }
  EXPECT_EQ(words.size(), static_cast<std::size_t>(MotionFault::kMoves) + 1);
  EXPECT_EQ(words.count("unknown"), 0u);
}

TEST(MotionFault, MakingAMotionNeverThrows) {
  std::mt19937 random(8);
  const double numbers[] = {0.0,  1.0,   -1.0,  1e-300, 1e6,          0.9e12,
                            1e13, 1e154, 1e300, -1e300, std::nan(""), INFINITY};
  const auto number = [&] { return numbers[random() % std::size(numbers)]; };
  const auto strange = [&](const PlanarPath& path) {
    std::vector<PlanarPath::Piece> pieces;
    for (int i = 0; i < path.pieces(); ++i) pieces.push_back(path.piece(i));
    pieces[random() % pieces.size()](random() % 2, random() % 6) = number();
    return PlanarPath(pieces, path.durations());
  };
  int motions = 0;
  int faults = 0;
  for (int i = 0; i < 20000; ++i) {
    const DrivePhase drive = random_drive(i % 7, 4);
    const Pose end{drive.path.position(drive.path.duration()),
                   heading(drive, drive.path.duration())};
    std::vector<Phase> phases = {drive, TurnPhase{end, 0.0, 1.0}, StandPhase{end, 1.0}};
    switch (random() % 4) {
      case 0:
        phases[0] = DrivePhase{1, strange(drive.path)};
        break;
      case 1:
        phases[1] = TurnPhase{{end.position, number()}, number(), number()};
        break;
      case 2:
        phases[2] = StandPhase{{{number(), number()}, number()}, number()};
        break;
      default:
        phases.resize(random() % 4);
    }
    EXPECT_NO_THROW({
      const auto made = Motion::make(random() % 3 ? 0.0 : number(), phases);
      motions += static_cast<bool>(made);
      faults += !made;
      EXPECT_TRUE(!made || made.motion.end_pose().position.allFinite()) << i;
    }) << i;
  }
  EXPECT_GT(motions, 1000);
  EXPECT_GT(faults, 10000);
}

}  // namespace
}  // namespace mocha
