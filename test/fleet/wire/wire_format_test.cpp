#include "fleet/wire/wire_format.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <optional>
#include <random>
#include <sstream>

#include "fleet/protocol/motions.h"
#include "trajectory/rover_braking.h"
#include "trajectory/splice.h"
#include "world/robot_model.h"

namespace mocha {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr double kNow_s = 1.7e9;
constexpr double kSameMotion_m = 1e-4;
constexpr std::size_t kSealAt = 10;  // of a datagram
constexpr std::size_t kSizeAt = 26;

Bytes encoded(const FleetMessage& message) { return encode({17, message}); }
FleetMessage decoded(const Bytes& bytes) { return decode(bytes.data(), bytes.size()).message; }

CommittedTrajectory trajectory_of(Motion motion) {
  CommittedTrajectory trajectory{
      "ugv1", {7, 4000000000U}, TrajectoryState::kProposed, -3, 0.3, test::kRoverBraking, nullptr};
  trajectory.motion = test::shared(std::move(motion));
  return trajectory;
}

/// A turn in place, a drive, another turn and a stand.
Motion varied(std::mt19937& random, double start_s) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vector2> points = {Vector2(5.0 * unit(random), 5.0 * unit(random))};
  double course_rad = 3.0 * unit(random);
  for (int i = 0; i < 8; ++i) {
    course_rad += 0.6 * unit(random);
    points.push_back(points.back() + 0.6 * Vector2(std::cos(course_rad), std::sin(course_rad)));
  }
  DrivePhase drive = std::get<DrivePhase>(test::drive(start_s, points, 0.9).phases().front());
  drive.direction = unit(random) > 0.0 ? 1 : -1;
  const Motion first(start_s, {drive});
  Pose begin{first.at(start_s).pose};
  Pose end{first.end_pose()};
  const double before = unit(random);
  const double after = unit(random);
  std::vector<Phase> phases;
  phases.emplace_back(TurnPhase{{begin.position, wrap_angle(begin.yaw_rad - before)}, before, 1.0});
  phases.emplace_back(drive);
  phases.emplace_back(TurnPhase{end, after, 0.7});
  phases.emplace_back(StandPhase{{end.position, wrap_angle(end.yaw_rad + after)}, 0.25});
  return Motion(start_s, std::move(phases));
}

/// The rest of such a motion from the midst of one of its phases on.
Motion under_way(int phase, std::mt19937& random, double start_s) {
  const Motion whole = varied(random, start_s);
  const double cut_s = whole.phase_start_time(phase) + 0.4 * duration_s(whole.phases()[phase]);
  return Motion(cut_s, whole.phases_between(cut_s, whole.end_time()));
}

/// Whole, or begun in the midst of its first turn or of its drive.
Motion any(int number, std::mt19937& random, double start_s) {
  return number % 3 == 0 ? varied(random, start_s) : under_way(number % 3 - 1, random, start_s);
}

Heartbeat heartbeat() {
  Heartbeat heartbeat{"ugv1", 3, kNow_s + 0.123456, {}, {{"ugv2", kNow_s - 70.25, 0.015}}, 6.504};
  heartbeat.acknowledgements = {{"ugv1", {3, 9}, TrajectoryState::kCommitted},
                                {"ugv2", {1, 5}, TrajectoryState::kWithdrawn}};
  return heartbeat;
}

PassingIntent passing_intent() {
  return {"ugv1",         3,     -7,
          true,           0.333, Vector2(-20000.0, 12.34567),
          {"ugv2", 1, 5}, 4,     {{1.0, 2.0}, {3.0, 4.0}}};
}

PassingInstruction passing_instruction() {
  PassingInstruction instruction{{"ugv1", 3, 5}, "ugv2", {"ugv1", "ugv2", "ugv3"}, 40, 37, 10, {}};
  for (std::uint32_t i = 0; i < 20; ++i)
    instruction.part.push_back({{{0.5 * i, 12.34567}, {0.5 * i + 0.5, 12.3}}, {{0, i}, {2, 7}}});
  return instruction;
}

