#include "perception/localization/map_changes.h"

#include <cmath>
#include <limits>
#include <utility>

namespace mocha {
namespace {

constexpr int kTimes = 8;             // that a cell is contradicted, each a while after the other
constexpr double kBeforeEnd_m = 0.3;  // a beam says nothing of what is so near to its end
constexpr double kPeriod_s = 1.0;     // between the scans that are looked at

}  // namespace

MapChanges::MapChanges(OccupancyGrid map, double lasting_s)
    : map_(std::move(map)), lasting_s_(lasting_s) {
  forget_doubts();
}

void MapChanges::forget_doubts() {
  doubts_.clear();
  looked_s_ = changed_s_ = -std::numeric_limits<double>::infinity();
}

/// The cells of the map at a place and beside it.
template <class Visit>
void MapChanges::visit_around(const Vector2& place, Visit visit) const {
  const Vector2 at = (place - map_.origin) / map_.resolution_m;
  const int x = static_cast<int>(std::floor(at.x()));
  const int y = static_cast<int>(std::floor(at.y()));
  for (int j = y - 1; j <= y + 1; ++j) {
    for (int i = x - 1; i <= x + 1; ++i) {
      if (map_.contains(i, j))
        visit(static_cast<std::size_t>(j) * map_.width + i, i == x && j == y);
    }
  }
}

bool MapChanges::add(const ScanHits& scan, const Pose& base) {
  if (scan.time_s < looked_s_ + kPeriod_s) return false;
  looked_s_ = scan.time_s;
  const std::vector<Beam> beams = beams_of(scan, base);
  Cells near_hits;
  for (const Beam& beam : beams) {
    if (beam.kind == BeamEnd::kHit) see_hit(beam.end.head<2>(), scan.time_s, near_hits);
  }
  for (const Beam& beam : beams) see_passed(beam, near_hits);
  return change(scan.time_s);
}

void MapChanges::see_hit(const Vector2& place, double time_s, Cells& near_hits) {
  const bool is_new = !is_occupied_beside(map_, place);
  visit_around(place, [&](std::size_t cell, bool is_there) {
    near_hits.insert(cell);
    if (map_.cells[cell] == OccupancyGrid::kOccupied) doubts_.erase(cell);
    if (is_there && is_new) doubt(cell, OccupancyGrid::kOccupied, time_s);
  });
}

void MapChanges::see_passed(const Beam& beam, const Cells& near_hits) {
  const Vector2 from = beam.origin.head<2>();
  const double length_m = ray(beam).norm();
  for (double at_m = 0.0; at_m < length_m - kBeforeEnd_m; at_m += map_.resolution_m) {
    visit_around(from + ray(beam) * (at_m / length_m), [&](std::size_t cell, bool is_there) {
      if (!is_there || near_hits.count(cell) > 0) return;
      if (map_.cells[cell] == OccupancyGrid::kFree) {
        doubts_.erase(cell);
      } else {
        doubt(cell, OccupancyGrid::kFree, beam.time_s);
      }
    });
  }
}

void MapChanges::doubt(std::size_t cell, int8_t value, double time_s) {
  Doubt& doubt = doubts_[cell];
  if (doubt.value != value) doubt = {value, 0, 0.0};
  if (doubt.times > 0 && time_s < doubt.newest_s + lasting_s_ / kTimes) return;
  ++doubt.times;
  doubt.newest_s = time_s;
}

/// Changes all cells that are due at once, and only a few times in lasting_s_, because each change
/// makes the users of the map prepare it anew.
bool MapChanges::change(double time_s) {
  if (time_s < changed_s_ + lasting_s_ / kTimes) return false;
  bool has_changed = false;
  for (auto each = doubts_.begin(); each != doubts_.end();) {
    if (each->second.times > kTimes) {
      map_.cells[each->first] = each->second.value;
      each = doubts_.erase(each);
      has_changed = true;
    } else {
      ++each;
    }
  }
  if (has_changed) changed_s_ = time_s;
  return has_changed;
}

}  // namespace mocha
