#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

namespace mocha {

/// Static obstacles as an optimiser and a prover see them. Implementations are immutable once
/// built.
template <int D>
class ObstacleField {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Box = Eigen::AlignedBox<double, D>;

  struct Sample {
    double
        distance_m;  ///< to the nearest obstacle, negative inside; differentiable almost everywhere
    Vector gradient;  ///< of distance_m
  };

  /// A reference to what is called with each obstacle's own sample. It owns nothing: hand a lambda
  /// straight to visit_near().
  class Visitor {
   public:
    template <typename Callable>
    Visitor(const Callable& callable)
        : callable_(&callable), call_([](const void* target, const Sample& sample) {
            (*static_cast<const Callable*>(target))(sample);
          }) {}
    void operator()(const Sample& sample) const { call_(callable_, sample); }

   private:
    const void* callable_;
    void (*call_)(const void*, const Sample&);
  };

  virtual ~ObstacleField() = default;

  /// For gradients only: interpolated where the implementation samples.
  virtual Sample sample(const Vector& p) const = 0;

  /// Calls `visit` for each obstacle whose surface is closer to p than `radius_m` >= 0, or around
  /// p: the terms of paper (30). A distance that is not a number counts as close. A field that does
  /// not tell its obstacles apart, such as a map, has only its nearest distance to show, which is
  /// the default.
  virtual void visit_near(const Vector& p, double radius_m, Visitor visit) const {
    const Sample nearest = sample(p);
    if (!(nearest.distance_m >= radius_m)) visit(nearest);
  }

  /// A proven lower bound on the distance from p to the nearest obstacle [m], at least 0. For
  /// certificates.
  virtual double distance_bound(const Vector& p) const = 0;

  /// How far p may move at least before visit_near() with this radius visits anything [m]; 0 where
  /// it does so already.
  virtual double room(const Vector& p, double radius_m) const {
    return std::max(0.0, distance_bound(p) - radius_m);
  }

  /// True only if visit_near() with this radius visits nothing from anywhere in the box.
  virtual bool clear(const Box& box, double radius_m) const = 0;
};

}  // namespace mocha