TEST(WireFormat, GivesBackPromisesButForTheQuantisation) {
  std::mt19937 random(1);
  for (int run = 0; run < 200; ++run) {
    const CommittedTrajectory sent = trajectory_of(any(run, random, kNow_s + 0.0137 * run));
    const CommittedTrajectory heard = std::get<CommittedTrajectory>(decoded(encoded(sent)));
    EXPECT_EQ(heard.agent, sent.agent);
    EXPECT_TRUE(heard.id == sent.id);
    EXPECT_EQ(heard.state, sent.state);
    EXPECT_EQ(heard.priority, sent.priority);
    EXPECT_GE(heard.footprint_radius_m, sent.footprint_radius_m - 1e-9);
    EXPECT_LT(heard.footprint_radius_m, sent.footprint_radius_m + 0.001);
    EXPECT_EQ(heard.braking->deceleration(), sent.braking->deceleration());
    EXPECT_EQ(heard.braking->max_acceleration(), sent.braking->max_acceleration());
    EXPECT_NEAR(heard.motion->end_time(), sent.motion->end_time(), 1e-5);
    const double begin_s = sent.motion->start_time() + 1e-5;  // which is rounded, too
    for (double t = begin_s; t < sent.motion->end_time(); t += 0.02) {
      const MotionState a = heard.motion->at(t);
      const MotionState b = sent.motion->at(t);
      ASSERT_LT((a.pose.position - b.pose.position).norm(), kSameMotion_m);
      ASSERT_LT((a.velocity - b.velocity).norm(), 5e-4);
      ASSERT_LT(std::abs(wrap_angle(a.pose.yaw_rad - b.pose.yaw_rad)), 2e-3);
    }
  }
}

// A knot shortly after a cut is the lever with which its rounding bends the rest of the drive.
TEST(WireFormat, GivesBackDrivesThatWereCutShortlyBeforeAKnot) {
  std::mt19937 random(2);
  for (int run = 0; run < 300; ++run) {
    const Motion whole = varied(random, kNow_s);
    const auto& durations_s = std::get<DrivePhase>(whole.phases()[1]).path.durations();
    const double knot_s = whole.phase_start_time(1) + durations_s[0] + durations_s[1];
    const Motion rest = rest_of(whole, knot_s - 0.001 * (1 + run % 80));
    const CommittedTrajectory heard =
        std::get<CommittedTrajectory>(decoded(encoded(trajectory_of(Motion(rest)))));
    for (double t = rest.start_time() + 1e-5; t < rest.phase_start_time(1) - 0.01; t += 0.01) {
      const MotionState a = heard.motion->at(t);
      const MotionState b = whole.at(t);
      ASSERT_LT((a.pose.position - b.pose.position).norm(), 3e-4) << run % 80 + 1 << " ms";
      ASSERT_LT((a.velocity - b.velocity).norm(), 2e-3) << run % 80 + 1 << " ms";
      ASSERT_LT((a.acceleration - b.acceleration).norm(), 0.03) << run % 80 + 1 << " ms";
    }
  }
}

TEST(WireFormat, WhatWasDecodedIsTheSameForEverybodyAndForEver) {
  std::mt19937 random(2);
  for (int run = 0; run < 200; ++run) {
    const CommittedTrajectory sent = trajectory_of(any(run, random, kNow_s + 0.0137 * run));
    const CommittedTrajectory driven = quantised(sent);
    const Bytes bytes = encoded(driven);
    EXPECT_EQ(bytes, encoded(sent));
    const CommittedTrajectory again = std::get<CommittedTrajectory>(decoded(bytes));
    for (double t = kNow_s; t < driven.motion->end_time(); t += 0.1)
      EXPECT_EQ(again.motion->position(t), driven.motion->position(t));
    const Motion alone = quantised(*sent.motion);
    EXPECT_EQ(alone.start_time(), driven.motion->start_time());
    EXPECT_EQ(alone.position(kNow_s + 5.0), driven.motion->position(kNow_s + 5.0));
  }
}

CommittedTrajectory braking_so(const std::optional<Braking>& braking) {
  CommittedTrajectory trajectory = trajectory_of(test::stand(kNow_s, {1.0, 2.0}));
  trajectory.braking = braking;
  return trajectory;
}

