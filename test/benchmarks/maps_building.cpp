#include "benchmarks/maps_building.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <vector>

namespace mocha {
namespace {

constexpr double kCell_m = 0.05;
constexpr double kWall_m = 0.2;
constexpr double kDoor_m = 1.2;
constexpr double kFree_m = 1.2;  // about start and goal

/// Sets the cells of a box, as far as the grid holds it.
void fill(OccupancyGrid& grid, const Vector2& low, const Vector2& high, std::int8_t value) {
  const auto index = [&](const Vector2& place, int axis) {
    return static_cast<int>(std::lround((place[axis] - grid.origin[axis]) / kCell_m));
  };
  for (int y = std::max(0, index(low, 1)); y < std::min(grid.height, index(high, 1)); ++y) {
    for (int x = std::max(0, index(low, 0)); x < std::min(grid.width, index(high, 0)); ++x)
      grid.at(x, y) = value;
  }
}

/// Rooms side by side in rows and columns, all of which can be reached.
class Rooms {
 public:
  /// How rooms are laid out, and how many of the doors that are not needed there are.
  struct Layout {
    double pitch_m;
    double door_m;
    double more_doors;
    int corridor_every;  // of the rows, one has no walls in it; 0: none
  };

  Rooms(OccupancyGrid& grid, const Layout& layout, std::mt19937& random)
      : grid_(grid),
        layout_(layout),
        random_(random),
        count_(static_cast<int>(grid.width * kCell_m / layout.pitch_m)),
        joined_(count_ * count_) {}

  void draw() {
    for (int i = 0; i <= count_; ++i) {
      const double at_m = i * layout_.pitch_m;
      fill(grid_, {at_m, 0.0}, {at_m + kWall_m, side_m()}, OccupancyGrid::kOccupied);
      fill(grid_, {0.0, at_m}, {side_m(), at_m + kWall_m}, OccupancyGrid::kOccupied);
    }
    for (std::size_t i = 0; i < joined_.size(); ++i) joined_[i] = static_cast<int>(i);
    std::vector<Side> sides;
    for (int i = 0; i < count_ * count_; ++i) {
      if (i % count_ + 1 < count_) sides.push_back({i, i + 1});
      if (i / count_ + 1 < count_) sides.push_back({i, i + count_});
    }
    std::shuffle(sides.begin(), sides.end(), random_);
    for (const Side& side : sides) {
      if (in_corridor(side)) open(side, layout_.pitch_m - kWall_m);
    }
    for (const Side& side : sides) {
      const bool needed = group(side.first) != group(side.second);
      if (needed || chance_(random_) < layout_.more_doors) open(side, layout_.door_m);
    }
  }

 private:
  struct Side {
    int first;
    int second;  // the room after it in its row, or in its column
  };

  double side_m() const { return count_ * layout_.pitch_m + kWall_m; }
  bool in_corridor(const Side& side) const {
    return layout_.corridor_every > 0 && side.second == side.first + 1 &&
           side.first / count_ % layout_.corridor_every == 1;
  }
  int group(int room) {
    while (joined_[room] != room) room = joined_[room] = joined_[joined_[room]];
    return room;
  }

  void open(const Side& side, double width_m) {
    joined_[group(side.first)] = group(side.second);
    const Vector2 corner = layout_.pitch_m * Vector2(side.second % count_, side.second / count_);
    const double spare_m = layout_.pitch_m - kWall_m - width_m;
    const double off_m = kWall_m + spare_m * chance_(random_);
    if (side.second == side.first + 1) {
      fill(grid_, corner + Vector2(0.0, off_m), corner + Vector2(kWall_m, off_m + width_m),
           OccupancyGrid::kFree);
    } else {
      fill(grid_, corner + Vector2(off_m, 0.0), corner + Vector2(off_m + width_m, kWall_m),
           OccupancyGrid::kFree);
    }
  }

  OccupancyGrid& grid_;
  const Layout layout_;
  std::mt19937& random_;
  std::uniform_real_distribution<double> chance_{0.0, 1.0};
  const int count_;
  std::vector<int> joined_;  // rooms in trees, by the room above
};

void pillars(OccupancyGrid& grid, std::mt19937& random) {
  constexpr double kApart_m = 4.0;
  std::uniform_real_distribution<double> off(-0.8, 0.8);
  for (double y = kApart_m; y < grid.height * kCell_m - 1.0; y += kApart_m) {
    for (double x = kApart_m; x < grid.width * kCell_m - 1.0; x += kApart_m) {
      const Vector2 low(x + off(random), y + off(random));
      fill(grid, low, low + Vector2::Constant(0.4), OccupancyGrid::kOccupied);
    }
  }
}

/// A disc for every 4 m^2.
void clutter(OccupancyGrid& grid, std::mt19937& random) {
  const double side_m = grid.width * kCell_m;
  std::uniform_real_distribution<double> place(0.0, side_m);
  std::uniform_real_distribution<double> radius(0.1, 0.4);
  for (int i = 0; i < std::lround(side_m * side_m / 4.0); ++i) {
    const double x = place(random);
    fill_disc(grid, {x, place(random)}, radius(random), OccupancyGrid::kOccupied);
  }
}

/// How a kind is drawn. Start and goal are in the middle of squares of `pitch_m` in two corners,
/// which are cleared unless they are rooms.
struct Kind {
  double pitch_m;
  bool has_rooms;
  std::function<void(OccupancyGrid&, std::mt19937&)> draw;
};

Kind rooms(const Rooms::Layout& layout) {
  return {layout.pitch_m, true, [layout](OccupancyGrid& grid, std::mt19937& random) {
            Rooms(grid, layout, random).draw();
          }};
}

const std::map<std::string, Kind> kKinds = {{"rooms", rooms({6.0, kDoor_m, 0.5, 0})},
                                            {"corridors", rooms({5.0, kDoor_m, 0.1, 3})},
                                            {"maze", rooms({2.2, 2.0, 0.02, 0})},
                                            {"pillars", {5.0, false, pillars}},
                                            {"clutter", {5.0, false, clutter}}};

}  // namespace

std::optional<Building> building(const std::string& name, double side_m, unsigned seed) {
  const auto found = kKinds.find(name);
  if (found == kKinds.end()) return std::nullopt;
  const Kind& kind = found->second;
  Building building;
  OccupancyGrid& grid = building.grid;
  grid.resolution_m = kCell_m;
  grid.width = grid.height = static_cast<int>(std::lround(side_m / kCell_m));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * grid.height, OccupancyGrid::kFree);
  std::mt19937 random(seed);
  kind.draw(grid, random);
  const double last_m = (std::floor(side_m / kind.pitch_m) - 0.5) * kind.pitch_m + 0.5 * kWall_m;
  building.start = Vector2::Constant(0.5 * kind.pitch_m + 0.5 * kWall_m);
  building.goal = Vector2::Constant(last_m);
  if (kind.has_rooms) return building;
  for (const Vector2& place : {building.start, building.goal})
    fill_disc(grid, place, kFree_m, OccupancyGrid::kFree);
  return building;
}

OccupancyGrid walled_in(const OccupancyGrid& grid, const Vector2& place) {
  OccupancyGrid walled = grid;
  const Vector2 outer = Vector2::Constant(1.5);
  const Vector2 inner = outer - Vector2::Constant(kWall_m);
  fill(walled, place - outer, place + outer, OccupancyGrid::kOccupied);
  fill(walled, place - inner, place + inner, OccupancyGrid::kFree);
  return walled;
}

}  // namespace mocha
