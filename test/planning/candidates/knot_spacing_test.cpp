#include "planning/candidates/knot_spacing.h"

#include <gtest/gtest.h>

#include <vector>

#include "safety/circle_field.h"

namespace mocha {
namespace {

constexpr KnotSpacings kSpacings{0.8, 4.0};

double spacing_beside_m(double distance_m) {
  std::vector<CircleField::Circle> row;
  for (double x = 0.0; x <= 100.0; x += 0.5) row.push_back({{x, distance_m + 0.1}, 0.1});
  return knot_spacing_for_room<2>({{0.0, 0.0}, {100.0, 0.0}}, CircleField(row), kSpacings);
}

TEST(KnotSpacing, FollowsTheClutter) {
  EXPECT_EQ(spacing_beside_m(0.4), kSpacings.narrow_m);
  EXPECT_GT(spacing_beside_m(1.2), 1.5 * kSpacings.narrow_m);
  EXPECT_LT(spacing_beside_m(1.2), spacing_beside_m(2.0));
  EXPECT_EQ(spacing_beside_m(30.0), kSpacings.open_m);
}

TEST(KnotSpacing, LeavesAShortPathItsPieces) {
  EXPECT_LT(knot_spacing_for_room<2>({{0.0, 0.0}, {10.0, 0.0}}, CircleField({}), kSpacings),
            kSpacings.open_m);
}

}  // namespace
}  // namespace mocha
