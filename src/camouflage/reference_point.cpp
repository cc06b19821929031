#include "camouflage/reference_point.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

namespace mocha {
namespace {

constexpr double kLeastLeverage_m = 1e-3;  // between a reference and its knots
constexpr double kStraight = 1e-6;         // deviation from the chord, relative to its length

/// Places reference points for stretches of one path.
template <int D>
class ReferenceChooser {
 public:
  using Point = Eigen::Matrix<double, D, 1>;
  using Points = Eigen::Matrix<double, D, Eigen::Dynamic>;

  ReferenceChooser(const Points& path, const ObstacleField<D>& field, double side_depth_m)
      : path_(path), field_(field), side_depth_m_(side_depth_m) {}

  /// The apex over the stretch between two points of the path, on the sparser side if that keeps
  /// the angle, else on the other.
  std::optional<Point> reference_for(int from, int to) const {
    const Point chord = path_.col(to) - path_.col(from);
    const Point side = side_of(from, to, chord);
    std::optional<Point> apex;
    for (const double sign : {1.0, -1.0}) {
      const Point there = path_.col(from) + 0.5 * (chord + sign * chord.norm() * side);
      if (!keeps_angle(from, to, there)) continue;
      // Room is asked for last: it takes long, and most stretches keep no angle.
      const bool sparser = apex && room_beside(from, to, -side) > room_beside(from, to, side);
      if (!apex || sparser) apex = there;
    }
    return apex;
  }

  /// Why the knot has no reference, not even one of its own.
  ReferenceFault fault_at(int knot) const {
    for (const int k : {knot, knot + 1}) {
      // Written so that a step that is not finite counts, too.
      if (!((path_.col(k) - path_.col(k - 1)).norm() > kLeastLeverage_m))
        return ReferenceFault::kCoincidentPoints;
    }
    return ReferenceFault::kSharpBend;
  }

 private:
  /// A unit vector across the chord: the left in the plane.
  Point side_of(int from, int to, const Point& chord) const {
    if constexpr (D == 2) {
      return Point(-chord.y(), chord.x()).normalized();
    } else {
      const Point along = chord.normalized();
      Eigen::Matrix<double, D, D> scatter = Eigen::Matrix<double, D, D>::Zero();
      for (int k = from + 1; k < to; ++k) {
        const Point offset = path_.col(k) - path_.col(from);
        const Point beside = offset - offset.dot(along) * along;
        scatter += beside * beside.transpose();
      }
      if (!(scatter.trace() > kStraight * kStraight * chord.squaredNorm())) {
        const Point level = along.cross(Point::UnitZ());
        return (level.squaredNorm() > kStraight ? level : Point::UnitX()).normalized();
      }
      return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>>(scatter).eigenvectors().col(
          D - 1);
    }
  }

  /// Free room beside the stretch, summed: the sparser side has more.
  double room_beside(int from, int to, const Point& side) const {
    double room = 0.0;
    for (int k = from; k < to; ++k) {
      const Point along = (path_.col(k + 1) - path_.col(k)).normalized();
      const Point middle = 0.5 * (path_.col(k) + path_.col(k + 1));
      const Point across = (side - side.dot(along) * along).normalized();
      for (const double share : {0.5, 1.0}) {
        const Point beside = middle + share * side_depth_m_ * across;
        room += std::clamp(field_.sample(beside).distance_m, 0.0, side_depth_m_);
      }
    }
    return room;
  }

  /// Do the rays to the knots strictly between from and to keep the angle to the path on both sides
  /// of the knot?
  bool keeps_angle(int from, int to, const Point& reference) const {
    for (int k = from + 1; k < to; ++k) {
      const Point ray = path_.col(k) - reference;
      for (const Point& along :
           {Point(path_.col(k) - path_.col(k - 1)), Point(path_.col(k + 1) - path_.col(k))}) {
        // Written so that a vanishing ray or step fails, too.
        if (!(ray.norm() > kLeastLeverage_m &&
              std::abs(ray.dot(along)) < max_cosine_ * ray.norm() * along.norm()))
          return false;
      }
    }
    return true;
  }

  const Points& path_;
  const ObstacleField<D>& field_;
  const double side_depth_m_;
  const double max_cosine_ = std::cos(kLeastRayAngle_rad);
};

}  // namespace

template <int D>
ReferencesOrFault<D> choose_references(const Eigen::Matrix<double, D, Eigen::Dynamic>& path,
                                       const ObstacleField<D>& field, double side_depth_m) {
  const ReferenceChooser<D> chooser(path, field, side_depth_m);
  const int last = static_cast<int>(path.cols()) - 1;
  ReferencesOrFault<D> result;
  result.references.resize(D, std::max(0, last - 1));
  for (int from = 0; from + 1 < last;) {
    int to = last;
    std::optional<Eigen::Matrix<double, D, 1>> reference;
    // Stretches overlap by one step, so that every interior knot lies strictly inside one of them.
    for (; to >= from + 2 && !reference; --to) reference = chooser.reference_for(from, to);
    if (!reference) return {{}, chooser.fault_at(from + 1), path.col(from + 1)};
    ++to;
    for (int k = from + 1; k < to; ++k) result.references.col(k - 1) = *reference;
    from = to - 1;
  }
  return result;
}

template ReferencesOrFault<2> choose_references<2>(const Eigen::Matrix2Xd&, const ObstacleField<2>&,
                                                   double);
template ReferencesOrFault<3> choose_references<3>(const Eigen::Matrix3Xd&, const ObstacleField<3>&,
                                                   double);

}  // namespace mocha
