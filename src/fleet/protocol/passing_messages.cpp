#include "fleet/protocol/passing_messages.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace mocha {
namespace {

constexpr double kMaxRadius_m = 10.0;

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("passing message: " + what);
}

void require_of_passing(bool condition, const char* what) {
  if (!condition) refuse(what);
}

void require_most(std::size_t count, std::size_t most, const std::string& of_what) {
  if (count > most)
    refuse("has " + std::to_string(count) + " " + of_what + ", allowed are " +
           std::to_string(most));
}

void validate_turn(const PassingTurn& turn, std::size_t self, std::size_t robots) {
  require_of_passing(turn.path.size() >= 2, "the path of a turn has less than two places");
  require_most(turn.path.size(), kMostTurnPlaces, "places in a turn");
  for (const Vector2& place : turn.path)
    require_of_passing(place.allFinite(), "a place is not finite");
  std::set<std::uint32_t> named;
  for (const PassingProgress& progress : turn.after) {
    require_of_passing(progress.robot < robots, "a turn is to wait for a robot that is not there");
    require_of_passing(progress.robot != self, "a robot is to wait for itself");
    require_of_passing(named.insert(progress.robot).second, "a turn is to wait for a robot twice");
    require_most(progress.moves, kMostTurns, "turns to wait for");
  }
}

}  // namespace

void validate(const PassingIntent& intent) {
  require_of_passing(!intent.agent.empty(), "has no name of a robot");
  if (!(intent.radius_m > 0.0 && intent.radius_m <= kMaxRadius_m))
    refuse("radius = " + std::to_string(intent.radius_m) + " m, allowed is above 0 up to 10 m");
  require_of_passing(!intent.goal || intent.goal->allFinite(), "the goal is not finite");
  require_of_passing(intent.follows.number == 0 || !intent.follows.leader.empty(),
                     "follows nobody's order");
  require_most(intent.moves, kMostTurns, "moves");
  require_most(intent.obstacles.size(), kMostObstacles, "obstacles");
  for (const Vector2& place : intent.obstacles)
    require_of_passing(place.allFinite(), "an obstacle is not finite");
}

void validate(const PassingInstruction& instruction) {
  const std::vector<std::string>& robots = instruction.robots;
  require_of_passing(!instruction.id.leader.empty(), "has no name of a robot");
  require_of_passing(instruction.id.number > 0, "has no number");
  require_most(robots.size(), kMostPassing, "robots");
  require_of_passing(std::count(robots.begin(), robots.end(), "") == 0, "has no name of a robot");
  require_of_passing(std::set<std::string>(robots.begin(), robots.end()).size() == robots.size(),
                     "has a robot twice");
  const auto self = std::find(robots.begin(), robots.end(), instruction.robot);
  require_of_passing(self != robots.end(), "is for a robot that its order is not for");
  require_most(instruction.turns, kMostTurns, "turns");
  require_of_passing(instruction.alone_from <= instruction.turns, "is alone from beyond its end");
  require_of_passing(instruction.first <= instruction.turns &&
                         instruction.part.size() <= instruction.turns - instruction.first,
                     "a part goes beyond the end");
  for (const PassingTurn& turn : instruction.part)
    validate_turn(turn, static_cast<std::size_t>(self - robots.begin()), robots.size());
}

}  // namespace mocha