Braking told(const Braking& braking) {
  return std::get<CommittedTrajectory>(decoded(encoded(braking_so(braking)))).braking.value();
}

TEST(WireFormat, SaysExactlyHowARobotBrakes) {
  for (const char* model : {"rover", "jackal", "waveshare_rover"}) {
    RobotModel robot = load_robot_model("config", model);
    for (const double share : {1.0, 0.93, 0.777777}) {
      robot.limits.max_acceleration *= share;
      EXPECT_EQ(told(robot.braking()).deceleration(), robot.braking().deceleration());
      EXPECT_EQ(told(robot.braking()).max_acceleration(), robot.braking().max_acceleration());
    }
  }
  const Braking rounded = told(Braking(0.61849, 1.00051));
  EXPECT_DOUBLE_EQ(rounded.deceleration(), 0.618);
  EXPECT_DOUBLE_EQ(rounded.max_acceleration(), 1.001);
  EXPECT_EQ(told(Braking(0.5)).max_acceleration(), std::numeric_limits<double>::infinity());
}

TEST(WireFormat, RefusesBrakingThatNoRobotCanHave) {
  EXPECT_THROW(encoded(braking_so(std::nullopt)), std::invalid_argument);
  for (const double odd : {1e-9, 0.019, 50.1, 1e9}) {
    EXPECT_THROW(encoded(braking_so(Braking(odd))), std::invalid_argument) << odd;
    EXPECT_THROW(encoded(braking_so(Braking(1.0, odd))), std::invalid_argument) << odd;
  }
  CommittedTrajectory fast = trajectory_of(test::drive(kNow_s, {{0.0, 0.0}, {50.0, 0.0}}, 5.0));
  EXPECT_NO_THROW(encoded(fast));
  fast.braking = Braking(0.03);  // would stop for minutes
  EXPECT_THROW(encoded(fast), std::invalid_argument);
  const Bytes good = encoded(braking_so(Braking(0.5, 0.8)));
  constexpr std::size_t kDecelerationAt = 53;
  constexpr std::size_t kLimitAt = kDecelerationAt + 2;
  const auto with = [&](std::size_t at, std::uint16_t counts) {
    Bytes bytes = good;
    bytes[at] = static_cast<std::uint8_t>(counts);
    bytes[at + 1] = static_cast<std::uint8_t>(counts >> 8);
    return bytes;
  };
  EXPECT_EQ(with(kDecelerationAt, 500), good);
  EXPECT_EQ(with(kLimitAt, 800), good);
  for (const std::uint16_t odd : {0, 1, 19, 50001, 0xfffe}) {
    EXPECT_THROW(decoded(with(kDecelerationAt, odd)), std::invalid_argument) << odd;
    EXPECT_THROW(decoded(with(kLimitAt, odd)), std::invalid_argument) << odd;
  }
  EXPECT_THROW(decoded(with(kDecelerationAt, 0xffff)), std::invalid_argument);
}

/// As where the map has the coordinates of a country.
TEST(WireFormat, TheMapMayBeginFarAway) {
  const Vector2 here(567890.12, 5432109.87);
  const Motion sent =
      test::drive(kNow_s, {here, here + Vector2(1.0, 0.3), here + Vector2(2.0, 0.0)}, 1.0);
  ASSERT_TRUE(fits(sent));
  const Motion heard = quantised(sent);
  for (double t = kNow_s; t < sent.end_time(); t += 0.1)
    EXPECT_LT((heard.position(t) - sent.position(t)).norm(), kSameMotion_m);
  const CommittedTrajectory driven = quantised(trajectory_of(sent));
  EXPECT_EQ(encoded(driven), encoded(trajectory_of(sent)));
}

