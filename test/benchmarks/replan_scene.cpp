#include "benchmarks/replan_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>

namespace mocha {
namespace {

constexpr double kWatched_s = 25.0;  // how long movers keep clear of walls and of each other
constexpr double kFair_s = 2.2;      // nothing touches the robot sooner, whatever it does
constexpr double kFair_m = 1.5;      // nothing starts nearer, surface to surface
constexpr double kDoor_m = 1.8;
constexpr double kDegree = M_PI / 180.0;

/// Uniform numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(int seed) : engine_(0x9E3779B97F4A7C15ULL * static_cast<std::uint64_t>(seed)) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
  }
  int integer(int low, int high) {
    return std::min(high, static_cast<int>(std::floor(between(low, high + 1.0))));
  }
  bool chance(double share) { return between(0.0, 1.0) < share; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::mt19937_64 engine_;
};

Vector2 direction(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

Polygon box(const Vector2& low, const Vector2& high) {
  return {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}};
}

/// When the undisturbed robot is that far along x.
double passing_time_s(const ReplanScene& scene, double x) {
  double t = 0.0;
  while (undisturbed_m(scene, t) < x && t < 60.0) t += 0.05;
  return t;
}

/// Makes scenes, mover by mover: drawn again until it is fair.
class Maker {
 public:
  explicit Maker(int number) : draw_(number) {
    static const char* const kKinds[] = {"crossing", "head_on", "overtaking", "mixed"};
    scene_.number = number;
    scene_.group = number % 10 < 3 ? "accelerating" : "constant_velocity";
    scene_.kind = kKinds[number % 4];
    scene_.start_speed = draw_.chance(0.4) ? 0.75 : 0.0;
    scene_.goal = {draw_.between(10.0, 14.0), 0.0};
    draw_place();
  }

  ReplanScene make() {
    const int least = scene_.kind == "mixed" ? 3 : 1;
    const int most = scene_.kind == "mixed" ? 8 : scene_.kind == "overtaking" ? 2 : 4;
    const int count = draw_.integer(least, most);
    for (int i = 0; i < count; ++i) add_mover();
    return scene_;
  }

 private:
  void draw_place() {
    const bool corridor = draw_.chance(0.5);
    scene_.place = corridor ? "corridor" : "open";
    half_m_ = corridor ? 0.5 * draw_.between(3.0, 4.0) : 5.0;
    const double beside_m = corridor ? 2.5 : 0.0;
    scene_.low = {-4.0, -half_m_ - beside_m};
    scene_.high = {scene_.goal.x() + 4.0, half_m_ + beside_m};
    if (!corridor) return;
    draw_doors();
    draw_pillars();
  }

  /// StartManeuvers opposite each other, for those that cross.
  void draw_doors() {
    const int doors = scene_.kind == "crossing" ? draw_.integer(1, 2) : draw_.integer(0, 1);
    for (int i = 0; i < doors; ++i) {
      doors_.push_back(draw_.between(0.3 + 0.3 * i, 0.5 + 0.3 * i) * scene_.goal.x());
    }
    for (const double side : {-1.0, 1.0}) {
      const double inside = side * half_m_;
      const double outside = inside + 0.2 * side;
      double from = scene_.low.x();
      const auto wall = [&](double to) {
        scene_.obstacles.push_back(
            box({from, std::min(inside, outside)}, {to, std::max(inside, outside)}));
      };
      for (const double door : doors_) {
        wall(door - 0.5 * kDoor_m);
        from = door + 0.5 * kDoor_m;
      }
      wall(scene_.high.x());
    }
  }

  void draw_pillars() {
    const int pillars = draw_.integer(0, 2);
    for (int i = 0; i < pillars; ++i) {
      const double radius_m = draw_.between(0.12, 0.2);
      const double x = draw_.between(0.2, 0.85) * scene_.goal.x();
      const bool in_door = std::any_of(doors_.begin(), doors_.end(),
                                       [&](double door) { return std::abs(x - door) < kDoor_m; });
      if (in_door) continue;
      scene_.obstacles.push_back(Circle{{x, draw_.sign() * (half_m_ - radius_m)}, radius_m});
    }
  }

