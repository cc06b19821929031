#include "perception/sensor/point_cloud.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mocha {
namespace {

TEST(PointCloud, BecomesBeamsFromTheSensor) {
  const Eigen::Isometry3d pose =
      Eigen::Translation3d(1.0, 2.0, 0.5) * Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ());
  const auto beams = to_beams({{2.0F, 0.0F, 0.1F}}, pose, 7.0, 5.0, 0.05);
  ASSERT_EQ(beams.size(), 1u);
  EXPECT_TRUE(beams[0].origin.isApprox(Vector3(1.0, 2.0, 0.5), 1e-6));
  EXPECT_TRUE(beams[0].end.isApprox(Vector3(1.0, 4.0, 0.6), 1e-6));
  EXPECT_EQ(beams[0].kind, BeamEnd::kHit);
  EXPECT_EQ(beams[0].time_s, 7.0);
}

TEST(PointCloud, FarPointsOnlyClearAndInvalidOnesAreLeftOut) {
  const auto beams = to_beams({{8.0F, 6.0F, 0.0F}, {NAN, 0.0F, 0.0F}, {0.0F, INFINITY, 0.0F}},
                              Eigen::Isometry3d::Identity(), 0.0, 5.0, 0.05);
  ASSERT_EQ(beams.size(), 1u);
  EXPECT_EQ(beams[0].kind, BeamEnd::kMiss);
  EXPECT_TRUE(beams[0].end.isApprox(Vector3(4.0, 3.0, 0.0), 1e-6));
}

TEST(PointCloud, OnePointACubeIsEnough) {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 1000; ++i)
    points.emplace_back(1.0F + 0.0002F * static_cast<float>(i), -0.51F, -0.01F);
  EXPECT_LE(to_beams(points, Eigen::Isometry3d::Identity(), 0.0, 5.0, 0.05).size(), 5u);
}

}  // namespace
}  // namespace mocha