TEST(WireFormat, GivesBackHeartbeatsAndWithdrawals) {
  const Heartbeat heard = std::get<Heartbeat>(decoded(encoded(heartbeat())));
  EXPECT_EQ(heard.agent, "ugv1");
  EXPECT_EQ(heard.epoch, 3U);
  EXPECT_NEAR(heard.stamp_s, kNow_s + 0.123456, 1e-6);
  ASSERT_EQ(heard.acknowledgements.size(), 2U);
  EXPECT_EQ(heard.acknowledgements[1].agent, "ugv2");
  EXPECT_TRUE(heard.acknowledgements[1].id == (TrajectoryId{1, 5}));
  EXPECT_EQ(heard.acknowledgements[1].state, TrajectoryState::kWithdrawn);
  ASSERT_EQ(heard.echoes.size(), 1U);
  EXPECT_EQ(heard.echoes[0].agent, "ugv2");
  EXPECT_NEAR(heard.echoes[0].stamp_s, kNow_s - 70.25, 1e-6);
  EXPECT_NEAR(heard.echoes[0].held_s, 0.015, 1e-6);
  EXPECT_DOUBLE_EQ(heard.promise_reach_m, 6.51);  // rounded up
  CommittedTrajectory void_one{"ugv1", {3, 9}, TrajectoryState::kWithdrawn, 0, 0.3, {}, nullptr};
  EXPECT_EQ(std::get<CommittedTrajectory>(decoded(encoded(void_one))).motion, nullptr);
}

TEST(WireFormat, GivesBackEmergencyStops) {
  const FleetStops sent{"ugv1", 3, {{"ugv2", 7, 6, kNow_s + 0.125, "told by /joystick"}}};
  const FleetStops heard = std::get<FleetStops>(decoded(encoded(sent)));
  EXPECT_EQ(heard.agent, "ugv1");
  EXPECT_EQ(heard.epoch, 3U);
  ASSERT_EQ(heard.stops.size(), 1U);
  EXPECT_EQ(heard.stops[0].agent, "ugv2");
  EXPECT_EQ(heard.stops[0].ordered, 7U);
  EXPECT_EQ(heard.stops[0].released, 6U);
  EXPECT_NEAR(heard.stops[0].since_s, kNow_s + 0.125, 1e-6);
  EXPECT_EQ(heard.stops[0].reason, "told by /joystick");
  EXPECT_TRUE(std::get<FleetStops>(decoded(encoded(FleetStops{"ugv1", 3, {}}))).stops.empty());
  FleetStops nonsense = sent;
  nonsense.stops[0].released = 8;
  EXPECT_THROW(encoded(nonsense), std::invalid_argument);
  nonsense = sent;
  nonsense.stops[0].agent = "two words";
  EXPECT_THROW(encoded(nonsense), std::invalid_argument);
}

TEST(WireFormat, TenSecondsOfDriveFitIntoOneDatagram) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Vector2> points = {Vector2::Zero()};
  const auto longer = [&] { points.push_back(points.back() + Vector2(0.3, 0.1 * unit(random))); };
  for (int i = 0; i < 50; ++i) longer();
  EXPECT_TRUE(fits(test::drive(kNow_s, points, 1.0)));  // pieces of 0.5 s
  EXPECT_LE(encoded(trajectory_of(test::drive(kNow_s, points, 1.0))).size(), kMostDatagramBytes);
  while (points.size() < 130) longer();
  EXPECT_FALSE(fits(test::drive(kNow_s, points, 1.0)));
  EXPECT_THROW(encoded(trajectory_of(test::drive(kNow_s, points, 1.0))), std::invalid_argument);
}

TEST(WireFormat, RefusesWhatCannotBeSaid) {
  const Motion far = test::drive(kNow_s, {{0.0, 0.0}, {3e4, 0.0}}, 20.0);
  EXPECT_FALSE(fits(far));
  EXPECT_THROW(encoded(trajectory_of(far)), std::invalid_argument);
  EXPECT_FALSE(fits(test::stand(kNow_s, {1e12, 0.0})));
  EXPECT_FALSE(fits(Motion()));
  EXPECT_THROW(encoded(trajectory_of(test::stand(1e11, {0.0, 0.0}))), std::invalid_argument);
  CommittedTrajectory nameless = trajectory_of(test::stand(kNow_s, {0.0, 0.0}));
  nameless.agent = "two words";
  EXPECT_THROW(encoded(nameless), std::invalid_argument);
  nameless.agent = std::string(64, 'a');
  EXPECT_THROW(encoded(nameless), std::invalid_argument);
  Heartbeat timeless = heartbeat();
  timeless.stamp_s = std::nan("");
  EXPECT_THROW(encoded(timeless), std::invalid_argument);
  Heartbeat crowded = heartbeat();
  crowded.acknowledgements.resize(300, crowded.acknowledgements[0]);
  EXPECT_THROW(encoded(crowded), std::invalid_argument);
}

