#include "control/trajectory_tracker.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "control/closed_loop.h"

namespace mocha {
namespace {

using namespace closed_loop;

constexpr double kForever = 1e9;

TEST(TrajectoryTracker, TurnsInPlaceWithoutOvershoot) {
  for (const double change : {2.0, -3.0, 6.0}) {
    const RobotModel model = rover();
    const double duration =
        turn_duration_s(change, model.limits.max_yaw_rate, model.limits.max_yaw_acceleration);
    const Motion motion(0.2, {TurnPhase{{}, change, duration}});
    ClosedLoop loop(model, {}, 5);
    loop.tracker.offer({1, 1}, motion, kForever);
    const auto samples = loop.run(motion.end_time() + 2.0);
    double overshoot = 0.0;
    for (const Sample& sample : samples) {
      EXPECT_LT(sample.error.position_m(), 0.005);
      EXPECT_LT(std::abs(sample.error.heading_rad), 0.1);
      if (sample.t > motion.end_time()) {
        overshoot = std::max(overshoot, std::copysign(1.0, change) * sample.error.heading_rad);
      }
    }
    EXPECT_LT(overshoot, 0.03) << "turn by " << change;
    EXPECT_LT(std::abs(samples.back().error.heading_rad), 0.05);
  }
}

TEST(TrajectoryTracker, DrivesThroughAllKindsOfPhases) {
  const Pose start;
  const DrivePhase there = straight(start, 1, 2.0, 5.0);
  const Pose end{{2.0, 0.0}, 0.0};
  const DrivePhase back = straight({{2.0, 0.0}, 1.5}, -1, 1.0, 3.0);
  const Motion motion(0.1,
                      {there, TurnPhase{end, 1.5, 3.0}, StandPhase{{{2.0, 0.0}, 1.5}, 0.5}, back});
  ClosedLoop loop(rover(), start, 2);
  loop.tracker.offer({1, 1}, motion, kForever);
  const auto samples = loop.run(motion.end_time() + 1.0);
  EXPECT_LT(worst_position_error(samples), 0.03);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
  EXPECT_LT((samples.back().pose.position - motion.end_pose().position).norm(), 0.02);
}

TEST(TrajectoryTracker, NoiseDoesNotMakeAStandingRobotWiggle) {
  ClosedLoop loop(rover(), {{0.0, 0.0}, 0.12}, 4);
  loop.tracker.offer({1, 1}, Motion(0.0, {StandPhase{{}, 1.0}}), kForever);
  const auto samples = loop.run(20.0);
  EXPECT_EQ(yaw_sign_changes(samples, 0.0), 0);
  EXPECT_LT(std::abs(samples.back().error.heading_rad), 0.03);
  for (const Sample& sample : samples) EXPECT_EQ(sample.command.speed, 0.0);
  EXPECT_EQ(samples.back().command.yaw_rate, 0.0);
}

/// Wheels that stand until they leap, and turn on for 0.1 s after they were told to stand.
TEST(TrajectoryTracker, WheelsThatLeapDoNotMakeAStandingRobotHunt) {
  TrajectoryTracker tracker(TrackerParameters(), rover());
  tracker.offer({1, 1}, Motion(0.0, {StandPhase{{}, 1.0}}), kForever);
  double yaw_rad = 0.12;
  double rolls_until_s = 0.0;
  double way = 0.0;
  double commanded_s = 0.0;
  int reversals = 0;
  for (double t = 0.0; t < 20.0; t += kPeriod_s) {
    const double wanted = tracker.step(t, RobotState{t, {{0.0, 0.0}, yaw_rad}}).yaw_rate;
    if (std::abs(wanted) > 1e-6) {
      commanded_s = t;
      reversals += way * wanted < 0.0;
      way = wanted;
      rolls_until_s = t + 0.1;
    }
    if (t < rolls_until_s) yaw_rad += std::copysign(1.2 * kPeriod_s, way);
  }
  EXPECT_LE(reversals, 2);
  EXPECT_LT(commanded_s, 2.0);
  EXPECT_LT(std::abs(yaw_rad), 0.2);
}

TEST(TrajectoryTracker, OldPosesAreCarriedForward) {
  const DrivePhase drive = straight({}, 1, 6.0, 7.0);
  ClosedLoop loop(jackal(), {}, 6);
  int steps = 0;
  loop.blind = [&steps](double) { return ++steps % 5 != 1; };  // odometry at 10 Hz
  loop.tracker.offer({1, 1}, Motion(0.0, {drive}), kForever);
  EXPECT_LT(worst_position_error(loop.run(9.0)), 0.05);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
}

TEST(TrajectoryTracker, ExpiredLeaseStopsAlongThePath) {
  for (const RobotModel& model : {rover(), jackal()}) {
    std::mt19937 random(11);
    for (int run = 0; run < 10; ++run) {
      const DrivePhase drive = winding(model.limits, 1, random);
      const Motion motion(0.0, {drive});
      const double expiry = 0.4 * motion.end_time();
      ClosedLoop loop(model, start_of(drive), run);
      loop.tracker.offer({1, 1}, motion, expiry);
      const auto samples = loop.run(motion.end_time() + 2.0);
      const double speed = motion.at(expiry).velocity.norm();
      double braked = 0.0;
      for (std::size_t i = 1; i < samples.size(); ++i) {
        if (samples[i].t > expiry)
          braked += (samples[i].pose.position - samples[i - 1].pose.position).norm();
      }
      EXPECT_LT(braked, speed * speed / (2.0 * model.braking().deceleration()) + 0.2 * speed + 0.03)
          << "run " << run;
      EXPECT_LT(worst_position_error(samples), 0.06) << "run " << run;
      EXPECT_LT(std::abs(samples.back().twist.speed), 1e-3);
      EXPECT_FALSE(loop.tracker.stop_reason().empty());
      EXPECT_EQ(loop.tracker.motions(), 2);  // the second is the stop
      // On the path that was promised, not somewhere beside it.
      double beside = 1.0;
      for (double t = 0.0; t < motion.end_time(); t += 0.01) {
        beside =
            std::min(beside, (motion.at(t).pose.position - samples.back().pose.position).norm());
      }
      EXPECT_LT(beside, 0.04) << "run " << run;
    }
  }
}

TEST(TrajectoryTracker, DrivesWithoutALeaseWhatTheOthersAreTold) {
  const Motion motion(0.0, {straight({}, 1, 4.0, 9.0)});
  const RobotModel model = rover();
  LeaseWatch watch;
  watch.commit({1, 1}, motion, 3.0);
  ClosedLoop loop(model, {}, 1);
  loop.tracker.offer({1, 1}, motion, 3.0);
  loop.run(3.1);
  ASSERT_EQ(loop.tracker.mode(), TrackerMode::kBraking);
  const auto told = watch.expire(3.015, model.braking());
  ASSERT_TRUE(told);
  for (double t = 3.0; t < told->end_time(); t += 0.1)
    EXPECT_NEAR((told->position(t) - loop.tracker.motion().position(t)).norm(), 0.0, 1e-9);
  // The promise comes back as a committed motion, and its first lease ends on the way.
  loop.tracker.offer({1, 2}, *told, 3.6);
  loop.run(3.3);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kTracking);
  loop.run(told->end_time() + 1.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
  EXPECT_LT((loop.robot.pose().position - told->end_pose().position).norm(), 0.03);
}

TEST(TrajectoryTracker, RenewedLeaseAloneDoesNotResume) {
  const Motion motion(0.0, {straight({}, 1, 4.0, 9.0)});
  ClosedLoop loop(rover(), {}, 1);
  loop.tracker.offer({1, 1}, motion, 3.0);
  loop.run(3.3);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kBraking);
  loop.tracker.renew({1, 1}, kForever);
  loop.tracker.offer({1, 1}, motion, kForever);  // the same motion again is no new one
  const auto samples = loop.run(9.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
  EXPECT_LT(samples.back().pose.position.x(), 2.0);

  Pose here = loop.robot.pose();
  loop.tracker.offer({1, 2}, Motion(loop.t + 0.3, {straight(here, 1, 1.0, 4.0)}), kForever);
  loop.run(loop.t + 6.0);
  EXPECT_NEAR((loop.robot.pose().position - here.position).norm(), 1.0, 0.03);
}

TEST(TrajectoryTracker, ExpiredLeaseWhileStandingIsNoEvent) {
  const Motion motion(2.0, {straight({}, 1, 1.0, 4.0)});
  ClosedLoop loop(rover(), {}, 1);
  loop.tracker.offer({1, 1}, motion, 0.5);
  loop.run(1.5);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kTracking);
  loop.tracker.renew({1, 1}, 7.0);
  loop.run(8.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
  EXPECT_TRUE(loop.tracker.stop_reason().empty());
  EXPECT_NEAR(loop.robot.pose().position.x(), 1.0, 0.02);
}

TEST(TrajectoryTracker, StandingRobotDoesNotSetOffUnderAnExpiredLease) {
  const TurnPhase turn{{}, 2.0, 3.0};
  for (const Motion& motion : {Motion(2.0, {straight({}, 1, 1.0, 4.0)}), Motion(2.0, {turn})}) {
    ClosedLoop loop(rover(), {}, 1);
    loop.tracker.offer({1, 1}, motion, 0.5);
    loop.run(9.0);
    EXPECT_LT(loop.robot.pose().position.norm(), 0.01);
    EXPECT_LT(std::abs(loop.robot.pose().yaw_rad), 0.06);
  }
}

TEST(TrajectoryTracker, ExpiredLeaseStopsATurn) {
  const Motion motion(0.0, {TurnPhase{{}, 6.0, 8.0}, straight({{0.0, 0.0}, 6.0}, 1, 1.0, 4.0)});
  ClosedLoop loop(rover(), {}, 1);
  loop.tracker.offer({1, 1}, motion, 4.0);
  const auto samples = loop.run(14.0);
  EXPECT_LT(loop.robot.pose().position.norm(), 0.01) << "the drive after the turn has no lease";
  EXPECT_LT(std::abs(samples.back().twist.yaw_rate), 1e-3);
}

TEST(TrajectoryTracker, ATurnThatIsUnderWayBeforeItCanBeTakenUpIsRefused) {
  const TurnPhase turn{{}, 2.0, 3.0};
  ClosedLoop loop(rover(), {}, 1);
  loop.tracker.offer({1, 1}, Motion(0.5, {part_of(turn, 1.0, 3.0)}), 10.0);
  const auto samples = loop.run(4.0);
  EXPECT_EQ(loop.tracker.refused(), 1);
  EXPECT_LT(std::abs(samples.back().pose.yaw_rad), 0.01);
}

TEST(TrajectoryTracker, LostPoseStopsAndTheRobotStaysWithoutALease) {
  const Motion motion(0.0, {straight({}, 1, 4.0, 9.0)});
  ClosedLoop loop(rover(), {}, 1);
  loop.blind = [](double t) { return t > 4.0 && t < 7.0; };
  loop.tracker.offer({1, 1}, motion, 6.0);
  const auto samples = loop.run(12.0);
  double stopped_at = 12.0;
  for (const Sample& sample : samples) {
    if (sample.t > 4.0 && std::abs(sample.command.speed) < 1e-3)
      stopped_at = std::min(stopped_at, sample.t);
    if (sample.t > stopped_at) {
      EXPECT_LT(std::abs(sample.command.speed), 1e-3);
    }
  }
  EXPECT_LT(stopped_at, 4.0 + 0.25 + 1.0 / 0.8 + 0.1);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kErrorBraking);
}

TEST(TrajectoryTracker, ShortLossOfThePoseAtTheGoalIsForgotten) {
  ClosedLoop loop(rover(), {}, 1);
  loop.blind = [](double t) { return t > 3.0 && t < 4.0; };
  loop.tracker.offer({1, 1}, Motion(0.0, {straight({}, 1, 0.5, 2.0)}), 2.5);
  const auto samples = loop.run(5.0);
  EXPECT_TRUE(std::any_of(samples.begin(), samples.end(),
                          [](const Sample& sample) { return sample.mode == TrackerMode::kStale; }));
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
}

TEST(TrajectoryTracker, LargeErrorStopsUntilAMotionFitsTheRealPose) {
  const Motion motion(0.0, {straight({}, 1, 4.0, 9.0)});
  ClosedLoop loop(rover(), {}, 1);
  loop.tracker.offer({1, 1}, motion, kForever);
  loop.run(4.0);
  Pose pushed = loop.robot.pose();
  pushed.position.y() += 0.3;
  loop.robot = SimulatedRobot(rover(), pushed);
  loop.run(7.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kErrorBraking);
  EXPECT_NE(loop.tracker.stop_reason().find("0.30 across"), std::string::npos)
      << loop.tracker.stop_reason();
  const Pose here = loop.robot.pose();

  loop.tracker.offer({1, 2}, Motion(loop.t, {straight(motion.end_pose(), 1, 1.0, 4.0)}), kForever);
  loop.run(8.0);
  EXPECT_EQ(loop.tracker.refused(), 1);
  EXPECT_FALSE(loop.tracker.refusal().empty());
  EXPECT_LT((loop.robot.pose().position - here.position).norm(), 1e-6);

  loop.tracker.offer({1, 3}, Motion(loop.t, {straight(here, 1, 1.0, 4.0)}), kForever);
  loop.run(loop.t + 5.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
  EXPECT_NEAR((loop.robot.pose().position - here.position).norm(), 1.0, 0.03);
}

TEST(TrajectoryTracker, ToleratesLessWhereItDrivesSlowly) {
  // Pushed aside by 4 cm: within the bound at 0.9 m/s, not at 0.1 m/s.
  for (const double speed : {0.9, 0.1}) {
    ClosedLoop loop(rover(), {}, 1);
    const Motion motion(0.0, {straight({}, 1, 7.0 * speed, 10.0)});
    loop.tracker.offer({1, 1}, motion, kForever);
    loop.run(5.0);
    ASSERT_EQ(loop.tracker.mode(), TrackerMode::kTracking);
    loop.robot.push({0.0, 0.04});
    loop.run(6.0);
    EXPECT_EQ(loop.tracker.mode(),
              speed > 0.5 ? TrackerMode::kTracking : TrackerMode::kErrorBraking);
  }
}

TEST(TrajectoryTracker, AStandingRobotMayBeOffAsFarAsAFastOne) {
  Pose start;
  start.position.y() = 0.045;
  ClosedLoop loop(rover(), start, 1);
  loop.tracker.offer({1, 1}, Motion(0.0, {StandPhase{Pose{}, 1.0}}), kForever);
  loop.run(3.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
}

TEST(TrajectoryTracker, AnEmergencyStopBrakesAsHardAsTheWheelsCanOnTheCurve) {
  for (const RobotModel& model : {rover(), jackal()}) {
    std::mt19937 random(11);
    for (int run = 0; run < 10; ++run) {
      const DrivePhase drive = winding(model.limits, 1, random);
      const Motion motion(0.0, {drive});
      ClosedLoop loop(model, start_of(drive), run);
      loop.tracker.offer({1, 1}, motion, kForever);
      const Sample last = loop.run(0.4 * motion.end_time()).back();
      loop.tracker.set_stopped(true, "button");
      const auto samples = loop.run(motion.end_time() + 2.0);
      const double step = model.max_wheel_acceleration * kPeriod_s;
      const auto faster_wheel = [&](const UnicycleState& state) {
        const WheelSpeeds wheels = wheel_speeds(state, model.limits.track_m);
        return std::max(std::abs(wheels.left), std::abs(wheels.right));
      };
      const double from = faster_wheel(last.command);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        const UnicycleState& command = samples[i].command;
        EXPECT_NEAR(faster_wheel(command), std::max(0.0, from - (i + 1) * step), 1e-9);
        EXPECT_NEAR(command.yaw_rate * last.command.speed, command.speed * last.command.yaw_rate,
                    1e-9)
            << "the curve is left";
      }
      EXPECT_EQ(loop.tracker.mode(), TrackerMode::kEmergency);
      EXPECT_EQ(loop.tracker.stop_reason(), "button");
      EXPECT_EQ(samples.back().command.speed, 0.0);
    }
  }
}

TEST(TrajectoryTracker, WhileStoppedAndAfterTheResetNothingOldIsDriven) {
  ClosedLoop loop(rover(), {}, 1);
  loop.tracker.offer({1, 1}, Motion(0.0, {straight({}, 1, 4.0, 9.0)}), kForever);
  loop.run(3.0);
  loop.tracker.set_stopped(true, "button");
  loop.run(4.0);
  const Pose here = loop.robot.pose();
  loop.tracker.offer({1, 2}, Motion(4.5, {straight(here, 1, 1.0, 4.0)}), kForever);
  loop.run(6.0);
  loop.tracker.offer({1, 3}, Motion(12.0, {straight(here, 1, 1.0, 4.0)}), 0.0);  // no lease yet
  loop.run(6.5);
  loop.tracker.set_stopped(false, "");
  loop.run(7.0);
  loop.tracker.renew({1, 3}, kForever);
  loop.run(17.0);
  EXPECT_LT((loop.robot.pose().position - here.position).norm(), 1e-6);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kIdle);
  EXPECT_TRUE(loop.tracker.stop_reason().empty());

  loop.tracker.offer({1, 4}, Motion(17.5, {straight(here, 1, 1.0, 4.0)}), kForever);
  loop.run(23.0);
  EXPECT_NEAR((loop.robot.pose().position - here.position).norm(), 1.0, 0.03);
}

TEST(TrajectoryTracker, AnEmergencyStopNeedsNoPose) {
  ClosedLoop loop(rover(), {}, 1);
  loop.blind = [](double t) { return t > 2.9; };
  loop.tracker.offer({1, 1}, Motion(0.0, {straight({}, 1, 4.0, 9.0)}), kForever);
  const double before = loop.run(3.0).back().command.speed;
  loop.tracker.set_stopped(true, "button");
  const double step = rover().max_wheel_acceleration * kPeriod_s;
  EXPECT_LT(loop.run(3.0 + 0.5 * kPeriod_s).back().command.speed, before - 0.9 * step);
}

TEST(TrajectoryTracker, ContinuesSeamlesslyIntoAMotionThatBranchesOff) {
  std::mt19937 random(5);
  const DrivePhase first = winding(rover().limits, 1, random);
  const Motion old_motion(0.0, {first});
  const double branch = 0.45 * old_motion.end_time();
  // From the state at the branch to elsewhere.
  PlanarMinco minco;
  minco.resize(1);
  PlanarMinco::State to = PlanarMinco::State::Zero();
  const MotionState at_branch = old_motion.at(branch);
  to.col(0) = at_branch.pose.position + 2.0 * at_branch.velocity;
  minco.solve(first.path.state(branch), to, PlanarMinco::Knots(2, 0),
              Eigen::VectorXd::Constant(1, 4.0));
  const Motion new_motion(branch, {DrivePhase{1, minco.curve()}});

  ClosedLoop loop(rover(), start_of(first), 1);
  loop.tracker.offer({1, 1}, old_motion, kForever);
  loop.run(branch - 0.5);
  loop.tracker.offer({1, 2}, new_motion, kForever);
  const auto samples = loop.run(new_motion.end_time() + 1.0);
  EXPECT_EQ(loop.tracker.id().sequence, 2u);
  EXPECT_EQ(loop.tracker.refused(), 0);
  EXPECT_LT(worst_position_error(samples), 0.03);
  EXPECT_LT((loop.robot.pose().position - to.col(0)).norm(), 0.03);
}

TEST(TrajectoryTracker, MotionThatBeginsMovingElsewhereIsRefused) {
  std::mt19937 random(5);
  const DrivePhase drive = winding(rover().limits, 1, random);
  const DrivePhase tail{1, drive.path.slice(2.0, drive.path.duration())};
  ClosedLoop loop(rover(), start_of(tail), 1);
  loop.tracker.offer({1, 1}, Motion(1.0, {tail}), kForever);
  loop.run(3.0);
  EXPECT_EQ(loop.tracker.refused(), 1);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kIdle);
  EXPECT_LT((loop.robot.pose().position - start_of(tail).position).norm(), 1e-9);
}

