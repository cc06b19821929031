#include "world/world_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace mocha {
namespace {

namespace fs = std::filesystem;

const char kBounds[] = "bounds: {min: [-5, -5], max: [5, 5]}\n";
const char kRobot[] = "{name: ugv1, model: rover, start: [0, 0, 0]}";

class WorldFileTest : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::temp_directory_path() / ("mocha_world_" + std::to_string(::getpid()) + ".yaml");
  }
  void TearDown() override { fs::remove(path_); }

  World load(const std::string& text) {
    std::ofstream(path_) << text;
    return load_world(path_.string(), "config");
  }

  /// Expects one line that names the file and contains every part.
  void expect_refusal(const std::string& text, const std::vector<std::string>& parts) {
    try {
      load(text);
      ADD_FAILURE() << "accepted:\n" << text;
    } catch (const WorldError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.rfind(path_.string() + ": ", 0), 0u) << what;
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      for (const std::string& part : parts) EXPECT_NE(what.find(part), std::string::npos) << what;
    }
  }

  void expect_refused_robot(const std::string& robot, const std::vector<std::string>& parts) {
    expect_refusal(kBounds + ("robots: [" + robot + "]\n"), parts);
  }

  fs::path path_;
};

TEST_F(WorldFileTest, AModelNamedByItsPathIsLookedForBesideTheWorld) {
  const fs::path model = fs::path(path_).replace_extension(".robot.yaml");
  std::ofstream(model) << "max_speed: 0.4";
  for (const std::string& name : {model.filename().string(), model.string()}) {
    const World world =
        load(kBounds + ("robots: [{name: a, model: " + name + ", start: [0, 0, 0]}]\n"));
    EXPECT_EQ(world.robots[0].model.limits.max_speed, 0.4);
    EXPECT_EQ(world.robots[0].model.name, model.string());
  }
  fs::remove(model);
  expect_refused_robot("{name: a, model: absent.yaml, start: [0, 0, 0]}",
                       {"robots[0].model = absent.yaml", "absent.yaml"});
  expect_refused_robot("{name: a, model: robots/rover, start: [0, 0, 0]}",
                       {"robots[0].model", "nor a path"});
}

TEST_F(WorldFileTest, ReadsEverything) {
  const World world = load(R"(
bounds: {min: [-10, -5], max: [10, 5]}
optimal_time: 7.5
circles: [[1, 2, 0.5], [-3, 1.5, 0.25]]
polygons: [[[4, -4], [6, -4], [5, -2]]]
keep_out: [[[-8, -4], [-7, -4], [-7, -3], [-8, -3], [-8, -4]]]
moving: [{radius: 0.3, speed: 0.8, loop: true, path: [[0, 3], [3, 3]]}, {radius: 0.2, speed: 0, path: [[8, 0]]},
         {radius: 0.5, repeat: true, keyframes: [[0, 1, 4], [0.5, 2, 4]]}, {radius: 0.25, keyframes: [[2, 1, 4], [2.5, 2, 4], [7, 2, 4]]}]
robots:
  - {name: ugv1, model: rover, start: [0, 0, 1.5], goal: [3, 0, -0.5]}
  - {name: ugv2, model: jackal, start: [-2, 0, 0], goal: [3, -2], radius: 0.4}
  - {name: ugv3, model: jackal, start: [-5, 0, 0], footprint: [0.8, 0.6]}
  - {name: ugv4, model: rover, start: [-5, 3, 0], footprint: [[0.4, 0], [-0.2, 0.3], [-0.2, -0.3]]}
)");
  EXPECT_EQ(world.bounds.max().x(), 10.0);
  EXPECT_EQ(world.optimal_time_s, 7.5);
  ASSERT_EQ(world.circles.size(), 2u);
  EXPECT_EQ(world.circles[1].centre, Vector2(-3.0, 1.5));
  EXPECT_EQ(world.circles[1].radius_m, 0.25);
  ASSERT_EQ(world.polygons.size(), 1u);
  EXPECT_EQ(world.polygons[0].corners[2], Vector2(5.0, -2.0));
  ASSERT_EQ(world.zones.size(), 1u);
  EXPECT_EQ(world.zones[0].area.corners.size(), 4u);  // closed explicitly
  ASSERT_EQ(world.moving.size(), 4u);
  EXPECT_EQ(world.moving[0].after_last, AfterLast::kRepeats);
  ASSERT_EQ(world.moving[0].keyframes.size(), 3u);
  EXPECT_EQ(world.moving[0].keyframes[1].time_s, 3.0 / 0.8);
  EXPECT_EQ(world.moving[0].keyframes[2].place, Vector2(0.0, 3.0));
  EXPECT_EQ(world.moving[1].after_last, AfterLast::kStands);
  EXPECT_EQ(world.moving[2].after_last, AfterLast::kRepeats);
  EXPECT_EQ(world.moving[2].radius_m, 0.5);
  EXPECT_EQ(world.moving[3].after_last, AfterLast::kLeaves);
  ASSERT_EQ(world.moving[3].keyframes.size(), 3u);
  EXPECT_EQ(world.moving[3].keyframes[1].time_s, 2.5);
  EXPECT_EQ(world.moving[3].keyframes[1].place, Vector2(2.0, 4.0));
  ASSERT_EQ(world.robots.size(), 4u);
  EXPECT_EQ(world.robots[0].start.yaw_rad, 1.5);
  EXPECT_EQ(world.robots[0].goal->yaw_rad, -0.5);
  EXPECT_EQ(world.robots[0].model.name, "rover");
  EXPECT_FALSE(world.robots[1].goal->yaw_rad.has_value());
  EXPECT_TRUE(world.robots[1].model.footprint.is_disc());
  EXPECT_EQ(world.robots[1].model.footprint.circumscribed_radius_m(), 0.4);
  EXPECT_NEAR(world.robots[2].model.footprint.circumscribed_radius_m(), 0.5, 1e-12);
  EXPECT_FALSE(world.robots[2].goal.has_value());
  EXPECT_EQ(world.robots[3].model.footprint.corners().size(), 3u);
  EXPECT_EQ(world.robots[3].model.footprint.circumscribed_radius_m(), 0.4);
}

