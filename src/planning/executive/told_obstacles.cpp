#include "planning/executive/told_obstacles.h"

#include <algorithm>

namespace mocha {
namespace {

constexpr double kLapse_s = 30.0;
constexpr double kSame_m = 0.05;
constexpr std::size_t kMostTold = 512;

}  // namespace

bool ToldObstacles::note(const std::vector<Vector2>& obstacles, double now_s) {
  told_.erase(std::remove_if(told_.begin(), told_.end(),
                             [&](const Told& told) { return now_s >= told.time_s + kLapse_s; }),
              told_.end());
  bool is_new = false;
  for (const Vector2& place : obstacles) {
    const auto known = std::find_if(told_.begin(), told_.end(), [&](const Told& told) {
      return (told.place - place).norm() < kSame_m;
    });
    if (known != told_.end()) {
      known->time_s = now_s;
    } else if (told_.size() < kMostTold) {
      told_.push_back({place, now_s});
      is_new = true;
    }
  }
  return is_new;
}

std::vector<Vector2> ToldObstacles::all(double now_s) const {
  std::vector<Vector2> places;
  for (const Told& told : told_) {
    if (now_s < told.time_s + kLapse_s) places.push_back(told.place);
  }
  return places;
}

}  // namespace mocha
