#include "perception/sensor/blind_wall.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>

#include "trajectory/plane_vectors.h"

namespace mocha {
namespace {

constexpr double kLongest_m = 0.1;      // between two hits on the same surface
constexpr double kSurface_m = 0.1;      // of a wall, at least
constexpr double kEnough_m = 0.3;       // of it
constexpr double kStraight_m = 0.03;    // so far off the line, another surface begins
constexpr double kOutermost_rad = 0.1;  // from the first beam to the first hit, at most

/// The straight line that is nearest to points.
class Line {
 public:
  void add(const Vector2& point) {
    ++count_;
    sum_ += point;
    squares_ += point * point.transpose();
  }
  Vector2 centre() const { return sum_ / count_; }
  Vector2 direction() const {
    const Eigen::Matrix2d spread = squares_ / count_ - centre() * centre().transpose();
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors().col(1);
  }
  double distance_m(const Vector2& point) const {
    const Vector2 along = direction();
    const Vector2 off = point - centre();
    return std::abs(cross(along, off));
  }

 private:
  int count_ = 0;
  Vector2 sum_ = Vector2::Zero();
  Eigen::Matrix2d squares_ = Eigen::Matrix2d::Zero();
};

/// The wall where a sweep ends, going inwards from there.
template <class Iterator>
std::optional<BlindWall> wall_at(Iterator beam, Iterator last) {
  if (beam == last) return std::nullopt;
  const Vector2 outermost = ray(*beam);
  while (beam != last && beam->kind != BeamEnd::kHit) ++beam;
  if (beam == last || std::abs(angle_between(outermost, ray(*beam))) > kOutermost_rad)
    return std::nullopt;
  const Vector2 seen = ray(*beam);
  const Vector2 end = beam->end.template head<2>();
  Vector2 before = end;
  Line line;
  for (; beam != last && (before - end).norm() < kEnough_m; ++beam) {
    if (beam->kind != BeamEnd::kHit) continue;
    const Vector2 here = beam->end.template head<2>();
    const bool is_long = (before - end).norm() >= kSurface_m;
    if ((here - before).norm() > kLongest_m || (is_long && line.distance_m(here) > kStraight_m))
      break;
    line.add(here);
    before = here;
  }
  if ((before - end).norm() < kSurface_m) return std::nullopt;
  Vector2 along = line.direction();
  if (along.dot(end - before) < 0.0) along = -along;
  const Vector2 across(-along.y(), along.x());
  return BlindWall{line.centre() + along * along.dot(end - line.centre()), along,
                   across.dot(seen) > 0.0 ? across : Vector2(-across)};
}

}  // namespace

std::vector<BlindWall> blind_walls(const std::vector<Beam>& sweep) {
  std::vector<BlindWall> walls;
  if (const auto wall = wall_at(sweep.begin(), sweep.end())) walls.push_back(*wall);
  if (const auto wall = wall_at(sweep.rbegin(), sweep.rend())) walls.push_back(*wall);
  return walls;
}

}  // namespace mocha
