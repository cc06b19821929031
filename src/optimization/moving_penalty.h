#pragma once

#include <utility>
#include <vector>

#include "optimization/ball_cost.h"
#include "world/moving/moving_obstacle.h"

namespace mocha {

/// Paper (33)(39): phi(1 - d_n^2 / d_s^2) for each moving disc at the absolute time of the sample,
/// where d_s is its radius and what is to be kept from its rim.
class MovingPenalty : public Penalty<2> {
 public:
  /// `start_time_s`: absolute time at which the trajectory begins.
  MovingPenalty(double weight, double start_time_s, std::vector<MovingThing> others)
      : weight_(weight), start_time_s_(start_time_s), others_(std::move(others)) {
    for (const MovingThing& other : others_) boxes_.push_back(other.obstacle->box());
  }

  const char* name() const override { return "moving"; }

  Derivatives wanted(const PieceBounds<2>& piece) const override {
    for (std::size_t i = 0; i < others_.size(); ++i) {
      if (may_matter(i, piece)) return kPosition | kTime;
    }
    return kNone;
  }

  void add(const PieceSamples<2>& samples, PenaltyRows<2>& rows) const override {
    for (std::size_t i = 0; i < others_.size(); ++i) {
      if (!may_matter(i, samples.bounds)) continue;
      for (int j = 0; j < samples.size(); ++j) add_one(others_[i], samples, j, rows);
    }
  }

 private:
  /// Cheap for what never comes near, as most of a large fleet: nothing is asked of its motion.
  bool may_matter(std::size_t i, const PieceBounds<2>& piece) const {
    const MovingThing& other = others_[i];
    if (piece.box.exteriorDistance(boxes_[i]) > other.keep_m) return false;
    const double begin_s = start_time_s_ + piece.start_s;
    if (begin_s > other.until_s) return false;
    const double half_s = 0.5 * piece.duration_s;
    const MovingObstacle::Disc disc = other.obstacle->at(begin_s + half_s);
    const double reach_m =
        other.keep_m + disc.radius_m + other.obstacle->max_closing_speed(begin_s) * half_s;
    return !(piece.box.exteriorDistance(disc.centre) > reach_m);
  }

  void add_one(const MovingThing& other, const PieceSamples<2>& samples, int j,
               PenaltyRows<2>& rows) const {
    const double now = start_time_s_ + samples.time_s[j];
    if (now > other.until_s) return;
    const MovingObstacle::Disc disc = other.obstacle->at(now);
    add_ball_cost<2>(weight_,
                     {disc.centre, disc.velocity, other.keep_m + disc.radius_m, disc.radius_rate},
                     samples, j, rows);
  }

  double weight_;
  double start_time_s_;
  std::vector<MovingThing> others_;
  std::vector<Eigen::AlignedBox2d> boxes_;  // of the others
};

}  // namespace mocha
