// Drives the first robot of a world through its whole stack, lidar only and without ROS, and prints
// what it saw, predicted, promised and did, as JSON, for scripts/plots contacts. Arguments: a world
// file, a seed, and the longest time [s].

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "benchmarks/lidar_robot.h"
#include "benchmarks/world_program.h"

namespace mocha {
namespace {

using Json = nlohmann::json;

constexpr double kListening_s = 1.0;  // before the goal is given
constexpr int kTicksPerRow = 10;
constexpr double kAhead_s = 4.0;  // of the promise that is shown
constexpr double kStep_s = 0.25;

Json row_of(const LidarRobot& robot, double begin_s) {
  const double now_s = robot.now_s();
  const Vehicle& vehicle = robot.truth().vehicle;
  const auto& replanned = robot.stack().replanned();
  Json row{{"time_s", rounded(now_s - begin_s)},
           {"pose",
            {rounded(vehicle.pose().position.x()), rounded(vehicle.pose().position.y()),
             rounded(vehicle.pose().yaw_rad)}},
           {"twist", {rounded(vehicle.twist().speed), rounded(vehicle.twist().yaw_rate)}},
           {"row", to_text(replanned.row)},
           {"message", replanned.message},
           {"movers", Json::array()},
           {"predicted", Json::array()},
           {"promised", Json::array()}};
  for (const Circle& disc : robot.simulator().moving_discs())
    row["movers"].push_back(
        {rounded(disc.centre.x()), rounded(disc.centre.y()), rounded(disc.radius_m)});
  for (const auto& thing : robot.confident()) {
    const MovingObstacle::Disc disc = thing->at(now_s);
    row["predicted"].push_back({rounded(disc.centre.x()), rounded(disc.centre.y()),
                                rounded(disc.radius_m), rounded(disc.velocity.x()),
                                rounded(disc.velocity.y()), rounded(disc.radius_rate)});
  }
  const Motion& promised = robot.stack().committed();
  for (double ahead_s = 0.0; !promised.empty() && ahead_s <= kAhead_s; ahead_s += kStep_s) {
    const Vector2 place = promised.position(now_s + ahead_s);
    row["promised"].push_back({rounded(place.x()), rounded(place.y())});
  }
  return row;
}

Json contact_of(const ContactEvent& event, double time_s) {
  const Touch& touch = event.touch;
  return {{"time_s", rounded(time_s)},
          {"place", {rounded(touch.place.x()), rounded(touch.place.y())}},
          {"other", event.other},
          {"depth_m", rounded(event.depth_m)},
          {"blame", to_text(event.blame)},
          {"speed_mps", rounded(touch.own_velocity.norm())},
          {"approach_mps", rounded(touch.approach_mps())}};
}

Json trace(const World& world, std::uint64_t seed, double longest_s) {
  LidarRobot robot(world, seed);
  const double begin_s = robot.now_s();
  const auto since_s = [&] { return robot.now_s() - begin_s; };
  Json result{{"rows", Json::array()}, {"contacts", Json::array()}};
  bool sent = false;
  for (int tick = 1; since_s() < longest_s; ++tick) {
    if (!sent && since_s() >= kListening_s) {
      robot.go_to(world.robots[0].goal->position);
      sent = true;
    }
    robot.tick();
    for (const ContactEvent& event : robot.contacts())
      result["contacts"].push_back(contact_of(event, since_s()));
    if (tick % kTicksPerRow == 0) result["rows"].push_back(row_of(robot, begin_s));
    if (robot.ending() != GoalExecutive::Ending::kNone) break;
  }
  result["reached"] = robot.ending() == GoalExecutive::Ending::kReached;
  result["time_s"] = rounded(since_s());
  return result;
}

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) { return mocha::run_on_world(argc, argv, mocha::trace); }
