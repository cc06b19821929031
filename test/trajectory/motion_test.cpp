#include "trajectory/motion.h"

#include <gtest/gtest.h>

#include "trajectory/random_motion.h"

namespace mocha {
namespace {

/// Turn, drive, stand, drive backward: each begins where the last one ends.
Motion all_kinds(double start_s) {
  const DrivePhase ahead = random_drive(5, 4);
  const double yaw = heading(ahead, 0.0);
  const Vector2 last = ahead.path.position(ahead.path.duration());
  const double last_yaw = heading(ahead, ahead.path.duration());
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();  // 1 m straight back, minimum jerk
  const Vector2 back = -Vector2(std::cos(last_yaw), std::sin(last_yaw));
  piece.col(0) = last;
  piece.col(3) = 10.0 * back;
  piece.col(4) = -15.0 * back;
  piece.col(5) = 6.0 * back;
  return Motion(start_s,
                {TurnPhase{{Vector2::Zero(), wrap_angle(yaw - 2.0)}, 2.0, 3.0}, ahead,
                 StandPhase{{last, last_yaw}, 0.5}, DrivePhase{-1, PlanarPath({piece}, {2.0})}});
}

TEST(Motion, WrapsAngles) {
  EXPECT_EQ(wrap_angle(M_PI), M_PI);
  EXPECT_EQ(wrap_angle(-M_PI), M_PI);
  EXPECT_NEAR(wrap_angle(3.0 * M_PI + 0.1), -M_PI + 0.1, 1e-12);
  EXPECT_NEAR(wrap_angle(-7.0), -7.0 + 2.0 * M_PI, 1e-12);
  EXPECT_EQ(wrap_angle(0.5), 0.5);
  for (double angle = -50.0; angle < 50.0; angle += 0.37) {
    EXPECT_GT(wrap_angle(angle), -M_PI);
    EXPECT_LE(wrap_angle(angle), M_PI);
    EXPECT_NEAR(std::cos(wrap_angle(angle)), std::cos(angle), 1e-12);
    EXPECT_NEAR(std::sin(wrap_angle(angle)), std::sin(angle), 1e-12);
  }
}

TEST(Motion, StandsBeforeAndAfter) {
  const Motion motion = all_kinds(100.0);
  const MotionState before = motion.at(0.0);
  EXPECT_TRUE(before.at_rest);
  EXPECT_EQ(before.velocity.norm(), 0.0);
  EXPECT_LT((before.pose.position - motion.at(100.0).pose.position).norm(), 1e-12);
  const MotionState after = motion.at(motion.end_time() + 10.0);
  EXPECT_TRUE(after.at_rest);
  EXPECT_EQ(after.velocity.norm(), 0.0);
  EXPECT_EQ(after.acceleration.norm(), 0.0);
  EXPECT_EQ(after.yaw_rate, 0.0);
  EXPECT_LT((after.pose.position - motion.end_pose().position).norm(), 1e-12);
}

TEST(Motion, PositionAndVelocityAreThoseOfTheState) {
  const Motion motion = all_kinds(100.0);
  for (double t = 99.0; t < motion.end_time() + 1.0; t += 0.0171) {
    EXPECT_EQ(motion.position(t), motion.at(t).pose.position) << t;
    EXPECT_EQ(motion.velocity(t), motion.at(t).velocity) << t;
  }
  EXPECT_EQ(motion.velocity(motion.end_time()), Vector2::Zero());
  EXPECT_THROW(Motion().position(0.0), std::invalid_argument);
  EXPECT_THROW(Motion().velocity(0.0), std::invalid_argument);
}

TEST(Motion, StateIsTheDerivativeOfThePoseThroughAllPhases) {
  const Motion motion = all_kinds(100.0);
  const double h = 1e-5;
  for (double t = 100.0 + 2 * h; t < motion.end_time() - 2 * h; t += 0.0371) {
    const MotionState state = motion.at(t);
    const Pose before = motion.at(t - h).pose;
    const Pose after = motion.at(t + h).pose;
    EXPECT_LT((state.velocity - (after.position - before.position) / (2 * h)).norm(), 1e-6) << t;
    const double yaw_rate = wrap_angle(after.yaw_rad - before.yaw_rad) / (2 * h);
    EXPECT_NEAR(state.yaw_rate, yaw_rate, 1e-3 + 1e-3 * std::abs(yaw_rate)) << t;
    const Vector2 ahead(std::cos(state.pose.yaw_rad), std::sin(state.pose.yaw_rad));
    EXPECT_LT((state.velocity - state.speed * ahead).norm(), 1e-4) << t;
  }
}

TEST(Motion, HeadingIsContinuousThroughRest) {
  const Motion motion = all_kinds(0.0);
  double last = motion.at(0.0).pose.yaw_rad;
  for (double t = 0.0; t < motion.end_time(); t += 0.001) {
    const double yaw = motion.at(t).pose.yaw_rad;
    EXPECT_LT(std::abs(wrap_angle(yaw - last)), 0.02) << t;
    last = yaw;
  }
}

TEST(Motion, HeadingAtRestIsTheLimitWhateverDerivativeIsFirst) {
  for (int order = 2; order <= 4; ++order) {
    for (const int direction : {1, -1}) {
      PlanarPath::Piece piece = PlanarPath::Piece::Zero();
      piece.col(order) = Vector2(1.0, 2.0);
      piece.col(5) = Vector2(0.3, -0.1);
      const DrivePhase starts{direction, PlanarPath({piece}, {1.0})};
      EXPECT_NEAR(wrap_angle(heading(starts, 0.0) - heading(starts, 0.05)), 0.0, 0.05) << order;
      // The same driven backward in time: u -> 1 - u.
      PlanarPath::Piece mirrored = PlanarPath::Piece::Zero();
      for (int k = 0; k < 6; ++k) {
        double choose = 1.0;
        for (int j = 0; j <= k; ++j) {
          mirrored.col(j) += choose * (j % 2 ? -1.0 : 1.0) * piece.col(k);
          choose = choose * (k - j) / (j + 1);
        }
      }
      const DrivePhase ends{direction, PlanarPath({mirrored}, {1.0})};
      EXPECT_NEAR(wrap_angle(heading(ends, 1.0) - heading(ends, 0.95)), 0.0, 0.05) << order;
    }
  }
}

TEST(Motion, SwitchesAtOnceExceptInTurns) {
  const Motion motion = all_kinds(10.0);
  EXPECT_EQ(motion.switch_time(5.0), 5.0);
  EXPECT_EQ(motion.switch_time(10.0), 10.0);  // the turn has not begun
  EXPECT_EQ(motion.switch_time(11.0), 13.0);
  EXPECT_EQ(motion.switch_time(13.0), 13.0);
  EXPECT_EQ(motion.switch_time(14.0), 14.0);
  EXPECT_EQ(motion.switch_time(motion.end_time() + 1.0), motion.end_time() + 1.0);
  const Motion under_way(11.0, motion.phases_between(11.0, motion.end_time()));
  EXPECT_EQ(under_way.switch_time(10.5), 10.5);
  EXPECT_NEAR(under_way.switch_time(11.0 + 1e-6), 13.0, 1e-9);
  std::vector<Phase> turns = motion.phases_between(10.0, 11.0);
  for (Phase& phase : motion.phases_between(11.0, 13.0)) turns.push_back(std::move(phase));
  EXPECT_NEAR(Motion(10.0, turns).switch_time(10.5), 13.0, 1e-9) << "one turn in two phases";
}

TEST(Motion, PartsAreTheSameMotion) {
  const Motion motion = all_kinds(10.0);
  for (const double t0 : {5.0, 10.0, 11.2, 12.9, 13.0, 14.3}) {
    std::vector<Phase> phases = motion.phases_between(t0, motion.end_time() + 3.0);
    const Motion part(std::max(t0, 10.0), phases);
    EXPECT_NEAR(part.end_time(), motion.end_time(), 1e-9);
    for (double t = part.start_time(); t < part.end_time(); t += 0.05) {
      EXPECT_LT((part.at(t).pose.position - motion.at(t).pose.position).norm(), 1e-9);
      EXPECT_NEAR(wrap_angle(part.at(t).pose.yaw_rad - motion.at(t).pose.yaw_rad), 0.0, 1e-6);
      if (t > part.start_time()) {
        EXPECT_NEAR(part.at(t).yaw_rate, motion.at(t).yaw_rate, 1e-6) << t0 << " " << t;
      }
    }
  }
  EXPECT_TRUE(motion.phases_between(14.0, 14.0).empty());
  EXPECT_TRUE(motion.phases_between(15.0, 14.0).empty());
}

TEST(Motion, CutsAtRosTimes) {
  for (int seed = 0; seed < 50; ++seed) {  // where 1 s has a rounding error of 0.2 us
    const Motion motion(1.7e9 + 0.1234567 * seed, {
                                                      random_drive(seed, 4),
                                                  });
    const double t = motion.start_time() + 0.0613 * seed;
    const Motion part(t, motion.phases_between(t, motion.end_time()));
    EXPECT_NEAR(part.end_time(), motion.end_time(), 1e-6);
    EXPECT_LT((part.end_pose().position - motion.end_pose().position).norm(), 1e-9);
  }
}

TEST(Motion, LengthIsThatOfThePath) {
  PlanarPath::Piece piece = PlanarPath::Piece::Zero();
  piece.col(3) = Vector2(0.0, 30.0);
  piece.col(4) = Vector2(0.0, -45.0);
  piece.col(5) = Vector2(0.0, 18.0);
  const Motion motion(0.0, {DrivePhase{1, PlanarPath({piece}, {4.0})}});
  EXPECT_NEAR(motion.length_m(), 3.0, 1e-9);
}

TEST(Motion, RefusesWhatCannotBeDriven) {
  const StandPhase stand{{Vector2::Zero(), 0.0}, 1.0};
  const DrivePhase drive = random_drive(1, 3);
  EXPECT_THROW(Motion(0.0, {}), std::invalid_argument);
  EXPECT_THROW(Motion(std::nan(""), {stand}), std::invalid_argument);
  EXPECT_THROW(Motion(0.0, {StandPhase{{Vector2::Zero(), 0.0}, -1.0}}), std::invalid_argument);
  EXPECT_THROW(Motion(0.0, {StandPhase{{Vector2(INFINITY, 0.0), 0.0}, 1.0}}),
               std::invalid_argument);
  EXPECT_THROW(Motion(0.0, {stand, StandPhase{{Vector2(0.002, 0.0), 0.0}, 1.0}}),
               std::invalid_argument);
  EXPECT_THROW(Motion(0.0, {stand, StandPhase{{Vector2::Zero(), 0.02}, 1.0}}),
               std::invalid_argument);
  const PlanarPath moving = drive.path.slice(0.0, 0.5 * drive.path.duration());
  EXPECT_THROW(Motion(0.0, {DrivePhase{1, moving}}), std::invalid_argument);  // no rest at the end
  const PlanarPath rest = drive.path.slice(0.5 * drive.path.duration(), drive.path.duration());
  EXPECT_NO_THROW(Motion(0.0, {DrivePhase{1, moving}, DrivePhase{1, rest}}));
  EXPECT_THROW(Motion(0.0, {DrivePhase{1, moving}, DrivePhase{-1, rest}}), std::invalid_argument);
  EXPECT_THROW(Motion(0.0, {DrivePhase{1, moving}, DrivePhase{1, rest.stretched(1.5)}}),
               std::invalid_argument);
  EXPECT_THROW(Motion().at(0.0), std::invalid_argument);
}

TEST(Motion, RefusesDrivesThatAreNotFiniteAnywhere) {
  const PlanarPath path = random_drive(1, 5).path;
  for (const double bad : {std::nan(""), static_cast<double>(INFINITY), 1e13}) {
    std::vector<PlanarPath::Piece> pieces;
    for (int i = 0; i < path.pieces(); ++i) pieces.push_back(path.piece(i));
    pieces[2](1, 4) = bad;  // the phase's ends do not show it
    EXPECT_THROW(Motion(0.0, {DrivePhase{1, PlanarPath(pieces, path.durations())}}),
                 std::invalid_argument);
  }
  PlanarPath::Piece far = PlanarPath::Piece::Zero();
  far(0, 0) = 1e13;
  EXPECT_THROW(Motion(0.0, {DrivePhase{1, PlanarPath({far}, {1.0})}}), std::invalid_argument);
  std::vector<double> durations = path.durations();
  durations[2] = 1e-9;  // 1e18 m/s^2
  EXPECT_THROW(Motion(0.0, {DrivePhase{1, PlanarPath({path.piece(0), path.piece(1), path.piece(2),
                                                      path.piece(3), path.piece(4)},
                                                     durations)}}),
               std::invalid_argument);
}

TEST(Motion, RefusesDirectionsThatAreNone) {
  const DrivePhase drive = random_drive(1, 3);
  EXPECT_THROW(Motion(0.0, {DrivePhase{0, drive.path}}), std::invalid_argument);
  EXPECT_THROW(Motion(0.0, {DrivePhase{2, drive.path}}), std::invalid_argument);
}

TEST(Motion, TurnsKeepTheirLimits) {
  for (const double change : {0.05, -1.0, 3.1}) {
    const double duration = turn_duration_s(change, 1.2, 3.0);
    const Motion motion(0.0, {TurnPhase{{Vector2::Zero(), 0.3}, change, duration}});
    double rate = 0.0;
    double acceleration = 0.0;
    const double h = 1e-3 * duration;
    for (double t = h; t < duration - h; t += h) {
      rate = std::max(rate, std::abs(motion.at(t).yaw_rate));
      acceleration = std::max(
          acceleration, std::abs(motion.at(t + h).yaw_rate - motion.at(t - h).yaw_rate) / (2 * h));
    }
    constexpr double kToSpare = 1.001;  // for what messages round
    EXPECT_LE(kToSpare * rate, 1.2 * (1.0 + 1e-9));
    EXPECT_LE(kToSpare * acceleration, 3.0 * (1.0 + 1e-3));
    EXPECT_GT(kToSpare * std::max(rate / 1.2, acceleration / 3.0), 0.999);
    EXPECT_NEAR(motion.end_pose().yaw_rad, wrap_angle(0.3 + change), 1e-12);
  }
}

}  // namespace
}  // namespace mocha
