#include "world/footprint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mocha {
namespace {

TEST(Footprint, ADiscCoversItself) {
  const Footprint disc = Footprint::disc(0.3);
  ASSERT_EQ(disc.cover().size(), 1u);
  EXPECT_EQ(disc.cover()[0].offset_m, 0.0);
  EXPECT_EQ(disc.cover()[0].radius_m, 0.3);
  EXPECT_EQ(disc.circumscribed_radius_m(), 0.3);
  EXPECT_TRUE(disc.is_disc());
}

TEST(Footprint, TheJackalAsTwoDiscs) {
  const Footprint jackal = Footprint::rectangle(0.508, 0.430);
  ASSERT_EQ(jackal.cover().size(), 2u);
  EXPECT_NEAR(jackal.cover()[1].offset_m, 0.127, 1e-12);
  EXPECT_NEAR(jackal.cover()[0].radius_m, 0.25, 5e-4);
  EXPECT_NEAR(jackal.circumscribed_radius_m(), 0.333, 5e-4);
  EXPECT_FALSE(jackal.is_disc());
}

TEST(Footprint, TheDiscsCoverEveryPointOfARectangle) {
  for (int discs = 1; discs <= 4; ++discs) {
    const Footprint shape = Footprint::rectangle(0.9, 0.4, discs);
    for (double x = -0.45; x <= 0.4501; x += 0.01) {
      for (double y = -0.2; y <= 0.2001; y += 0.01) {
        const bool covered =
            std::any_of(shape.cover().begin(), shape.cover().end(), [&](const auto& disc) {
              return std::hypot(x - disc.offset_m, y) <= disc.radius_m + 1e-9;
            });
        EXPECT_TRUE(covered) << discs << " discs leave out (" << x << ", " << y << ")";
      }
    }
  }
}

TEST(Footprint, CoverDiscsFollowTheHeading) {
  const Vector2 centre = cover_centre({{1.0, 2.0}, M_PI / 2}, {0.5, 0.3});
  EXPECT_NEAR((centre - Vector2(1.0, 2.5)).norm(), 0.0, 1e-12);
}

TEST(Footprint, RefusesSizesThatAreNotPositive) {
  EXPECT_THROW(Footprint::disc(0.0), std::invalid_argument);
  EXPECT_THROW(Footprint::disc(NAN), std::invalid_argument);
  EXPECT_THROW(Footprint::rectangle(-1.0, 0.4), std::invalid_argument);
  EXPECT_THROW(Footprint::rectangle(1.0, 0.4, 0), std::invalid_argument);
}

}  // namespace
}  // namespace mocha
