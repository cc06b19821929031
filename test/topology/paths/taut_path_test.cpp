#include "topology/paths/taut_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "topology/roadmaps/static_space.h"
#include "trajectory/polyline.h"
#include "world/primitive_field.h"

namespace mocha {
namespace {

using Eigen::Vector3d;
using Path = std::vector<Vector3d>;

constexpr double kClearance_m = 0.5;

class TautPathTest : public testing::Test {
 protected:
  /// Pulls, and looks whether the path is still clear and passes the pillar on the same side.
  Path pulled(const Path& path) const {
    const Path taut = pulled_taut(path, space_);
    EXPECT_EQ(taut.front(), path.front());
    EXPECT_EQ(taut.back(), path.back());
    for (std::size_t i = 1; i < taut.size(); ++i)
      EXPECT_TRUE(space_.clearance_m(taut[i - 1], taut[i]));
    EXPECT_EQ(signature_of<3>(cuts_, taut), signature_of<3>(cuts_, path));
    EXPECT_LE(length_of<3>(taut), length_of<3>(path) + 1e-9);
    return taut;
  }

  const PrimitiveField<3> field_{{{{5.0, 5.0}, 1.0}}, 2.0};  // a pillar
  const Cuts<3> cuts_{{Column{{5.0, 5.0}}}};
  const StaticSpace<3> space_{field_,
                              cuts_,
                              {Vector3d(0.0, 0.0, 0.0), Vector3d(10.0, 10.0, 10.0)},
                              Vector3d(1.0, 5.0, 2.0),
                              {kClearance_m, 0.0}};
};

TEST_F(TautPathTest, GoesStraightWhereNothingIsInTheWay) {
  const Path taut = pulled({{1.0, 1.0, 1.0}, {3.0, 2.0, 6.0}, {6.0, 1.5, 2.0}, {9.0, 1.0, 5.0}});
  EXPECT_NEAR(length_of<3>(taut), (taut.back() - taut.front()).norm(), 1e-3);
}

TEST_F(TautPathTest, ClimbsEvenlyAroundAPillar) {
  const Path taut = pulled({{1.0, 5.0, 2.0}, {3.5, 7.5, 7.0}, {5.5, 7.5, 1.0}, {9.0, 5.0, 4.0}});
  double along_m = 0.0;
  double whole_m = 0.0;
  for (std::size_t i = 1; i < taut.size(); ++i) whole_m += (taut[i] - taut[i - 1]).head<2>().norm();
  for (std::size_t i = 1; i < taut.size(); ++i) {
    along_m += (taut[i] - taut[i - 1]).head<2>().norm();
    EXPECT_NEAR(taut[i].z(), 2.0 + 2.0 * along_m / whole_m, 0.1);
  }
  // A tangent, an arc and a tangent are the least there is.
  const double off = std::acos(1.5 / 4.0);
  const double arc_m = 1.5 * (M_PI - 2.0 * off);
  EXPECT_LT(whole_m, 1.08 * (2.0 * 4.0 * std::sin(off) + arc_m));
}

TEST_F(TautPathTest, LeavesWhatIsStraightAsItIs) {
  const Path path = {{1.0, 1.0, 1.0}, {9.0, 1.0, 5.0}};
  EXPECT_EQ(pulled(path), path);
}

}  // namespace
}  // namespace mocha