TEST(TrajectoryTracker, RespawnedTrackerDoesNotDriveAnOldMotionWithoutALease) {
  const Motion motion(-4.0, {straight({}, 1, 4.0, 9.0)});
  const Pose on_path = motion.at(0.0).pose;
  ClosedLoop loop(rover(), on_path, 1);
  loop.tracker.offer({1, 1}, motion, -3.5);
  loop.run(1.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kIdle);
  loop.tracker.renew({1, 1}, kForever);  // by now the motion is elsewhere
  loop.run(2.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kIdle);
  EXPECT_EQ(loop.tracker.refused(), 1);
  EXPECT_LT((loop.robot.pose().position - on_path.position).norm(), 1e-9);
}

TEST(TrajectoryTracker, RespawnedTrackerGoesOnWithALeaseWhereTheRobotStillFits) {
  const Motion motion(-0.5, {straight({}, 1, 4.0, 9.0)});
  ClosedLoop loop(rover(), {}, 1);
  loop.tracker.renew({1, 1}, kForever);  // the lease may arrive first
  loop.tracker.offer({1, 1}, motion, 0.0);
  loop.run(10.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kHolding);
  EXPECT_LT((loop.robot.pose().position - motion.end_pose().position).norm(), 0.03);
}

TEST(TrajectoryTracker, StandingRobotDoesNotJumpOntoAFastMotion) {
  const Motion motion(-4.0, {straight({}, 1, 4.0, 9.0)});
  ClosedLoop loop(rover(), motion.at(0.0).pose, 1);
  loop.tracker.offer({1, 1}, motion, kForever);
  loop.run(1.0);
  EXPECT_EQ(loop.tracker.mode(), TrackerMode::kIdle);
  EXPECT_NE(loop.tracker.refusal().find("it moves at 0.8"), std::string::npos)
      << loop.tracker.refusal();
}