TEST_F(WorldFileTest, FilesThatCannotBeRead) {
  EXPECT_THROW(load_world("no/such/world.yaml", "config"), WorldError);
  expect_refusal("circles: [[1, 2", {"not valid YAML"});
  expect_refusal("", {"not a map"});
  expect_refusal("- 1\n- 2\n", {"not a map"});
  expect_refusal("circles: []\n", {"bounds", "missing"});
}

TEST_F(WorldFileTest, UnknownAndRepeatedKeys) {
  expect_refusal(std::string(kBounds) + "circle: [[1, 2, 3]]\n", {"circle = ", "unknown key"});
  expect_refusal(std::string(kBounds) + kBounds, {"bounds", "twice"});
  expect_refusal("bounds: {min: [0, 0], maks: [1, 1]}\n", {"bounds.maks", "unknown key"});
  expect_refusal(std::string(kBounds) + "moving: [{radius: 1, sped: 1, path: [[3, 3]]}]\n",
                 {"moving[0].sped = 1", "unknown key"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0, 0], goals: [1, 1]}",
                       {"robots[0].goals", "unknown key"});
}

TEST_F(WorldFileTest, NumbersThatAreNone) {
  expect_refusal(std::string(kBounds) + "circles: [[1, .nan, 3]]\n",
                 {"circles[0][1] = .nan", "finite"});
  expect_refusal(std::string(kBounds) + "circles: [[1, .inf, 3]]\n",
                 {"circles[0][1] = .inf", "finite"});
  expect_refusal(std::string(kBounds) + "circles: [[1, nan, 3]]\n", {"circles[0][1] = nan"});
  expect_refusal(std::string(kBounds) + "circles: [[1, 2]]\n", {"circles[0] = [1, 2]", "3 values"});
  expect_refusal(std::string(kBounds) + "circles: 7\n", {"circles = 7", "list"});
  expect_refusal(std::string(kBounds) + "optimal_time: soon\n", {"optimal_time = soon", "number"});
  expect_refusal("bounds: {min: [0, .nan], max: [1, 1]}\n", {"bounds.min[1] = .nan"});
}

