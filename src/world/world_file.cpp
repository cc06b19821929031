#include "world/world_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "config/parameter_table.h"
#include "world/robot_values.h"
#include "world/yaml_reader.h"

namespace mocha {
namespace {

Eigen::AlignedBox2d read_bounds(const YamlReader& reader) {
  reader.allow_keys({"min", "max"});
  const Eigen::AlignedBox2d bounds(reader.at("min").point(), reader.at("max").point());
  if ((bounds.sizes().array() <= 0.0).any()) reader.refuse("max must exceed min in x and y");
  return bounds;
}

Circle read_circle(const YamlReader& reader) {
  const auto values = reader.items(3, 3);
  return {Vector2(values[0].number(), values[1].number()), values[2].positive()};
}

/// There from the first of its keyframes to the last only.
Mover read_keyframed(const YamlReader& reader) {
  for (const char* key : {"speed", "loop", "path"}) {
    if (reader.has(key)) reader.at(key).refuse("a mover has either a path or keyframes");
  }
  const bool repeats = reader.has("repeat") && reader.at("repeat").flag();
  Mover mover{
      reader.at("radius").positive(), {}, repeats ? AfterLast::kRepeats : AfterLast::kLeaves};
  const YamlReader keyframes = reader.at("keyframes");
  for (const YamlReader& item : keyframes.items()) {
    const auto values = item.items(3, 3);
    const double time_s = values[0].not_negative();
    if (!mover.keyframes.empty() && time_s <= mover.keyframes.back().time_s)
      values[0].refuse("is not later than the keyframe before");
    mover.keyframes.push_back({time_s, {values[1].number(), values[2].number()}});
  }
  if (mover.keyframes.size() < 2) keyframes.refuse("needs at least two");
  return mover;
}

Mover read_mover(const YamlReader& reader) {
  reader.allow_keys({"radius", "speed", "loop", "path", "keyframes", "repeat"});
  if (reader.has("keyframes")) return read_keyframed(reader);
  if (reader.has("repeat")) reader.at("repeat").refuse("belongs to keyframes; a path has loop");
  std::vector<Vector2> path = reader.at("path").points();
  if (path.empty()) reader.at("path").refuse("needs at least one point");
  return along_path(reader.at("radius").positive(), reader.at("speed").not_negative(),
                    reader.has("loop") && reader.at("loop").flag(), std::move(path));
}

std::string read_name(const YamlReader& reader, const std::vector<WorldRobot>& others) {
  const std::string name = reader.text();
  const auto usable = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0 ||
      !std::all_of(name.begin(), name.end(), usable)) {
    reader.refuse("a robot's name is a letter followed by letters, digits and underscores");
  }
  if (name == "static" || name == "moving")
    reader.refuse("contact reports use this word otherwise");
  for (const WorldRobot& other : others) {
    if (other.name == name) reader.refuse("two robots have this name");
  }
  return name;
}

RobotModel read_model(const YamlReader& reader, const std::string& config_directory) {
  std::string model = reader.text();
  if (is_path_of_model(model)) {
    model = reader.path();
  } else if (model.empty() || model.find_first_of("/.") != std::string::npos) {
    reader.refuse(
        "is neither the name of a file in config/robots, without .yaml, nor a path of one, with "
        ".yaml");
  }
  try {
    return load_robot_model(config_directory, model);
  } catch (const ParameterError& error) {
    reader.refuse(error.what());
  }
}

void override_footprint(const YamlReader& reader, RobotModel& model) {
  if (reader.has("radius") && reader.has("footprint")) {
    reader.at("footprint").refuse("give either a radius or a footprint");
  }
  if (reader.has("radius")) model.footprint = Footprint::disc(reader.at("radius").positive());
  if (!reader.has("footprint")) return;
  const YamlReader shape = reader.at("footprint");
  if (!shape.is_list_of_lists()) {
    const auto sides = shape.items(2, 2);
    model.footprint = Footprint::rectangle(sides[0].positive(), sides[1].positive());
    return;
  }
  try {
    model.footprint = Footprint::polygon(shape.points());
  } catch (const std::invalid_argument& error) {
    shape.refuse(error.what());
  }
}

Vector2 read_place(const YamlReader& reader, const std::vector<YamlReader>& values,
                   const Eigen::AlignedBox2d& bounds) {
  const Vector2 place(values[0].number(), values[1].number());
  if (!bounds.contains(place)) reader.refuse("lies outside the bounds");
  return place;
}

WorldRobot read_robot(const YamlReader& reader, const World& world,
                      const std::string& config_directory) {
  reader.allow_keys({"name", "model", "start", "goal", "radius", "footprint"});
  WorldRobot robot;
  robot.name = read_name(reader.at("name"), world.robots);
  robot.model = read_model(reader.at("model"), config_directory);
  override_footprint(reader, robot.model);
  const YamlReader start = reader.at("start");
  const auto from = start.items(3, 3);
  robot.start = {read_place(start, from, world.bounds), from[2].number()};
  if (reader.has("goal")) {
    const YamlReader goal = reader.at("goal");
    const auto to = goal.items(2, 3);
    robot.goal = Goal{read_place(goal, to, world.bounds), {}};
    if (to.size() == 3) robot.goal->yaw_rad = to[2].number();
  }
  return robot;
}

void check_apart(const YamlReader& start, const Obstacle& robot, const Obstacle& other,
                 const std::string& what) {
  const Gap between = gap(robot, other);
  if (between.distance_m >= 0.0) return;
  std::ostringstream why;
  why << "the robot's footprint overlaps " << what << " by " << -between.distance_m << " m at ("
      << between.place.x() << ", " << between.place.y() << ")";
  start.refuse(why.str());
}

/// Refuses a start where the robot's true footprint overlaps anything solid.
void check_start(const YamlReader& start, const World& world, const WorldRobot& robot) {
  const Obstacle body = placed(robot.model.footprint, robot.start);
  const auto indexed = [](const char* name, std::size_t i) {
    return std::string(name) + "[" + std::to_string(i) + "]";
  };
  for (std::size_t i = 0; i < world.circles.size(); ++i) {
    check_apart(start, body, world.circles[i], indexed("circles", i));
  }
  for (std::size_t i = 0; i < world.polygons.size(); ++i) {
    check_apart(start, body, world.polygons[i], indexed("polygons", i));
  }
  for (std::size_t i = 0; i < world.moving.size(); ++i) {
    const Mover& mover = world.moving[i];
    const auto& [time_s, place] = mover.keyframes.front();
    if (time_s == 0.0)
      check_apart(start, body, Circle{place, mover.radius_m}, indexed("moving", i));
  }
  for (const WorldRobot& other : world.robots) {
    check_apart(start, body, placed(other.model.footprint, other.start), "robot " + other.name);
  }
}

}  // namespace

