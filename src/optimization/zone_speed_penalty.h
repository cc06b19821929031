#pragma once

#include <algorithm>
#include <memory>
#include <utility>

#include "optimization/penalty.h"
#include "world/primitive.h"
#include "world/speed_zones.h"

namespace mocha {

/// phi(|v|^2 / w^2 - 1) for each speed zone, where w^2 = w_z^2 + 4 a_max d: a share w_z of what the
/// zone asks for at the absolute time of the sample, and more off it. So the speed comes down
/// before the zone, as fast as the limit of acceleration lets it and half as fast again, and what
/// passes beside it is slower only where it is close.
class ZoneSpeedPenalty : public Penalty<2> {
 public:
  /// `start_time_s`: absolute time at which the trajectory begins; `share` of the limits.
  ZoneSpeedPenalty(double weight, std::shared_ptr<const SpeedZones> zones, double start_time_s,
                   double share, double max_acceleration)
      : weight_(weight),
        zones_(std::move(zones)),
        start_time_s_(start_time_s),
        share_(share),
        slope_(4.0 * max_acceleration) {}

  const char* name() const override { return "zones"; }

  Derivatives wanted(const PieceBounds<2>& piece) const override {
    for (const SpeedZones::Area& area : zones_->areas()) {
      if (may_matter(area, piece)) return kPosition | kVelocity | kTime;
    }
    return kNone;
  }

  void add(const PieceSamples<2>& samples, PenaltyRows<2>& rows) const override {
    for (const SpeedZones::Area& area : zones_->areas()) {
      if (!may_matter(area, samples.bounds)) continue;
      for (int j = 0; j < samples.size(); ++j) add_one(area, samples, j, rows);
    }
  }

 private:
  bool may_matter(const SpeedZones::Area& area, const PieceBounds<2>& piece) const {
    const double excess2 = piece.max_speed2 - share_ * share_ * area.max_speed * area.max_speed;
    return excess2 > 0.0 &&
           piece.box.exteriorDistance(area.box) < zones_->reach_m() + excess2 / slope_;
  }

  void add_one(const SpeedZones::Area& area, const PieceSamples<2>& samples, int j,
               PenaltyRows<2>& rows) const {
    const Eigen::Vector2d velocity = samples.velocity().row(j);
    const double limit = share_ * zones_->limit_at(area, start_time_s_ + samples.time_s[j]);
    const double speed2 = velocity.squaredNorm();
    if (speed2 <= limit * limit) return;
    const auto nearest = sample(area.area, Eigen::Vector2d(samples.position().row(j)));
    const double off_m = nearest.distance_m - zones_->reach_m();
    const double inverse = 1.0 / (limit * limit + slope_ * std::max(0.0, off_m));
    const Cubic penalty = cubic(speed2 * inverse - 1.0);
    if (penalty.value == 0.0) return;
    const double scale = weight_ * penalty.slope * inverse;
    const double by_square = -scale * speed2 * inverse;  // of the limit
    rows.value[j] += weight_ * penalty.value;
    rows.by_velocity().row(j) += 2.0 * scale * velocity;
    if (off_m > 0.0) rows.by_position().row(j) += by_square * slope_ * nearest.gradient;
    rows.by_time[j] += by_square * 2.0 * limit * share_ *
                       zones_->limit_rate(area, start_time_s_ + samples.time_s[j]);
  }

  double weight_;
  std::shared_ptr<const SpeedZones> zones_;
  double start_time_s_;
  double share_;
  double slope_;
};

}  // namespace mocha