TEST_F(WorldFileTest, SizesThatCannotBe) {
  expect_refusal(std::string(kBounds) + "circles: [[3, 3, 1], [3, 3, -0.1]]\n",
                 {"circles[1][2] = -0.1", "more than 0"});
  expect_refusal("bounds: {min: [0, 0], max: [1, 0]}\n", {"bounds", "exceed"});
  expect_refusal(std::string(kBounds) + "optimal_time: 0\n", {"optimal_time = 0"});
  expect_refusal(std::string(kBounds) + "moving: [{radius: -1, speed: 1, path: [[3, 3]]}]\n",
                 {"moving[0].radius = -1"});
  expect_refusal(std::string(kBounds) + "moving: [{radius: 1, speed: -1, path: [[3, 3]]}]\n",
                 {"moving[0].speed = -1"});
  expect_refusal(std::string(kBounds) + "moving: [{radius: 1, speed: 1, path: []}]\n",
                 {"moving[0].path", "at least one"});
  const auto expect_refused_mover = [this](const std::string& mover,
                                           const std::vector<std::string>& said) {
    expect_refusal(std::string(kBounds) + "moving: [{radius: 1, " + mover + "}]\n", said);
  };
  expect_refused_mover("keyframes: [[0, 3, 3]]", {"moving[0].keyframes", "at least two"});
  expect_refused_mover("keyframes: []", {"moving[0].keyframes", "at least two"});
  expect_refused_mover("keyframes: [[0, 3, 3], [1, 3]]", {"moving[0].keyframes[1]", "3 values"});
  expect_refused_mover("keyframes: [[0, 3, 3], [0, 4, 3]]",
                       {"moving[0].keyframes[1][0] = 0", "not later"});
  expect_refused_mover("keyframes: [[-1, 3, 3], [0, 4, 3]]", {"moving[0].keyframes[0][0] = -1"});
  expect_refused_mover("keyframes: [[0, .nan, 3], [1, 4, 3]]", {"moving[0].keyframes[0][1]"});
  expect_refused_mover("keyframes: [[0, 3, 3], [1, 4, 3]], speed: 1",
                       {"moving[0].speed = 1", "either a path or keyframes"});
  expect_refused_mover("keyframes: [[0, 3, 3], [1, 4, 3]], repeat: 3", {"moving[0].repeat = 3"});
  expect_refused_mover("path: [[3, 3]], speed: 1, repeat: true",
                       {"moving[0].repeat", "belongs to keyframes"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0, 0], radius: 0}",
                       {"robots[0].radius = 0"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0, 0], footprint: [1, -1]}",
                       {"robots[0].footprint[1] = -1"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0, 0], footprint: []}",
                       {"robots[0].footprint = []", "at least 3 corners"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0, 0], footprint: [[1, 0], [2]]}",
                       {"robots[0].footprint[1]", "2 values"});
  expect_refused_robot(
      "{name: a, model: rover, start: [0, 0, 0], footprint: [[1, 0], [2, 1], [2, 0]]}",
      {"robots[0].footprint", "base_link"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0, 0], radius: 1, footprint: [1, 1]}",
                       {"robots[0].footprint", "either"});
}

TEST_F(WorldFileTest, BadPolygons) {
  const auto expect_bad = [&](const std::string& corners, const std::string& why) {
    expect_refusal(kBounds + ("polygons: [[" + corners + "]]\n"), {"polygons[0]", why});
  };
  expect_bad("[0, 0], [1, 1]", "at least 3");
  expect_bad("[0, 0], [2, 2], [2, 0], [0, 2]", "cross");
  expect_bad("[0, 0], [1, 1], [2, 2]", "no area");
  expect_bad("[0, 0], [1, 0], [1, 0], [1, 1]", "repeated");
  expect_bad("[0, 0], [1, 0], 7", "list");
}

TEST_F(WorldFileTest, BadRobots) {
  expect_refused_robot("{model: rover, start: [0, 0, 0]}", {"robots[0].name", "missing"});
  expect_refused_robot("{name: a, start: [0, 0, 0]}", {"robots[0].model", "missing"});
  expect_refused_robot("{name: a, model: rover}", {"robots[0].start", "missing"});
  expect_refused_robot("{name: a, model: tank, start: [0, 0, 0]}", {"robots[0].model = tank"});
  expect_refused_robot("{name: a, model: ../x, start: [0, 0, 0]}", {"robots[0].model = ../x"});
  expect_refused_robot("{name: 1a, model: rover, start: [0, 0, 0]}", {"robots[0].name = 1a"});
  expect_refused_robot("{name: a b, model: rover, start: [0, 0, 0]}", {"robots[0].name = a b"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0]}", {"robots[0].start", "3 values"});
  expect_refused_robot("{name: a, model: rover, start: [9, 0, 0]}",
                       {"robots[0].start = [9, 0, 0]", "bounds"});
  expect_refused_robot("{name: a, model: rover, start: [0, 0, 0], goal: [0, 9]}",
                       {"robots[0].goal", "bounds"});
  expect_refused_robot(
      "{name: a, model: rover, start: [0, 0, 0]}, {name: a, model: rover, start: [2, 0, 0]}",
      {"robots[1].name = a", "two robots"});
}

