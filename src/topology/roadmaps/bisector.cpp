#include "topology/roadmaps/bisector.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kLeastClearance_m = 1e-4;  // that is told from none

Vector2 left_of(const Vector2& v) { return {-v.y(), v.x()}; }

}  // namespace

Bisector::Bisector(const Circle& first, const Circle& second)
    : centres_{first.centre, second.centre},
      mean_radius_m_(0.5 * (first.radius_m + second.radius_m)),
      real_m_(0.5 * (first.radius_m - second.radius_m)) {
  const Vector2 apart = second.centre - first.centre;
  middle_ = first.centre + 0.5 * apart;
  along_ = apart.normalized();
  focal_m_ = 0.5 * apart.norm();
  imaginary_m_ =
      std::sqrt(std::max(0.0, (focal_m_ - std::abs(real_m_)) * (focal_m_ + std::abs(real_m_))));
}

Vector2 Bisector::at(double t) const {
  return middle_ + real_m_ * std::cosh(t) * along_ + imaginary_m_ * std::sinh(t) * left_of(along_);
}

double Bisector::clearance_m(double t) const { return focal_m_ * std::cosh(t) - mean_radius_m_; }

double Bisector::parameter(const Vector2& p) const {
  const double left_m = left_of(along_).dot(p - middle_);
  const double cosh = 0.5 * ((p - centres_[0]).norm() + (p - centres_[1]).norm()) / focal_m_;
  // Each of the two is precise where the other is not.
  return cosh < 2.0 ? std::asinh(left_m / imaginary_m_) : std::copysign(std::acosh(cosh), left_m);
}

double Bisector::reach(double clearance_m) const {
  return std::acosh(std::max(1.0, (clearance_m + mean_radius_m_) / focal_m_));
}

std::vector<Vector2> Bisector::corners(double from, double to, double loss) const {
  std::vector<Vector2> corners;
  refine(from, to, loss, corners);
  return corners;
}

void Bisector::refine(double from, double to, double loss, std::vector<Vector2>& corners) const {
  const double half = 0.5 * std::abs(to - from);
  const double middle = 0.5 * (from + to);
  // The chord is farthest from the arc in the middle of the parameters.
  const double tangent_m =
      std::hypot(real_m_ * std::sinh(middle), imaginary_m_ * std::cosh(middle));
  const double off_m = (std::cosh(half) - 1.0) * std::abs(real_m_) * imaginary_m_ / tangent_m;
  const double least_m = clearance_m(std::max(0.0, std::abs(middle) - half));
  if (!(off_m > loss * std::max(least_m, kLeastClearance_m))) return;
  refine(from, middle, loss, corners);
  corners.push_back(at(middle));
  refine(middle, to, loss, corners);
}

}  // namespace mocha