TEST(WireFormat, RefusesOtherVersionsPartsAndMore) {
  for (Bytes bytes : {encoded(heartbeat()), encoded(trajectory_of(test::stand(kNow_s, {1.0, 2.0}))),
                      encoded(passing_intent()), encoded(passing_instruction())}) {
    for (std::size_t size = 0; size < bytes.size(); ++size)
      EXPECT_THROW(decode(bytes.data(), size), std::invalid_argument) << size;
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_THROW(decoded(longer), std::invalid_argument);
    longer[kSizeAt + 1] += 1;  // and says so
    EXPECT_THROW(decoded(longer), std::invalid_argument);
    bytes[8] += 1;
    EXPECT_THROW(decoded(bytes), std::invalid_argument);
  }
}

const FleetKey kKey(FleetKey::Secret{1, 2, 3});
const FleetKey kOtherKey(FleetKey::Secret{1, 2, 4});

SealFault fault_of(const Bytes& bytes, const FleetKey* key) {
  try {
    decode(bytes.data(), bytes.size(), key);
  } catch (const SealError& error) {
    return error.fault;
  }
  throw std::logic_error("nothing was wrong with the seal");
}

TEST(WireFormat, KnowsItsFleetByTheSeal) {
  const Bytes sealed = encode({17, heartbeat()}, &kKey);
  const Datagram heard = decode(sealed.data(), sealed.size(), &kKey);
  EXPECT_EQ(heard.number, 17U);
  EXPECT_EQ(std::get<Heartbeat>(heard.message).agent, "ugv1");
  EXPECT_EQ(fault_of(sealed, &kOtherKey), SealFault::kForeignSeal);
  EXPECT_EQ(fault_of(sealed, nullptr), SealFault::kNoKey);
  EXPECT_EQ(fault_of(encoded(heartbeat()), &kKey), SealFault::kUnsealed);
}

