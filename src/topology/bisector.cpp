#include "topology/bisector.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kMostPieces = 64.0;

Vector2 left_of(const Vector2& v) { return {-v.y(), v.x()}; }

double nearest_to_zero(double from, double to) {
  return from * to <= 0.0 ? 0.0 : std::min(std::abs(from), std::abs(to));
}

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
  // The chord over t - h to t + h is farthest from the arc at t, by (cosh(h) - 1) a b / |tangent|,
  // which is most where the arc is nearest to the line of centres; so is the clearance least.
  const double nearest = nearest_to_zero(from, to);
  const double tangent_m =
      std::hypot(real_m_ * std::sinh(nearest), imaginary_m_ * std::cosh(nearest));
  const double allowed_m = loss * clearance_m(nearest);
  const double half_step =
      std::acosh(1.0 + allowed_m * tangent_m / (std::abs(real_m_) * imaginary_m_));
  const double pieces = std::min(kMostPieces, std::ceil(0.5 * std::abs(to - from) / half_step));
  std::vector<Vector2> corners;
  for (int i = 1; i < pieces; ++i) corners.push_back(at(from + (to - from) * i / pieces));
  return corners;
}

}  // namespace mocha