  void add_mover() {
    for (int attempt = 0; attempt < 400; ++attempt) {
      const std::optional<SceneMover> mover = draw_mover();
      if (!mover || !fair(*mover)) continue;
      scene_.movers.push_back(*mover);
      return;
    }
  }

  std::optional<SceneMover> draw_mover() {
    static const char* const kKinds[] = {"crossing", "head_on", "overtaking"};
    const std::string kind = scene_.kind == "mixed" ? kKinds[draw_.integer(0, 2)] : scene_.kind;
    const bool corridor = scene_.place == "corridor";
    if (kind == "crossing" && corridor && doors_.empty()) return std::nullopt;
    SceneMover mover{draw_.between(0.2, 0.4), Vector2::Zero(), 0.0, draw_.between(0.3, 1.4), {}};
    const double stray_rad = (corridor ? 1.5 : 10.0) * kDegree;
    Vector2 meeting(draw_.between(0.2, 0.9) * scene_.goal.x(), draw_.between(-0.3, 0.3));
    mover.heading_rad = draw_.between(-stray_rad, stray_rad);
    if (kind == "head_on") mover.heading_rad += M_PI;
    if (kind == "overtaking") {
      mover.speed = draw_.chance(0.65) ? draw_.between(0.2, 0.5) : draw_.between(1.2, 1.4);
    }
    if (kind == "crossing") {
      const double skew_rad = (corridor ? 8.0 : 35.0) * kDegree;
      mover.heading_rad = draw_.sign() * (M_PI / 2.0 + draw_.between(-skew_rad, skew_rad));
      if (corridor) meeting.x() = doors_[draw_.integer(0, static_cast<int>(doors_.size()) - 1)];
    }
    place(mover, meeting, kind);
    return mover;
  }

  /// So that it is at `meeting` about when the robot is.
  void place(SceneMover& mover, const Vector2& meeting, const std::string& kind) {
    const bool first = scene_.movers.empty();
    const double late_s = first ? draw_.between(-0.2, 0.2) : draw_.between(-1.2, 1.2);
    const double meet_s = std::max(1.0, passing_time_s(scene_, meeting.x()) + late_s);
    if (scene_.group == "accelerating" && (first || draw_.chance(0.6))) {
      change_pace(mover, meet_s, kind);
    }
    mover.start = meeting - truth(mover, meet_s).centre;
  }

  /// Something that a constant velocity does not foresee, before or at the meeting.
  void change_pace(SceneMover& mover, double meet_s, const std::string& kind) {
    const double when_s = draw_.between(0.3, 0.9) * meet_s;
    mover.legs.push_back({when_s, 0.0, 0.0});
    const int what = draw_.integer(0, 2);
    if (what == 0) {
      const double gain = draw_.between(0.3, 0.5) * (1.4 - mover.speed) + 0.1;
      const double acceleration = draw_.between(0.4, 0.8);
      mover.legs.push_back({gain / acceleration, acceleration, 0.0});
    } else if (what == 1) {
      const double loss = draw_.chance(0.4) ? mover.speed : draw_.between(0.4, 0.8) * mover.speed;
      const double deceleration = draw_.between(0.4, 0.8);
      mover.legs.push_back({loss / deceleration, -deceleration, 0.0});
    } else {
      const double rate = draw_.sign() * draw_.between(0.4, 0.8);
      const double bend_s = draw_.between(0.6, 1.4);
      mover.legs.push_back({bend_s, 0.0, rate});
      const bool back = scene_.place == "corridor" || kind != "crossing";
      if (back) mover.legs.push_back({bend_s, 0.0, -rate});
    }
  }

