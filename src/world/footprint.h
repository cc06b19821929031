#pragma once

#include <vector>

#include "trajectory/motion.h"
#include "world/disc_tree.h"

namespace mocha {

/// The shape of a robot about its base, and discs that cover it.
class Footprint {
 public:
  /// By so much do the discs of cover() reach out of a polygon, at most.
  static constexpr double kCoverTolerance_m = 0.008;
  /// By so much do those of soft_cover() reach out, at most, or leave out of the body.
  static constexpr double kSoftCoverTolerance_m = 0.055;

  /// A disc. Throws std::invalid_argument unless the radius is positive.
  static Footprint disc(double radius_m);

  /// A rectangle centred on the base, `length_m` along the heading. Throws std::invalid_argument
  /// unless both are positive.
  static Footprint rectangle(double length_m, double width_m);

  /// A simple polygon with the base inside; its corners in the body frame, in either sense. Throws
  /// std::invalid_argument saying what is wrong with it.
  static Footprint polygon(std::vector<Vector2> corners);

  /// For proofs: every point of the body is in one of its discs.
  const DiscTree& cover() const { return cover_; }
  /// For penalties: few discs, roughly the body.
  const std::vector<CoverDisc>& soft_cover() const { return soft_cover_; }

  /// Radius of the disc about the base that the robot sweeps when it turns in place.
  double circumscribed_radius_m() const { return circumscribed_radius_m_; }
  /// Radius of the largest disc about the base inside the body: less room lets no motion pass.
  double inscribed_radius_m() const { return inscribed_radius_m_; }
  /// How far a point of the body frame is below the outline [m]; negative outside.
  double depth_m(const Vector2& in_body) const;
  /// Radius of the disc about the base that holds all discs of cover().
  double cover_reach_m() const;

  bool is_disc() const { return corners_.empty(); }
  /// Corners of the true shape in the body frame, counter-clockwise; empty for a disc.
  const std::vector<Vector2>& corners() const { return corners_; }

 private:
  DiscTree cover_;
  std::vector<CoverDisc> soft_cover_;
  std::vector<Vector2> corners_;
  double circumscribed_radius_m_ = 0.0;
  double inscribed_radius_m_ = 0.0;
};

/// A vector of the body frame in the map's, where the unit vector `heading` is ahead.
inline Vector2 turned(const Vector2& in_body, const Vector2& heading) {
  return {in_body.x() * heading.x() - in_body.y() * heading.y(),
          in_body.x() * heading.y() + in_body.y() * heading.x()};
}

/// Centre of a cover disc of a robot at `pose`, map frame.
Vector2 cover_centre(const Pose& pose, const CoverDisc& disc);

}  // namespace mocha
