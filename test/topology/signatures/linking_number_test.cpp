#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "topology/signatures/h_signature.h"
#include "topology/signatures/signature_sums.h"

namespace mocha {
namespace {

using Eigen::Vector3d;

/// The solid angle of the triangle a, b, c seen from the origin (Van Oosterom and Strackee 1983).
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double volume = a.dot(b.cross(c));
  const double rest = a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() + b.dot(c) * a.norm() +
                      c.dot(a) * b.norm();
  return 2.0 * std::atan2(volume, rest);
}

/// Of two closed polygons, each with its first point repeated at its end: the Gauss integral in
/// closed form. For two sides it is the solid angle of the parallelogram of their differences.
double gauss_linking(const Path<3>& path, const Path<3>& curve) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (std::size_t j = 1; j < curve.size(); ++j) {
      const Vector3d a = path[i - 1] - curve[j - 1];
      const Vector3d b = path[i] - curve[j - 1];
      const Vector3d c = path[i] - curve[j];
      const Vector3d d = path[i - 1] - curve[j];
      sum -= solid_angle(a, b, c) + solid_angle(a, c, d);
    }
  }
  return sum / (4.0 * M_PI);
}

/// The same by brute force, to check the closed form itself.
double gauss_integral(const Path<3>& path, const Path<3>& curve) {
  constexpr int kSteps = 200;
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    for (std::size_t j = 1; j < curve.size(); ++j) {
      const Vector3d along = (path[i] - path[i - 1]) / kSteps;
      const Vector3d side = (curve[j] - curve[j - 1]) / kSteps;
      for (int k = 0; k < kSteps; ++k) {
        for (int l = 0; l < kSteps; ++l) {
          const Vector3d apart = path[i - 1] + (k + 0.5) * along - curve[j - 1] - (l + 0.5) * side;
          sum += apart.dot(along.cross(side)) / std::pow(apart.norm(), 3);
        }
      }
    }
  }
  return sum / (4.0 * M_PI);
}

Path<3> closed(std::vector<Vector3d> corners) {
  corners.push_back(corners.front());
  return corners;
}

double apart_m(const Vector3d& p, const Vector3d& q, const Vector3d& a, const Vector3d& b) {
  double least = 1e9;
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i) {
    const Vector3d at = p + (q - p) * (static_cast<double>(i) / kSteps);
    const Vector3d side = b - a;
    const double share = std::clamp(side.dot(at - a) / side.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (at - a - share * side).norm());
  }
  return least;
}

double apart_m(const Path<3>& one, const Path<3>& two) {
  double least = 1e9;
  for (std::size_t i = 1; i < one.size(); ++i) {
    for (std::size_t j = 1; j < two.size(); ++j) {
      if (one[i] == one[i - 1] || two[j] == two[j - 1]) continue;
      least = std::min(least, apart_m(one[i - 1], one[i], two[j - 1], two[j]));
    }
  }
  return least;
}

/// Corners anywhere in a cube of 10 m, or where `step_m` is above 0 on a lattice of 5 x 5 x 5.
std::vector<Vector3d> random_corners(int count, double step_m, std::mt19937_64& random) {
  std::vector<Vector3d> corners;
  while (static_cast<int>(corners.size()) < count) {
    Vector3d p(uniform(random, 0.0, 10.0), uniform(random, 0.0, 10.0), uniform(random, 0.0, 10.0));
    if (step_m > 0.0) {
      p = (0.1 + step_m * (0.5 * p).array().floor()).matrix();  // most are not exact in binary
    }
    corners.push_back(p);
  }
  return corners;
}

/// How close paths and curves may come to each other in the tests.
double least_apart_m(double step_m) { return step_m > 0.0 ? 0.15 * step_m : 0.1; }

void expect_gauss_linking(double step_m, int cases, std::mt19937_64& random) {
  int linked = 0;
  for (int done = 0; done < cases;) {
    const Loop loop{random_corners(3 + static_cast<int>(random() % 6), step_m, random)};
    const Path<3> curve = closed(loop.corners);
    const Path<3> path = closed(random_corners(3 + static_cast<int>(random() % 6), step_m, random));
    if (apart_m(path, curve) < least_apart_m(step_m)) continue;
    ++done;
    const int linking = signature_of(Cuts<3>({loop}), path)[0];
    ASSERT_NEAR(linking, gauss_linking(path, curve), 1e-4) << "case " << done;
    linked += linking != 0;
  }
  EXPECT_GT(linked, cases / 20);
}

