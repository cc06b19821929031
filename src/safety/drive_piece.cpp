#include "safety/drive_piece.h"

namespace mocha {
namespace {

constexpr double kNoise = 1e-6;       // share of the largest control point, below which one is zero
constexpr double kStanding_m = 1e-6;  // the direction of less motion is rounding

/// The velocity divided by u^k (1 - u)^l, where k and l are the orders of its zeros at the ends
/// that are rests.
Bernstein<2, 4> course_of(const Bernstein<2, 4>& velocity, bool from_rest, bool to_rest) {
  Bernstein<2, 4> course = velocity;
  int degree = 4;
  const auto vanishes = [&](int j) {
    const double largest = course.leftCols(degree + 1).colwise().norm().maxCoeff();
    return degree > 0 && course.col(j).norm() < kNoise * largest;
  };
  for (; from_rest && vanishes(0); --degree) {
    for (int j = 1; j <= degree; ++j) course.col(j - 1) = course.col(j) * degree / j;
  }
  for (; to_rest && vanishes(degree); --degree) {
    for (int j = 0; j < degree; ++j) course.col(j) *= static_cast<double>(degree) / (degree - j);
  }
  for (; degree < 4; ++degree) {  // elevate to the common degree
    course.col(degree + 1) = course.col(degree);
    for (int j = degree; j >= 1; --j) {
      const double share = static_cast<double>(j) / (degree + 1);
      course.col(j) = share * course.col(j - 1) + (1.0 - share) * course.col(j);
    }
  }
  return course;
}

/// Everywhere the direction of `along`; ahead without one, as Motion has it.
Bernstein<2, 4> steady(const Vector2& along) {
  return (along.isZero(0.0) ? Vector2(1.0, 0.0) : along).rowwise().replicate<5>();
}

}  // namespace

std::vector<DrivePiece> drive_pieces(const Motion& motion, int phase, double from_s) {
  const auto& drive = std::get<DrivePhase>(motion.phases()[phase]);
  const auto path = curve_pieces(drive.path, motion.phase_start_time(phase), from_s);
  std::vector<DrivePiece> pieces;
  pieces.reserve(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const bool first = i == 0;
    const bool last = i + 1 == path.size();
    const auto& velocity = path[i].velocity;
    const bool stands = (first || last) && velocity.colwise().norm().maxCoeff() < kStanding_m;
    pieces.push_back(
        {path[i], drive.direction,
         stands ? steady(velocity.rowwise().sum()) : course_of(velocity, first, last)});
  }
  return pieces;
}

}  // namespace mocha
