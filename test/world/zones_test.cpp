#include "world/zones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "world/world_file.h"

namespace mocha {
namespace {

constexpr char kText[] = R"(
keep_out:
  - [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]
  - {name: stairs, polygon: [[5, 0], [6, 0], [6, 1]]}
speed_zones:
  - {polygon: [[0, 5], [3, 5], [3, 8]], max_speed: 0.3}
)";

std::string refusal(const std::string& text) {
  try {
    parse_zones(text, "zones");
  } catch (const WorldError& error) {
    return error.what();
  }
  return "";
}

Zone square(const std::string& name, double max_speed) {
  return {name, Polygon{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}, max_speed};
}

TEST(Zones, AreReadWithTheirNamesAndSpeeds) {
  const Zones zones = parse_zones(kText, "zones");
  ASSERT_EQ(zones.size(), 3u);
  EXPECT_EQ(zones[0].name, "keep_out[0]");
  EXPECT_EQ(zones[0].area.corners.size(), 4u);
  EXPECT_TRUE(zones[0].keeps_out());
  EXPECT_EQ(zones[1].name, "stairs");
  EXPECT_EQ(zones[2].name, "speed_zones[0]");
  EXPECT_FALSE(zones[2].keeps_out());
  EXPECT_EQ(zones[2].max_speed, 0.3);
  EXPECT_EQ(kept_out_of(zones).size(), 2u);
}

TEST(Zones, AreFoundByPlaceUnlessTheyMayBeEntered) {
  const Zones zones = parse_zones(kText, "zones");
  ASSERT_NE(keep_out_zone_at(zones, {5.9, 0.5}), nullptr);
  EXPECT_EQ(keep_out_zone_at(zones, {5.9, 0.5})->name, "stairs");
  EXPECT_EQ(keep_out_zone_at(zones, {5.1, 0.9}), nullptr);
  EXPECT_EQ(keep_out_zone_at(zones, {2.0, 5.5}), nullptr);
}

TEST(Zones, AreWrittenAsTheyAreRead) {
  const Zones zones = parse_zones(kText, "zones");
  const Zones again = parse_zones(to_yaml(zones), "again");
  ASSERT_EQ(again.size(), zones.size());
  for (std::size_t i = 0; i < zones.size(); ++i) {
    EXPECT_EQ(again[i].name, zones[i].name);
    EXPECT_EQ(again[i].max_speed, zones[i].max_speed);
    EXPECT_EQ(again[i].area.corners, zones[i].area.corners);
  }
  EXPECT_TRUE(parse_zones(to_yaml({}), "none").empty());
}

TEST(Zones, ErrorsNameKeyAndValue) {
  const auto says = [](const std::string& text, const std::string& expected) {
    EXPECT_NE(refusal(text).find(expected), std::string::npos) << refusal(text);
  };
  says("keep_out: [[[0, 0], [1, 0]]]", "keep_out[0]");
  says("keep_out: [{polygon: [[0, 0], [2, 2], [2, 0], [0, 2]]}]", "keep_out[0].polygon");
  says("speed_zones: [{polygon: [[0, 0], [1, 0], [1, 1]]}]",
       "speed_zones[0].max_speed: is missing");
  says("speed_zones: [{polygon: [[0, 0], [1, 0], [1, 1]], max_speed: 0}]",
       "speed_zones[0].max_speed = 0: must be more than 0");
  says("speed_zones: [{polygon: [[0, 0], [1, 0], [1, 1]], max_speed: .nan}]", "is not finite");
  says("slow: []", "slow");
  says(
      "keep_out: [{name: a, polygon: [[0, 0], [1, 0], [1, 1]]}, "
      "{name: a, polygon: [[0, 0], [1, 0], [1, 1]]}]",
      "zone `a`: two zones have this name");
  EXPECT_THROW(load_zones("/none.yaml"), WorldError);
}

TEST(Zones, AreCheckedWhereverTheyComeFrom) {
  EXPECT_NO_THROW(check({square("a", 0.0), square("b", 0.5)}));
  EXPECT_THROW(check({square("a", -0.1)}), std::invalid_argument);
  EXPECT_THROW(check({square("a", std::nan(""))}), std::invalid_argument);
  EXPECT_THROW(check({square("a", 0.0), square("a", 0.5)}), std::invalid_argument);
  EXPECT_THROW(check({Zone{"a", Polygon{{{0.0, 0.0}, {1.0, 0.0}}}, 0.0}}), std::invalid_argument);
}

TEST(Zones, AWorldFileHoldsThem) {
  EXPECT_EQ(load_zones("test/worlds/zones.yaml").size(), 2u);
  EXPECT_EQ(load_world("test/worlds/zones.yaml", "config").zones.size(), 2u);
}

}  // namespace
}  // namespace mocha