TEST(SignatureInSpace, TheClosedFormOfTheTestIsTheGaussIntegral) {
  std::mt19937_64 random(3);
  for (int done = 0; done < 10;) {
    const Path<3> path = closed(random_corners(4, 0.0, random));
    const Path<3> curve = closed(random_corners(5, 0.0, random));
    if (apart_m(path, curve) < 0.5) continue;
    ++done;
    EXPECT_NEAR(gauss_linking(path, curve), gauss_integral(path, curve), 2e-2);
  }
}

TEST(SignatureInSpace, IsTheGaussLinkingNumberWithALoop) {
  std::mt19937_64 random(4);
  expect_gauss_linking(0.0, 1000, random);
}

TEST(SignatureInSpace, IsTheGaussLinkingNumberWhereCornersAndLinesLieOverEachOther) {
  // Seen from above, corners on corners, on lines and in line, of numbers that are rounded.
  std::mt19937_64 random(5);
  for (const double step_m : {0.1, 0.3, 1.0 / 3.0, 1.0, 2.5}) {
    SCOPED_TRACE(step_m);
    expect_gauss_linking(step_m, 5000, random);
  }
}

TEST(SignatureInSpace, AColumnIsAVeryTallLoopThatPointsUpward) {
  std::mt19937_64 random(6);
  for (int i = 0; i < 500; ++i) {
    const double step_m = i % 2 == 0 ? 0.5 : 0.0;
    const Vector3d foot = random_corners(1, step_m, random)[0];
    const Path<3> path = closed(random_corners(3 + i % 6, step_m, random));
    const Loop tall{{{foot.x(), foot.y(), -1e3},
                     {foot.x(), foot.y(), 1e3},
                     {foot.x() - 1e3, foot.y() + 20.0, 1e3},
                     {foot.x() - 1e3, foot.y() + 20.0, -1e3}}};
    if (apart_m(path, {tall.corners[0], tall.corners[1]}) < 0.1) continue;
    std::vector<Cuts<3>::Curve> curves(2);
    curves[0] = tall;
    curves[1] = Column{foot.head<2>()};
    const Signature signature = signature_of(Cuts<3>(curves), path);
    EXPECT_NEAR(signature[1], gauss_linking(path, closed(tall.corners)), 1e-4);
    EXPECT_EQ(signature[0], signature[1]);
  }
}

TEST(SignatureInSpace, CountsColumnsAndLoopsInTheOrderTheyAreGiven) {
  const Loop window{{{5.0, -1.0, 1.0}, {5.0, 1.0, 1.0}, {5.0, 1.0, 2.0}, {5.0, -1.0, 2.0}}};
  const Cuts<3> cuts({Column{{2.0, -5.0}}, window, Column{{8.0, -5.0}}});
  EXPECT_EQ(cuts.obstacles(), 3);
  // Towards +x through a frame that turns left about +x; columns to the right.
  const Signature through = signature_of(cuts, Path<3>{{0.0, 0.0, 1.5}, {10.0, 0.0, 1.5}});
  const Signature over = signature_of(cuts, Path<3>{{0.0, 0.0, 2.5}, {10.0, 0.0, 2.5}});
  const Signature under = signature_of(cuts, Path<3>{{0.0, 0.0, 0.5}, {10.0, 0.0, 0.5}});
  const Signature beside =
      signature_of(cuts, Path<3>{{0.0, 0.0, 1.5}, {5.0, 3.0, 1.5}, {10.0, 0.0, 1.5}});
  EXPECT_EQ(through, (Signature{-1, 1, -1}));
  for (const Signature& other : {over, under, beside}) EXPECT_EQ(other, (Signature{-1, 0, -1}));
}

TEST(SignatureInSpace, AddsUpAlongAPathAndTurnsItsSignWithIt) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 200; ++i) {
    const double step_m = i % 2 == 0 ? 0.0 : 0.7;
    std::vector<Cuts<3>::Curve> curves;
    const Path<3> path = random_corners(9, step_m, random);
    for (int r = 0; r < 6; ++r) {
      if (r % 2 == 0) {
        curves.emplace_back(Column{random_corners(1, 0.0, random)[0].head<2>()});
        continue;
      }
      Loop loop;
      do {
        loop.corners = random_corners(4, step_m, random);
      } while (apart_m(path, closed(loop.corners)) < least_apart_m(step_m));
      curves.emplace_back(loop);
    }
    expect_sums(Cuts<3>(curves), path);
  }
}

TEST(SignatureInSpace, ALoopNeedsThreeCorners) {
  EXPECT_THROW(Cuts<3>({Loop{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}}}), std::invalid_argument);
  EXPECT_THROW(Cuts<3>({Loop{}}), std::invalid_argument);
  EXPECT_NO_THROW(Cuts<3>({}));
}

}  // namespace
}  // namespace mocha