TEST(TrajectoryTracker, WithoutAMotionOrAPoseItCommandsZero) {
  TrajectoryTracker tracker(TrackerParameters(), rover());
  for (double t = 0.0; t < 1.0; t += 0.02) {
    const UnicycleState command = tracker.step(t, std::nullopt);
    EXPECT_EQ(command.speed, 0.0);
    EXPECT_EQ(command.yaw_rate, 0.0);
  }
  tracker.offer({1, 1}, Motion(0.0, {straight({}, 1, 4.0, 9.0)}), kForever);
  EXPECT_EQ(tracker.step(1.0, std::nullopt).speed, 0.0);
  EXPECT_EQ(tracker.mode(), TrackerMode::kIdle);
}

TEST(TrajectoryTracker, NewGainsCountFromTheNextStepOn) {
  TrajectoryTracker tracker(TrackerParameters(), rover());
  tracker.offer({1, 1}, Motion(0.0, {StandPhase{{}, 10.0}}), kForever);
  RobotState turned;
  turned.pose.yaw_rad = -0.1;
  FeedbackGains gains;
  gains.settle_start_rad = 0.2;
  tracker.set_gains(gains);
  EXPECT_EQ(tracker.step(0.0, turned).yaw_rate, 0.0);
  gains.settle_start_rad = 0.05;
  tracker.set_gains(gains);
  turned.stamp_s = 0.02;
  EXPECT_GT(tracker.step(0.02, turned).yaw_rate, 0.0);

  gains.across = 0.0;
  EXPECT_THROW(tracker.set_gains(gains), std::invalid_argument);
}

TEST(TrajectoryTracker, BadParametersAreNamed) {
  TrackerParameters parameters;
  parameters.max_heading_error_rad = -1.0;
  try {
    TrajectoryTracker tracker(parameters, rover());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("max_heading_error = -1"), std::string::npos);
  }
}

}  // namespace
}  // namespace mocha