TEST(WireFormat, NoBitOfASealedDatagramCanBeChanged) {
  const Bytes sealed = encode({17, trajectory_of(test::stand(kNow_s, {1.0, 2.0}))}, &kKey);
  for (std::size_t bit = 0; bit < 8 * sealed.size(); ++bit) {
    Bytes mutant = sealed;
    mutant[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_THROW(decode(mutant.data(), mutant.size(), &kKey), std::invalid_argument) << bit;
  }
  Bytes stripped = sealed;
  stripped[kSealAt - 1] = 0;
  std::fill_n(stripped.begin() + kSealAt, FleetKey::kSealBytes, std::uint8_t{0});
  EXPECT_EQ(fault_of(stripped, &kKey), SealFault::kUnsealed);
}

TEST(WireFormat, HeartbeatsThatAreTooLongAreDivided) {
  Heartbeat crowded = heartbeat();
  for (int i = 0; i < 200; ++i) {
    const std::string name = "a_robot_with_a_long_name_" + std::to_string(i);
    crowded.acknowledgements.push_back(
        {name, {1, static_cast<std::uint32_t>(i)}, TrajectoryState::kCommitted});
    crowded.echoes.push_back({name, kNow_s + i, 0.01 * i});
  }
  EXPECT_THROW(encoded(crowded), std::invalid_argument);
  std::size_t lines = 0;
  std::size_t echoes = 0;
  for (const Heartbeat& part : in_datagrams(crowded)) {
    const Heartbeat heard = std::get<Heartbeat>(decoded(encoded(part)));
    EXPECT_EQ(heard.acknowledgements.at(0).agent, "ugv1");  // about itself
    EXPECT_EQ(heard.stamp_s, part.stamp_s);
    lines += heard.acknowledgements.size() - 1;
    echoes += heard.echoes.size();
  }
  EXPECT_EQ(lines, crowded.acknowledgements.size() - 1);
  EXPECT_EQ(echoes, crowded.echoes.size());
  ASSERT_EQ(in_datagrams(heartbeat()).size(), 1U);
  EXPECT_EQ(encoded(in_datagrams(heartbeat())[0]), encoded(heartbeat()));
}

/// Whatever comes is a message that encoded() could have made, or is refused.
TEST(WireFormat, MutantsAreRefusedOrSound) {
  std::mt19937 random(5);
  std::vector<Bytes> seeds = {encoded(heartbeat()), encoded(passing_intent()),
                              encoded(passing_instruction())};
  for (int i = 0; i < 20; ++i) seeds.push_back(encoded(trajectory_of(any(i, random, kNow_s))));
  std::uniform_int_distribution<int> byte(0, 255);
  int refused = 0;
  int sound = 0;
  for (int run = 0; run < 30000; ++run) {
    Bytes mutant = seeds[run % seeds.size()];
    const int changes = 1 + run % 4;
    for (int i = 0; i < changes; ++i) {
      // Mostly in the body: what is before it is looked at first.
      const std::size_t from = run % 10 == 0 ? 0 : kSizeAt + 2;
      const std::size_t at = from + random() % (mutant.size() - from);
      mutant[at] = static_cast<std::uint8_t>(random() % 3 == 0 ? mutant[at] ^ (1 << random() % 8)
                                                               : byte(random));
    }
    try {
      const FleetMessage message = decoded(mutant);
      ++sound;
      EXPECT_NO_THROW(encoded(message));
    } catch (const std::invalid_argument& error) {
      ++refused;
      ASSERT_STRNE(error.what(), "");
    }
  }
  EXPECT_GT(refused, 3000);
  EXPECT_GT(sound, 3000);
}

/// The bytes of some promises, and where their motions are to the last bit: the same on every
/// machine and in every version of this format. On arm64, scripts/build_arm64 runs this; there it
/// fails where the compiler may contract a * b + c (-ffp-contract).
TEST(WireFormat, AgreesWithWhatWasStored) {
  std::ifstream file("test/fleet/wire/wire_vectors.txt");
  ASSERT_TRUE(file);
  int vectors = 0;
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string hex;
    words >> hex;
    if (hex.empty() || hex[0] == '#') continue;
    Bytes bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2)
      bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    const CommittedTrajectory trajectory = std::get<CommittedTrajectory>(decoded(bytes));
    EXPECT_EQ(encoded(trajectory), bytes);
    std::string x, y;
    for (double after_s = 0.35; words >> x >> y; after_s += 0.7) {
      const Vector2 place = trajectory.motion->position(trajectory.motion->start_time() + after_s);
      EXPECT_EQ(place.x(), std::strtod(x.c_str(), nullptr)) << after_s;
      EXPECT_EQ(place.y(), std::strtod(y.c_str(), nullptr)) << after_s;
    }
    ++vectors;
  }
  EXPECT_GE(vectors, 5);
}

TEST(WireFormat, DISABLED_WriteVectors) {
  std::mt19937 random(9);
  std::ofstream file("test/fleet/wire/wire_vectors.txt");
  file << "# A promise a line: its datagram in hexadecimal, then x and y [m] of its motion 0.35 s "
          "after its start and every 0.7 s on.\n"
          "# Written by test_fleet --gtest_also_run_disabled_tests --gtest_filter=*WriteVectors; "
          "format version "
       << kWireVersion << ".\n";
  for (int i = 0; i < 6; ++i) {
    const CommittedTrajectory trajectory =
        quantised(trajectory_of(any(i, random, kNow_s + 0.1234567 * i)));
    char text[64];
    for (const std::uint8_t byte : encoded(trajectory)) {
      snprintf(text, sizeof text, "%02x", byte);
      file << text;
    }
    for (double after_s = 0.35; after_s < 4.5; after_s += 0.7) {
      const Vector2 place = trajectory.motion->position(trajectory.motion->start_time() + after_s);
      snprintf(text, sizeof text, " %a %a", place.x(), place.y());
      file << text;
    }
    file << "\n";
  }
}

}  // namespace
}  // namespace mocha
