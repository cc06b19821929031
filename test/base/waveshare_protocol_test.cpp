#include "base/waveshare_protocol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const std::string kFeedback =
    R"({"T":1001,"L":0.25,"R":-0.5,"ax":-12,"ay":3,"az":8200,"gx":1,"gy":-2,"gz":160,)"
    R"("mx":7,"my":8,"mz":9,"odl":-17,"odr":123456,"v":1185})"
    "\r\n";

nlohmann::json drive(double left, double right) {
  const std::string line = waveshare_drive({left, right});
  EXPECT_EQ(line.back(), '\n');
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  return nlohmann::json::parse(line);
}

/// kFeedback with one value replaced by the text given.
std::string with(const std::string& key, const std::string& value) {
  const std::size_t at = kFeedback.find("\"" + key + "\":") + key.size() + 3;
  return kFeedback.substr(0, at) + value + kFeedback.substr(kFeedback.find_first_of(",}", at));
}

TEST(WaveshareProtocol, DrivesWithWheelSpeeds) {
  const auto line = drive(0.5, -0.25);
  EXPECT_EQ(line["T"], 1);
  EXPECT_EQ(line["L"], 0.5);
  EXPECT_EQ(line["R"], -0.25);
  EXPECT_EQ(waveshare_drive({0.1 + 0.2, 1e-7}), "{\"T\":1,\"L\":0.3,\"R\":0.0}\n");
}

TEST(WaveshareProtocol, ClampsToWhatTheFirmwareTakesAndKeepsTheCurvature) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> speed(-8.0, 8.0);
  for (int i = 0; i < 1000; ++i) {
    const double left = speed(random);
    const double right = speed(random);
    const auto line = drive(left, right);
    const double l = line["L"];
    const double r = line["R"];
    EXPECT_LE(std::abs(l), 2.0);
    EXPECT_LE(std::abs(r), 2.0);
    EXPECT_NEAR(l * right, r * left, 1e-3) << left << " " << right;
    if (std::abs(left) <= 2.0 && std::abs(right) <= 2.0) {
      EXPECT_NEAR(l, left, 1e-4);
      EXPECT_NEAR(r, right, 1e-4);
    }
  }
  EXPECT_EQ(drive(1e300, -1e300)["R"], -2.0);
}

TEST(WaveshareProtocol, WhatIsNotFiniteStands) {
  for (const double bad : {kInfinity, -kInfinity, std::nan("")}) {
    EXPECT_EQ(waveshare_drive({bad, 0.5}), waveshare_drive({0.0, 0.0}));
    EXPECT_EQ(waveshare_drive({0.5, bad}), waveshare_drive({0.0, 0.0}));
  }
}

TEST(WaveshareProtocol, TellsAWholePwmWithinItsRange) {
  EXPECT_EQ(waveshare_pwm(63.5, -0.4), "{\"T\":11,\"L\":64,\"R\":0}\n");
  EXPECT_EQ(waveshare_pwm(1e300, -1e300), "{\"T\":11,\"L\":255,\"R\":-255}\n");
  for (const double bad : {kInfinity, -kInfinity, std::nan("")}) {
    EXPECT_EQ(waveshare_pwm(bad, 100.0), waveshare_pwm(0.0, 0.0));
    EXPECT_EQ(waveshare_pwm(100.0, bad), waveshare_pwm(0.0, 0.0));
  }
}

TEST(WaveshareProtocol, SetsTheHeartbeatBeforeAnythingElse) {
  const auto lines = waveshare_setup({3, 250, 40});
  EXPECT_EQ(lines.at(0), "{\"T\":136,\"cmd\":250}\n");
  std::string all;
  for (const auto& line : lines) all += line;
  EXPECT_NE(all.find("{\"T\":143,\"cmd\":0}\n"), std::string::npos);
  EXPECT_NE(all.find("{\"T\":900,\"main\":3,\"module\":0}\n"), std::string::npos);
  EXPECT_NE(all.find("{\"T\":142,\"cmd\":40}\n"), std::string::npos);
  EXPECT_NE(all.find("{\"T\":131,\"cmd\":1}\n"), std::string::npos);
  EXPECT_EQ(all.find("\"T\":13,"), std::string::npos);
}

