#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "optimization/ball_cost.h"
#include "world/moving/tube.h"

namespace mocha {

/// Paper (39) for discs and balls that move uniformly, piece by piece: phi(1 - d_r^2 / d_s^2),
/// where d_s is the tube's radius. Times of the tubes are those of the trajectory, from its start.
template <int D>
class TubePenalty : public Penalty<D> {
 public:
  /// `tubes`: as one wishes to keep away from them; their radii are above 0.
  TubePenalty(double weight, const std::vector<Tube<D>>& tubes) : weight_(weight) {
    for (const Tube<D>& tube : tubes) pieces_.insert(pieces_.end(), tube.begin(), tube.end());
  }

  const char* name() const override { return "moving"; }

  Derivatives wanted(const PieceBounds<D>& bounds) const override {
    for (const TubePiece<D>& piece : pieces_) {
      if (may_matter(piece, bounds)) return kPosition | kTime;
    }
    return kNone;
  }

  void add(const PieceSamples<D>& samples, PenaltyRows<D>& rows) const override {
    for (const TubePiece<D>& piece : pieces_) {
      if (!may_matter(piece, samples.bounds)) continue;
      for (int j = 0; j < samples.size(); ++j) add_one(piece, samples, j, rows);
    }
  }

 private:
  static bool may_matter(const TubePiece<D>& piece, const PieceBounds<D>& bounds) {
    const double from_s = std::max(bounds.start_s, piece.start_s);
    const double until_s = std::min(bounds.start_s + bounds.duration_s, piece.end_s);
    if (from_s > until_s) return false;
    Eigen::AlignedBox<double, D> swept(piece.centre_at(from_s));
    swept.extend(piece.centre_at(until_s));
    const double reach_m = std::max(piece.radius_at(from_s), piece.radius_at(until_s));
    return bounds.box.exteriorDistance(swept) <= reach_m;
  }

  void add_one(const TubePiece<D>& piece, const PieceSamples<D>& samples, int j,
               PenaltyRows<D>& rows) const {
    const double now = samples.time_s[j];
    // Half open, so that what is where two pieces meet counts once.
    if (now < piece.start_s || now >= piece.end_s) return;
    add_ball_cost<D>(
        weight_, {piece.centre_at(now), piece.velocity, piece.radius_at(now), piece.radius_rate},
        samples, j, rows);
  }

  double weight_;
  std::vector<TubePiece<D>> pieces_;
};

}  // namespace mocha
