#pragma once

#include <optional>

#include "perception/monitoring/scan_alignment.h"

namespace mocha {

/// How a robot moves, as its scans show it.
class ScanMotion {
 public:
  /// Takes the next scan, and base_link in the odometry frame at its time, which is only where the
  /// search begins. Returns base_link as seen from where it was at the scan before; nothing for the
  /// first scan, and where the scans do not tell.
  std::optional<Pose> add(const ScanHits& scan, const Pose& odometry);

  void clear() { reference_.reset(); }

 private:
  std::optional<ScanAlignment> best(const ScanHits& scan, const Pose& odometry) const;
  void begin(const ScanHits& scan);

  std::optional<ReferenceScan> reference_;
  Pose newest_;  // base_link at the newest scan, as seen from the reference's
  Pose step_;    // of the newest scan
  Pose odometry_;
};

}  // namespace mocha
