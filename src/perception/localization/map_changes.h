#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "perception/sensor/scan_hits.h"
#include "world/occupancy_grid.h"

namespace mocha {

/// A map that learns what has changed for good: cells that scans have contradicted again and again
/// for so long, without confirming them once. People, and what stands somewhere for a while, leave
/// no trace; walls do not creep, as hits beside a wall of the map are taken for hits of it.
class MapChanges {
 public:
  /// `lasting_s`: positive.
  MapChanges(OccupancyGrid map, double lasting_s);

  /// Takes a scan of a robot that surely stands at `base` in the map. Times must not decrease.
  /// Returns whether the map has changed; that happens a few times in `lasting_s` at most.
  bool add(const ScanHits& scan, const Pose& base);

  /// Of what is not learnt yet; times may begin anew.
  void forget_doubts();

  const OccupancyGrid& map() const { return map_; }

 private:
  using Cells = std::unordered_set<std::size_t>;

  /// How often a cell was contradicted.
  struct Doubt {
    int8_t value = OccupancyGrid::kUnknown;  ///< that it should have
    int times = 0;
    double newest_s = 0.0;
  };

  template <class Visit>
  void visit_around(const Vector2& place, Visit visit) const;
  void see_hit(const Vector2& place, double time_s, Cells& near_hits);
  void see_passed(const Beam& beam, const Cells& near_hits);
  void doubt(std::size_t cell, int8_t value, double time_s);
  bool change(double time_s);

  OccupancyGrid map_;
  const double lasting_s_;
  double looked_s_;   // at the newest scan
  double changed_s_;  // when the map has changed last
  std::unordered_map<std::size_t, Doubt> doubts_;
};

}  // namespace mocha