TEST(WaveshareDecoder, ReadsFeedback) {
  WaveshareDecoder decoder;
  const auto feedback = decoder.take(kFeedback);
  ASSERT_EQ(feedback.size(), 1u);
  EXPECT_EQ(feedback[0].speeds.left, 0.25);
  EXPECT_EQ(feedback[0].speeds.right, -0.5);
  EXPECT_EQ(feedback[0].left_cm, -17);
  EXPECT_EQ(feedback[0].right_cm, 123456);
  EXPECT_NEAR(feedback[0].battery_v, 11.85, 1e-12);
  ASSERT_TRUE(feedback[0].imu);
  EXPECT_EQ(feedback[0].imu->acceleration[2], 8200.0);
  EXPECT_EQ(feedback[0].imu->rate[2], 160.0);
  EXPECT_EQ(decoder.counts().refused(), 0);
}

TEST(WaveshareDecoder, FeedbackMayComeInAnyPieces) {
  const std::string text = kFeedback + kFeedback + "\n" + kFeedback;
  for (std::size_t piece = 1; piece < text.size(); ++piece) {
    WaveshareDecoder decoder;
    std::size_t count = 0;
    for (std::size_t at = 0; at < text.size(); at += piece)
      count += decoder.take(text.substr(at, piece)).size();
    ASSERT_EQ(count, 3u) << piece;
    ASSERT_EQ(decoder.counts().refused(), 0) << piece;
  }
}

TEST(WaveshareDecoder, EchoesAreNoFeedbackAndNoFault) {
  WaveshareDecoder decoder;
  EXPECT_TRUE(decoder.take(waveshare_drive({0.5, 0.5}) + "{\"T\":131,\"cmd\":1}\n{}\n").empty());
  EXPECT_EQ(decoder.counts().other, 3);
  EXPECT_EQ(decoder.counts().refused(), 0);
}

TEST(WaveshareDecoder, HalfLinesAndNoiseAreCountedAndTheNextLineIsRead) {
  WaveshareDecoder decoder;
  const std::string half = kFeedback.substr(0, 60);
  EXPECT_TRUE(decoder.take(half + "\n").empty());           // its end was lost
  EXPECT_TRUE(decoder.take(kFeedback.substr(60)).empty());  // its beginning was lost
  EXPECT_TRUE(decoder.take(half + kFeedback).empty());      // both, of two lines
  EXPECT_TRUE(decoder.take("UGV started.\r\n").empty());
  EXPECT_TRUE(decoder.take(std::string("\0\xff\x80{\"T\":1001\n", 13)).empty());
  EXPECT_EQ(decoder.counts().garbage, 5);
  EXPECT_EQ(decoder.take(kFeedback).size(), 1u);
  EXPECT_NE(decoder.last_refusal().find("no JSON"), std::string::npos);
  for (const char c : decoder.last_refusal()) EXPECT_TRUE(c >= ' ' && c <= '~');
}

TEST(WaveshareDecoder, EveryFieldIsChecked) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> damages = {
      {"L", {"11", "-11", "null", "\"0.1\"", "[]", "true"}},
      {"R", {"10.5", "1e300"}},
      {"odl", {"0.5", "1e12", "\"3\"", "null"}},
      {"odr", {"-1e10", "2.25"}},
      {"v", {"-1", "10001", "{}"}},
      {"ax", {"32769", "null"}},
      {"gz", {"-40000"}},
  };
  long bad = 0;
  WaveshareDecoder decoder;
  for (const auto& [key, values] : damages) {
    for (const std::string& value : values) {
      EXPECT_TRUE(decoder.take(with(key, value)).empty()) << key << " " << value;
      EXPECT_NE(decoder.last_refusal().find("`" + key + "`"), std::string::npos)
          << decoder.last_refusal();
      EXPECT_EQ(decoder.counts().implausible, ++bad) << key << " " << value;
    }
  }
  for (const char* key : {"L", "R", "odl", "odr", "v", "gy"}) {
    const std::string named = std::string("\"") + key + "\"";
    std::string line = kFeedback;
    line.replace(line.find(named), named.size(), "\"?\"");
    EXPECT_TRUE(decoder.take(line).empty()) << key;
    EXPECT_EQ(decoder.counts().implausible, ++bad) << key;
  }
  // Numbers that no double can hold are no JSON to the parser.
  EXPECT_TRUE(decoder.take(with("L", "1e999")).empty());
  EXPECT_TRUE(decoder.take(with("L", "NaN")).empty());
  EXPECT_EQ(decoder.counts().garbage, 2);
  EXPECT_EQ(decoder.counts().feedback, 0);
}

