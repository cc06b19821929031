#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "world/obstacle_field.h"

namespace mocha {

/// Exact distances to a list of circles.
class CircleField : public ObstacleField<2> {
 public:
  struct Circle {
    Vector centre;
    double radius_m;
  };

  explicit CircleField(std::vector<Circle> circles) : circles_(std::move(circles)) {}

  Sample sample(const Vector& p) const override {
    Sample nearest{std::numeric_limits<double>::infinity(), Vector::Zero()};
    for (const Circle& circle : circles_) {
      const double distance = (p - circle.centre).norm() - circle.radius_m;
      if (distance < nearest.distance_m) nearest = {distance, (p - circle.centre).normalized()};
    }
    return nearest;
  }
  void visit_near(const Vector& p, double radius_m, Visitor visit) const override {
    for (const Circle& circle : circles_) {
      const double distance = (p - circle.centre).norm() - circle.radius_m;
      if (distance < radius_m) visit({distance, (p - circle.centre).normalized()});
    }
  }
  double distance_bound(const Vector& p) const override {
    return std::max(0.0, sample(p).distance_m);
  }
  bool clear(const Box& box, double radius_m) const override {
    for (const Circle& circle : circles_) {
      if (box.exteriorDistance(circle.centre) < circle.radius_m + radius_m) return false;
    }
    return true;
  }

 private:
  std::vector<Circle> circles_;
};

}  // namespace mocha
