#pragma once

#include <vector>

#include "trajectory/motion.h"

namespace mocha {

/// The shape of a robot about its base, and the discs along its heading that cover it.
class Footprint {
 public:
  struct CoverDisc {
    double offset_m;  ///< of the centre, along the heading
    double radius_m;
  };

  /// A disc. Throws std::invalid_argument unless the radius is positive.
  static Footprint disc(double radius_m);

  /// A rectangle centred on the base, covered by `discs` >= 1 equal discs. Throws
  /// std::invalid_argument otherwise.
  static Footprint rectangle(double length_m, double width_m, int discs = 2);

  const std::vector<CoverDisc>& cover() const { return cover_; }

  /// Radius of the disc about the base that the robot sweeps when it turns in place.
  double circumscribed_radius_m() const { return circumscribed_radius_m_; }

  /// Radius of the disc about the base that holds all cover discs; they stick out of the body.
  double cover_reach_m() const;

  bool is_disc() const { return corners_.empty(); }
  /// Corners of the true shape in the body frame, counter-clockwise; empty for a disc.
  const std::vector<Vector2>& corners() const { return corners_; }

 private:
  std::vector<CoverDisc> cover_;
  std::vector<Vector2> corners_;
  double circumscribed_radius_m_ = 0.0;
};

/// Centre of a cover disc of a robot at `pose`, map frame.
Vector2 cover_centre(const Pose& pose, const Footprint::CoverDisc& disc);

}  // namespace mocha