TEST_F(WorldFileTest, StartsWithinSomethingSolid) {
  const std::string robots = std::string("robots: [") + kRobot + "]\n";  // a disc of 0.3 m
  const auto world = [&](const std::string& things) { return kBounds + things + robots; };
  expect_refusal(world("circles: [[3, 3, 1], [1, 0, 0.71]]\n"),
                 {"robots[0].start = [0, 0, 0]", "circles[1]", "0.01 m"});
  EXPECT_NO_THROW(load(world("circles: [[1, 0, 0.69]]\n")));
  expect_refusal(world("polygons: [[[0.29, -1], [1, -1], [1, 1], [0.29, 1]]]\n"), {"polygons[0]"});
  EXPECT_NO_THROW(load(world("polygons: [[[0.31, -1], [1, -1], [1, 1], [0.31, 1]]]\n")));
  EXPECT_NO_THROW(load(world("keep_out: [[[-1, -1], [1, -1], [1, 1], [-1, 1]]]\n")));
  expect_refusal(world("moving: [{radius: 0.5, speed: 1, path: [[0.7, 0], [3, 3]]}]\n"),
                 {"moving[0]"});
  expect_refused_robot(std::string(kRobot) + ", {name: b, model: rover, start: [0.5, 0, 0]}",
                       {"robots[1].start", "robot ugv1"});
}

TEST_F(WorldFileTest, TheTrueFootprintCountsNotItsCover) {
  // Beside the jackal's long side, within its cover and its circumscribed circle, but not in the
  // rectangle.
  const std::string robot = "robots: [{name: a, model: jackal, start: [0, 0, 1.5707963]}]\n";
  EXPECT_NO_THROW(load(kBounds + ("circles: [[0.32, 0, 0.1]]\n" + robot)));
  expect_refusal(kBounds + ("circles: [[0.31, 0, 0.1]]\n" + robot), {"circles[0]"});
}

TEST(ShippedWorlds, AllLoad) {
  int count = 0;
  for (const auto& file : fs::directory_iterator("config/worlds")) {
    EXPECT_NO_THROW(EXPECT_FALSE(load_world(file.path().string(), "config").robots.empty()))
        << file.path();
    ++count;
  }
  EXPECT_GE(count, 5);
}

TEST(ShippedWorlds, TheCorridorIsThatOfThePaper) {
  const World world = load_world("config/worlds/corridor.yaml", "config");
  EXPECT_EQ(world.circles.size(), 12u);
  for (const Circle& circle : world.circles) {
    EXPECT_GE(circle.radius_m, 0.36);
    EXPECT_LE(circle.radius_m, 0.44);
  }
  ASSERT_EQ(world.robots.size(), 2u);
  EXPECT_EQ(world.robots[0].start.position, Vector2(0.0, 0.0));
  EXPECT_EQ(world.robots[1].start.position, Vector2(-1.0, 0.0));
}

/// The worlds of one kind from elsewhere.
class GivenWorlds : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const char* data = std::getenv("MOCHA_DATA");
    const fs::path directory = fs::path(data != nullptr ? data : "../shared/data") / GetParam();
    if (!fs::is_directory(directory)) GTEST_SKIP() << directory << " is absent (set MOCHA_DATA)";
    for (const auto& file : fs::directory_iterator(directory)) paths_.push_back(file.path());
    ASSERT_FALSE(paths_.empty());
  }
  std::vector<fs::path> paths_;
};

TEST_P(GivenWorlds, AllLoad) {
  for (const fs::path& path : paths_) {
    World world;
    ASSERT_NO_THROW(world = load_world(path.string(), "config")) << path;
    ASSERT_GE(world.robots.size(), 1u) << path;
    EXPECT_TRUE(world.robots[0].goal.has_value()) << path;
    EXPECT_EQ(world.optimal_time_s.has_value(), path.parent_path().filename() == "barn") << path;
    EXPECT_GE(world.circles.size() + world.polygons.size() + world.moving.size(), 5u) << path;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, GivenWorlds,
                         ::testing::Values("barn", "dynabarn", "crowds", "mapf"));

}  // namespace
}  // namespace mocha
