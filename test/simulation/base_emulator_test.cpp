#include "simulation/base_emulator.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "simulation/pseudo_terminal.h"

namespace mocha {
namespace {

using Json = nlohmann::json;

void expect_wheels(BaseEmulator& base, double now_s, double left, double right) {
  const WheelSpeeds wheels = base.order(now_s).wheels;
  EXPECT_EQ(wheels.left, left) << "at " << now_s;
  EXPECT_EQ(wheels.right, right) << "at " << now_s;
}

TEST(BaseEmulator, TheHeartbeatStopsTheWheels) {
  BaseEmulator base(0.0);
  base.receive(0.0, "{\"T\":1,\"L\":0.5,\"R\":0.25}\n");
  expect_wheels(base, 3.0, 0.5, 0.25);  // 3000 ms unless told otherwise
  expect_wheels(base, 3.01, 0.0, 0.0);
  base.receive(4.0, "{\"T\":136,\"cmd\":300}\n{\"T\":1,\"L\":0.5,\"R\":0.5}\n");
  expect_wheels(base, 4.3, 0.5, 0.5);
  expect_wheels(base, 4.31, 0.0, 0.0);
}

TEST(BaseEmulator, WhatIsOutOfRangeIsIgnoredButKeepsTheHeartbeatAlive) {
  BaseEmulator base(0.0);
  base.receive(0.0, "{\"T\":136,\"cmd\":300}\n{\"T\":1,\"L\":0.5,\"R\":0.5}\n");
  for (int i = 1; i < 10; ++i) {
    base.receive(0.2 * i, "{\"T\":1,\"L\":2.01,\"R\":0.0}\n");
    expect_wheels(base, 0.2 * i, 0.5, 0.5);
  }
  base.receive(2.0, "{\"T\":1,\"L\":\"0\",\"R\":0}\n");  // no number: no command at all
  expect_wheels(base, 2.15, 0.0, 0.0);
}

TEST(BaseEmulator, VelocitiesAreNotUnderTheHeartbeat) {
  BaseEmulator base(0.0);
  base.receive(0.0, "{\"T\":900,\"main\":3,\"module\":0}\n{\"T\":1,\"L\":0.1,\"R\":0.1}\n");
  base.receive(2.0, "{\"T\":13,\"X\":0.5,\"Z\":1.0}\n");
  EXPECT_NEAR(base.order(2.0).wheels.left, 0.5 - 0.0705, 1e-12);
  expect_wheels(base, 3.01, 0.0, 0.0);  // of the T 1 before
  base.receive(4.0, "{\"T\":13,\"X\":0.5,\"Z\":0.0}\n");
  expect_wheels(base, 1000.0, 0.5, 0.5);  // it has fired: nothing stops this
}

TEST(BaseEmulator, PwmIsUnderTheHeartbeat) {
  BaseEmulator base(0.0);
  base.receive(0.0, "{\"T\":136,\"cmd\":300}\n{\"T\":11,\"L\":164,\"R\":-300}\n");
  EXPECT_TRUE(base.order(0.3).by_pwm);
  expect_wheels(base, 0.3, 164.0, -255.0);
  EXPECT_NEAR(base.wheels(0.3).left, 1.3 / 220.0 * (164.0 - 35.0), 1e-9);
  expect_wheels(base, 0.31, 0.0, 0.0);
  EXPECT_EQ(base.wheels(0.31).left, 0.0);
}

TEST(BaseEmulator, HoldsAnEmergencyStopWhereItsFirmwareDoes) {
  for (const bool holds : {true, false}) {
    BaseEmulator base(0.0, {holds, {}, {}});
    base.receive(0.0, "{\"T\":1,\"L\":0.5,\"R\":0.5}\n{\"T\":0}\n");
    expect_wheels(base, 0.0, 0.0, 0.0);
    base.receive(0.1, "{\"T\":1,\"L\":0.5,\"R\":0.5}\n");
    expect_wheels(base, 0.1, holds ? 0.0 : 0.5, holds ? 0.0 : 0.5);
    base.receive(0.2, "{\"T\":999}\n{\"T\":1,\"L\":0.25,\"R\":0.5}\n");
    expect_wheels(base, 0.2, 0.25, 0.5);
  }
}

TEST(BaseEmulator, EchoesUntilToldNotTo) {
  BaseEmulator base(0.0);
  EXPECT_EQ(base.send(0.0), "UGV started.\r\n");
  base.receive(0.0, "{\"T\":1,\"L\":0,\"R\":0}\nnoise\n");
  EXPECT_EQ(base.send(0.01), "{\"T\":1,\"L\":0,\"R\":0}\n");
  base.receive(0.0, "{\"T\":143,\"cmd\":0}\n");
  base.send(0.02);
  base.receive(0.0, "{\"T\":1,\"L\":0,\"R\":0}\n");
  EXPECT_EQ(base.send(0.03), "");
}

TEST(BaseEmulator, SendsFeedbackAtItsInterval) {
  BaseEmulator base(0.0);
  base.receive(0.0, "{\"T\":143,\"cmd\":0}\n{\"T\":142,\"cmd\":20}\n");
  base.send(0.0);
  base.roll(0.1999, -0.1999, {0.5, -0.5});
  base.feel(0.0, 1.0);
  int count = 0;
  std::string text;
  for (int i = 1; i <= 100; ++i) {
    const std::string sent = base.send(0.01 * i);
    count += sent.empty() ? 0 : 1;
    if (!sent.empty()) text = sent;
  }
  EXPECT_EQ(count, 50);
  const Json line = Json::parse(text);
  EXPECT_EQ(line["T"], 1001);
  EXPECT_NEAR(line["L"], 0.38, 0.01);  // 0.5 in whole pulses of a millisecond
  EXPECT_EQ(line["odl"], 19);          // cut, not rounded
  EXPECT_EQ(line["odr"], -19);
  EXPECT_EQ(line["az"], 8192);
  EXPECT_NEAR(line["gz"], 16.4 * 57.2958 * (1.0 + 0.012), 5.0 * 16.4 * 57.2958 * 0.004);
  base.receive(1.0, "{\"T\":131,\"cmd\":0}\n");
  EXPECT_EQ(base.send(2.0), "");
}

TEST(BaseEmulator, HalfALineWaitsForItsRestAndSpoilsTheNext) {
  BaseEmulator base(0.0);
  base.receive(0.0, "{\"T\":1,\"L\":0.5,");
  expect_wheels(base, 0.0, 0.0, 0.0);
  base.receive(0.1, "\"R\":0.5}\n");
  expect_wheels(base, 0.1, 0.5, 0.5);
  base.receive(0.2, "{\"T\":1,\"L\":0.1{\"T\":1,\"L\":0.1,\"R\":0.1}\n");
  expect_wheels(base, 0.2, 0.5, 0.5);
  base.receive(0.3, "\n{\"T\":1,\"L\":0.1,\"R\":0.1}\n");
  expect_wheels(base, 0.3, 0.1, 0.1);
}

TEST(BaseEmulator, ARestartForgets) {
  BaseEmulator base(0.0);
  base.receive(0.0,
               "{\"T\":136,\"cmd\":300}\n{\"T\":143,\"cmd\":0}\n{\"T\":1,\"L\":0.5,\"R\":0.5}\n");
  base.roll(5.0, 5.0, {0.5, 0.5});
  base.restart(1.0);
  expect_wheels(base, 1.0, 0.0, 0.0);
  base.receive(1.0, "{\"T\":1,\"L\":0.5,\"R\":0.5}\n");
  expect_wheels(base, 3.9, 0.5, 0.5);
  const std::string text = base.send(1.06);
  EXPECT_NE(text.find("\"odl\":0,"), std::string::npos) << text;
}

TEST(BaseEmulator, SurvivesNoise) {
  std::mt19937 random(5);
  BaseEmulator base(0.0);
  for (int i = 0; i < 20000; ++i) {
    std::string bytes(random() % 64, '\0');
    for (char& c : bytes) c = "{}\"T:,0123456789-.eLRcmd[]\n"[random() % 27];
    base.receive(0.001 * i, bytes);
    const WheelSpeeds wheels = base.wheels(0.001 * i);
    ASSERT_LE(std::abs(wheels.left), 255.0);
    ASSERT_LE(std::abs(wheels.right), 255.0);
    base.send(0.001 * i);
  }
}

TEST(PseudoTerminal, RefusesToReplaceWhatIsNoLink) {
  EXPECT_THROW(PseudoTerminal("/tmp"), std::system_error);
  EXPECT_NO_THROW(PseudoTerminal(""));
}

}  // namespace
}  // namespace mocha
