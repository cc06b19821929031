#include "safety/drive_piece.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr double kNoise = 1e-6;  // share of the largest control point, below which one is zero
constexpr double kShortest_s = 1e-6;

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

}  // namespace

std::vector<DrivePiece> drive_pieces(const Motion& motion, int phase, double from_s) {
  const auto& drive = std::get<DrivePhase>(motion.phases()[phase]);
  const double phase_start = motion.phase_start_time(phase);
  std::vector<DrivePiece> pieces;
  pieces.reserve(drive.path.pieces());
  for (int i = 0; i < drive.path.pieces(); ++i) {
    const double start = phase_start + drive.path.piece_start(i);
    const double tau = drive.path.piece_duration(i);
    // What is left is a share of tau, not a difference of absolute times, which are coarse: all
    // speeds would be wrong by the error of the quotient.
    const double over = std::max(0.0, (from_s - start) / tau);
    const double left_s = (1.0 - over) * tau;
    if (over > 0.0 && left_s < kShortest_s) continue;
    DrivePiece piece{start, tau, drive.direction, false, to_bernstein(drive.path.piece(i)), {}, {}};
    if (over > 0.0) {
      piece.position = split(piece.position, over).second;
      piece.start_s = from_s;
      piece.duration_s = left_s;
    }
    const bool last = i + 1 == drive.path.pieces();
    piece.velocity = derivative(piece.position);
    piece.course = course_of(piece.velocity, pieces.empty(), last);
    piece.begins_or_ends_drive = pieces.empty() || last;
    pieces.push_back(piece);
  }
  return pieces;
}

}  // namespace mocha
