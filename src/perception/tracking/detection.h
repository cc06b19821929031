#pragma once

#include "perception/tracking/hit_clusters.h"

namespace mocha {

/// A cluster of hits taken for the side of a disc that the sensor sees: the sector of sight that it
/// fills, and how near it is. Bearings in the map frame, counter-clockwise.
struct Detection {
  double time_s;
  Vector2 sensor;
  double right_rad;   ///< where the sector begins
  double left_rad;    ///< where it ends; never below right_rad
  bool right_hidden;  ///< the disc may go on there, behind something nearer or out of the scan
  bool left_hidden;
  double nearest_m;
  double radius_m;  ///< of the disc that fills the sector; of a hidden one, at most its radius
  std::vector<Vector2> hits;
  int legs = 0;               ///< of a person, as which it looks: 0, 1 or 2
  bool has_come = false;      ///< it is where the map was free
  bool is_continued = false;  ///< what has not come goes on beside it: it may be part of a wall

  bool is_hidden() const { return right_hidden || left_hidden; }

  /// Where the centre of a disc with this radius is: at an edge of the sector that is not hidden,
  /// else in the middle.
  Vector2 centre(double radius) const;
};

/// Of a cluster that is not empty. The outermost ends on a disc that is seen within +-alpha are
/// 2 r cos(alpha) apart, less what is lost between two beams; unlike alpha alone, that also holds,
/// more or less, for two legs.
Detection sight_disc(const std::vector<Beam>& beams, const BeamIndices& cluster);

/// What a scan says about a place where a disc should be.
enum class View {
  kUnseen,  ///< no beam leads there
  kFree,    ///< most beams pass
  kHidden,  ///< most beams end before
  kTaken,   ///< most beams end there
};

View view_of(const std::vector<Beam>& beams, const Vector2& centre, double radius_m);

}  // namespace mocha