Mover along_path(double radius_m, double speed_mps, bool loop, std::vector<Vector2> path) {
  if (loop) path.push_back(path.front());
  Mover mover{radius_m, {{0.0, path.front()}}, loop ? AfterLast::kRepeats : AfterLast::kStands};
  for (const Vector2& place : path) {
    const Keyframe& before = mover.keyframes.back();
    const double time_s = before.time_s + (place - before.place).norm() / speed_mps;
    if (time_s > before.time_s && std::isfinite(time_s)) mover.keyframes.push_back({time_s, place});
  }
  if (mover.keyframes.size() == 1) mover.after_last = AfterLast::kStands;
  return mover;
}

World load_world(const std::string& path, const std::string& config_directory) {
  const YamlReader reader = YamlReader::file(path);
  reader.allow_keys(kWorldKeys);
  const auto list = [&](const char* key) {
    return reader.has(key) ? reader.at(key).items() : std::vector<YamlReader>{};
  };
  World world;
  world.bounds = read_bounds(reader.at("bounds"));
  if (reader.has("optimal_time")) world.optimal_time_s = reader.at("optimal_time").positive();
  for (const auto& item : list("circles")) world.circles.push_back(read_circle(item));
  for (const auto& item : list("polygons")) world.polygons.push_back(item.polygon());
  world.zones = read_zones(reader);
  for (const auto& item : list("moving")) world.moving.push_back(read_mover(item));
  for (const auto& item : list("robots")) {
    const WorldRobot robot = read_robot(item, world, config_directory);
    check_start(item.at("start"), world, robot);
    world.robots.push_back(robot);
  }
  return world;
}

}  // namespace mocha
