#include "world/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

TEST(Footprint, ADiscCoversItself) {
  const Footprint disc = Footprint::disc(0.3);
  ASSERT_EQ(disc.cover().discs().size(), 1u);
  EXPECT_EQ(disc.cover().discs()[0].offset_m, Vector2::Zero());
  EXPECT_EQ(disc.cover().discs()[0].radius_m, 0.3);
  EXPECT_EQ(disc.soft_cover().size(), 1u);
  EXPECT_EQ(disc.circumscribed_radius_m(), 0.3);
  EXPECT_EQ(disc.inscribed_radius_m(), 0.3);
  EXPECT_EQ(disc.cover_reach_m(), 0.3);
  EXPECT_TRUE(disc.is_disc());
}

TEST(Footprint, TheJackalToACentimetre) {
  const Footprint jackal = Footprint::rectangle(0.508, 0.430);
  EXPECT_LE(jackal.cover().discs().size(), 25u);
  EXPECT_LE(jackal.soft_cover().size(), 2u);
  EXPECT_NEAR(jackal.circumscribed_radius_m(), std::hypot(0.254, 0.215), 1e-12);
  EXPECT_NEAR(jackal.inscribed_radius_m(), 0.215, 1e-12);
  for (const CoverDisc& disc : jackal.cover().discs()) {
    EXPECT_LE(std::abs(disc.offset_m.x()) + disc.radius_m, 0.254 + 0.01 + 1e-12);
    EXPECT_LE(std::abs(disc.offset_m.y()) + disc.radius_m, 0.215 + 0.01 + 1e-12);
    EXPECT_LE(disc.offset_m.norm() + disc.radius_m, jackal.cover_reach_m() + 1e-12);
  }
  EXPECT_LE(jackal.cover_reach_m(), jackal.circumscribed_radius_m() + 0.01);
  EXPECT_FALSE(jackal.is_disc());
}

TEST(Footprint, APolygonIsKeptCounterClockwise) {
  const std::vector<Vector2> corners = {{0.5, 0.0}, {-0.1, 0.3}, {-0.2, -0.4}};
  EXPECT_EQ(Footprint::polygon(corners).corners(), corners);
  const Footprint clockwise = Footprint::polygon({corners.rbegin(), corners.rend()});
  EXPECT_EQ(clockwise.corners(), corners);
  EXPECT_EQ(clockwise.circumscribed_radius_m(), 0.5);
  EXPECT_LT(clockwise.inscribed_radius_m(), 0.2);
}

TEST(Footprint, CoverDiscsFollowTheHeading) {
  const Vector2 centre = cover_centre({{1.0, 2.0}, M_PI / 2}, {{0.5, 0.25}, 0.3});
  EXPECT_NEAR((centre - Vector2(0.75, 2.5)).norm(), 0.0, 1e-12);
}

TEST(Footprint, RefusesSizesThatAreNotPositive) {
  EXPECT_THROW(Footprint::disc(0.0), std::invalid_argument);
  EXPECT_THROW(Footprint::disc(NAN), std::invalid_argument);
  EXPECT_THROW(Footprint::rectangle(-1.0, 0.4), std::invalid_argument);
  EXPECT_THROW(Footprint::rectangle(1.0, NAN), std::invalid_argument);
}

TEST(Footprint, SaysWhatIsWrongWithAPolygon) {
  const auto refused = [](const std::vector<Vector2>& corners, const std::string& why) {
    try {
      Footprint::polygon(corners);
      ADD_FAILURE() << "accepted, although: " << why;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refused({}, "at least 3 corners");
  refused({{-1.0, 0.0}, {1.0, 0.0}}, "at least 3 corners");
  refused({{-1.0, -1.0}, {1.0, NAN}, {0.0, 1.0}}, "not finite");
  refused({{-1.0, -1.0}, {INFINITY, 0.0}, {0.0, 1.0}}, "not finite");
  refused({{-1.0, -1.0}, {1.0, 1.0}, {1.0, -1.0}, {-1.0, 1.0}}, "cross");
  refused({{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {1.0, 2.0}, {1.0, 1.0}, {-1.0, 1.0}}, "cross");
  refused({{-1.0, -1.0}, {0.0, 0.0}, {1.0, 1.0}}, "no area");
  refused({{0.1, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {0.1, 1.0}}, "base_link");
  refused({{0.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {0.0, 1.0}}, "base_link");  // on the outline
}

}  // namespace
}  // namespace mocha
