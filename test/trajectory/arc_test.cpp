#include "trajectory/arc.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(Arc, AQuarterOfACircleEndsBesideItsCentre) {
  const Pose end = advanced({{1.0, 2.0}, 0.0}, {0.5 * kPi * 3.0, 0.5 * kPi});
  EXPECT_NEAR(end.position.x(), 4.0, 1e-12);
  EXPECT_NEAR(end.position.y(), 5.0, 1e-12);
  EXPECT_NEAR(end.yaw_rad, 0.5 * kPi, 1e-12);
}

TEST(Arc, IsFoundAgainBetweenItsEnds) {
  for (const Arc& arc :
       {Arc{0.7, 0.4}, Arc{-0.3, 1.2}, Arc{0.2, 0.0}, Arc{0.0, -2.0}, Arc{1.0, 1e-8}}) {
    const Pose from{{-3.0, 0.5}, 2.9};
    const Arc found = arc_between(from, advanced(from, arc));
    EXPECT_NEAR(found.length_m, arc.length_m, 1e-9);
    EXPECT_NEAR(found.turn_rad, arc.turn_rad, 1e-12);
  }
}

}  // namespace
}  // namespace mocha