TEST(WaveshareDecoder, FirmwareWithoutAnImuIsUnderstood) {
  WaveshareDecoder decoder;
  const auto feedback =
      decoder.take("{\"T\":1001,\"L\":0,\"R\":0,\"r\":1.5,\"p\":2,\"odl\":0,\"odr\":0,\"v\":0}\n");
  ASSERT_EQ(feedback.size(), 1u);
  EXPECT_FALSE(feedback[0].imu);
}

TEST(WaveshareDecoder, ALineWithoutEndTakesNoMemoryAndIsCountedOnce) {
  LineBuffer lines(100);
  EXPECT_TRUE(lines.add(std::string(10000, 'x')).empty());
  EXPECT_EQ(lines.overlong(), 1);
  EXPECT_EQ(lines.add("x\nabc\n"), std::vector<std::string>{"abc"});
  EXPECT_EQ(lines.add(std::string(100, 'y') + "\n"),
            std::vector<std::string>{std::string(100, 'y')});
  EXPECT_EQ(lines.overlong(), 1);

  WaveshareDecoder decoder;
  EXPECT_TRUE(decoder.take(std::string(10000, '{')).empty());
  EXPECT_TRUE(decoder.take("\n").empty());
  EXPECT_EQ(decoder.counts().overlong, 1);
  EXPECT_EQ(decoder.take(kFeedback).size(), 1u);
}

TEST(WaveshareDecoder, ANewConnectionDropsHalfALine) {
  WaveshareDecoder decoder;
  decoder.restart();
  EXPECT_EQ(decoder.counts().garbage, 0);
  decoder.take(kFeedback.substr(0, 30));
  decoder.restart();
  EXPECT_EQ(decoder.counts().garbage, 1);
  EXPECT_EQ(decoder.take(kFeedback).size(), 1u);
}

/// Random bytes, and real lines with bytes changed, lost and added: nothing crashes, every line is
/// accounted for, and what passes is in range.
TEST(WaveshareDecoder, SurvivesNoise) {
  std::mt19937 random(7);
  const auto pick = [&](int count) { return static_cast<int>(random() % count); };
  const std::string whole = kFeedback.substr(0, kFeedback.size() - 2);
  WaveshareDecoder decoder;
  long lines = 0;
  for (int i = 0; i < 200000; ++i) {
    std::string line = pick(3) == 0 ? std::string(pick(300), '\0') : whole;
    if (line != whole) {
      for (char& c : line) c = static_cast<char>(pick(256));
    } else {
      for (int damage = pick(4); damage >= 0; --damage) {
        const int at = pick(static_cast<int>(line.size()));
        if (pick(3) == 0)
          line.erase(at, 1 + pick(10));
        else if (pick(2) == 0)
          line.insert(at, 1, static_cast<char>(pick(256)));
        else
          line[at] = static_cast<char>(pick(2) == 0 ? pick(256) : '0' + pick(10));
      }
    }
    for (char& c : line) c = c == '\n' || c == '\r' ? 'x' : c;
    lines += line.empty() ? 0 : 1;
    for (const WaveshareFeedback& feedback : decoder.take(line + "\n")) {
      ASSERT_LE(std::abs(feedback.speeds.left), 10.0);
      ASSERT_LE(std::abs(feedback.speeds.right), 10.0);
      ASSERT_LE(std::abs(feedback.left_cm), 1000000000);
      ASSERT_TRUE(feedback.battery_v >= 0.0 && feedback.battery_v <= 100.0);
    }
  }
  const auto counts = decoder.counts();
  EXPECT_EQ(counts.feedback + counts.other + counts.refused(), lines);
  EXPECT_GT(counts.feedback, 0);
  EXPECT_GT(counts.garbage, 0);
  EXPECT_GT(counts.implausible, 0);
}

}  // namespace
}  // namespace mocha