  bool fair(const SceneMover& mover) const {
    const double touch_m = mover.radius_m + ReplanScene::kRobotRadius_m;
    if (mover.start.norm() < touch_m + kFair_m) return false;
    for (double t = 0.0; t < kFair_s; t += 0.05) {
      const Vector2 centre = truth(mover, t).centre;
      const Vector2 driven(undisturbed_m(scene_, t), 0.0);
      const Vector2 unbraked(scene_.start_speed * t, 0.0);
      const double apart_m =
          std::min({centre.norm(), (centre - driven).norm(), (centre - unbraked).norm()});
      if (apart_m < touch_m) return false;
    }
    const MoverTruth last = truth(mover, 2.0 * kWatched_s);
    const bool stays = last.velocity.norm() < 0.01;
    if (stays && (last.centre - scene_.goal).norm() < touch_m + 0.8) return false;
    return keeps_clear(mover);
  }

  /// Of walls and of the other movers.
  bool keeps_clear(const SceneMover& mover) const {
    constexpr double kGap_m = 0.05;
    for (double t = 0.0; t < kWatched_s; t += 0.1) {
      const Vector2 centre = truth(mover, t).centre;
      for (const Obstacle& obstacle : scene_.obstacles) {
        if (gap(Circle{centre, mover.radius_m}, obstacle).distance_m < kGap_m) return false;
      }
      for (const SceneMover& other : scene_.movers) {
        const double apart_m = (centre - truth(other, t).centre).norm();
        if (apart_m < mover.radius_m + other.radius_m + kGap_m) return false;
      }
    }
    return true;
  }

  Draw draw_;
  ReplanScene scene_;
  double half_m_ = 0.0;        // of the ground, across
  std::vector<double> doors_;  // x of their middles
};

}  // namespace

MoverTruth truth(const SceneMover& mover, double t) {
  MoverTruth now{mover.start, mover.speed * direction(mover.heading_rad)};
  double heading_rad = mover.heading_rad;
  double speed = mover.speed;
  for (const MoverLeg& leg : mover.legs) {
    const double spent_s = std::min(t, leg.duration_s);
    if (leg.yaw_rate != 0.0) {
      const double turned_rad = leg.yaw_rate * spent_s;
      const double chord_m = 2.0 * speed / leg.yaw_rate * std::sin(0.5 * turned_rad);
      now.centre += chord_m * direction(heading_rad + 0.5 * turned_rad);
      heading_rad += turned_rad;
    } else {
      const double length_m = (speed + 0.5 * leg.acceleration * spent_s) * spent_s;
      now.centre += length_m * direction(heading_rad);
      speed = std::max(0.0, speed + leg.acceleration * spent_s);
    }
    t -= spent_s;
    if (t <= 0.0) break;
  }
  now.velocity = speed * direction(heading_rad);
  now.centre += std::max(0.0, t) * now.velocity;
  return now;
}

OccupancyGrid ReplanScene::grid() const {
  OccupancyGrid grid;
  grid.origin = low;
  grid.width = static_cast<int>(std::lround((high.x() - low.x()) / grid.resolution_m));
  grid.height = static_cast<int>(std::lround((high.y() - low.y()) / grid.resolution_m));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kFree);
  for (const Obstacle& obstacle : obstacles) {
    if (const auto* circle = std::get_if<Circle>(&obstacle)) {
      fill_disc(grid, circle->centre, circle->radius_m, OccupancyGrid::kOccupied);
    } else {
      fill_polygon(grid, std::get<Polygon>(obstacle), OccupancyGrid::kOccupied);
    }
  }
  return grid;
}

double undisturbed_m(const ReplanScene& scene, double t) {
  constexpr double kCruise = 0.95;
  constexpr double kAcceleration = 0.55;
  const double delay_s = scene.start_speed > 0.0 ? 0.0 : 0.8;
  const double ramp_s = (kCruise - scene.start_speed) / kAcceleration;
  const double ramping_s = std::clamp(t - delay_s, 0.0, ramp_s);
  const double ramp_m = (scene.start_speed + 0.5 * kAcceleration * ramping_s) * ramping_s;
  return ramp_m + kCruise * std::max(0.0, t - delay_s - ramp_s);
}

ReplanScene replan_scene(int number) { return Maker(number).make(); }

}  // namespace mocha
