#include "trajectory/plane_vectors.h"

#include <gtest/gtest.h>

namespace mocha {
namespace {

using Vector = Eigen::Vector2d;

TEST(PlaneVectors, ToTheLeftIsPositive) {
  EXPECT_DOUBLE_EQ(cross(Vector(2.0, 0.0), Vector(5.0, 3.0)), 6.0);
  EXPECT_DOUBLE_EQ(cross(Vector(2.0, 0.0), Vector(5.0, -3.0)), -6.0);
  EXPECT_DOUBLE_EQ(angle_between(Vector(2.0, 0.0), Vector(0.0, 3.0)), M_PI / 2.0);
  EXPECT_DOUBLE_EQ(angle_between(Vector(0.0, 3.0), Vector(2.0, 0.0)), -M_PI / 2.0);
}

TEST(PlaneVectors, AnglesTakeTheShortWayRound) {
  const Vector a(-1.0, 0.1);
  const Vector b(-1.0, -0.1);
  EXPECT_NEAR(angle_between(a, b), 2.0 * std::atan(0.1), 1e-12);
  EXPECT_EQ(angle_between(a, Vector::Zero()), 0.0);
}

}  // namespace
}  // namespace mocha
