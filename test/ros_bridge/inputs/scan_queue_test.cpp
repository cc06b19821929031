#include "ros_bridge/inputs/scan_queue.h"

#include <geometry_msgs/TransformStamped.h>
#include <gtest/gtest.h>

#include <cmath>

#include "ros_bridge/messages/map_conversions.h"
#include "ros_bridge/messages/sensor_conversions.h"

namespace mocha {
namespace {

sensor_msgs::LaserScan scan_at(double stamp_s, const std::string& frame = "laser") {
  sensor_msgs::LaserScan scan;
  scan.header.frame_id = frame;
  scan.header.stamp = ros::Time(stamp_s);
  scan.angle_min = -1.0F;
  scan.angle_max = 1.0F;
  scan.angle_increment = 0.02F;
  scan.time_increment = 0.001F;
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges.assign(101, 2.0F);
  return scan;
}

sensor_msgs::PointCloud2 cloud_at(double stamp_s) {
  sensor_msgs::PointCloud2 cloud;
  to_message(std::vector<Eigen::Vector3f>{{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}}, cloud);
  cloud.header.frame_id = "camera";
  cloud.header.stamp = ros::Time(stamp_s);
  return cloud;
}

void put_transform(tf2::BufferCore& transforms, double stamp_s, double x,
                   const std::string& child = "laser") {
  geometry_msgs::TransformStamped transform;
  transform.header.frame_id = "map";
  transform.header.stamp = ros::Time(stamp_s);
  transform.child_frame_id = child;
  transform.transform.translation.x = x;
  transform.transform.rotation.w = 1.0;
  transforms.setTransform(transform, "test");
}

class ScanQueueTest : public testing::Test {
 protected:
  std::vector<Measurement> take(double now_s) {
    return queue_.take_ready(transforms_, ros::Time(now_s), refusals_);
  }
  void add(const sensor_msgs::LaserScan& scan, double now_s = 100.0) {
    queue_.add(scan, ros::Time(now_s), refusals_);
  }

  tf2::BufferCore transforms_;
  Refusals refusals_;
  ScanQueue queue_{"map", 10.0, 1.0};
};

TEST_F(ScanQueueTest, WaitsForTheTransformAtTheLastBeam) {
  put_transform(transforms_, 99.9, 0.0);
  put_transform(transforms_, 100.05, 0.15);
  add(scan_at(100.0));
  EXPECT_TRUE(take(100.1).empty()) << "the sweep ends at 100.1";
  put_transform(transforms_, 100.2, 0.3);
  const auto ready = take(100.2);
  ASSERT_EQ(ready.size(), 1u);
  EXPECT_NEAR(ready[0].poses.first.translation().x(), 0.1, 1e-6);
  EXPECT_NEAR(ready[0].poses.last.translation().x(), 0.2, 1e-6);
  EXPECT_TRUE(take(100.2).empty());
  EXPECT_TRUE(refusals_.counts().empty());
}

TEST_F(ScanQueueTest, DropsWhatWaitsTooLongAndSaysWhy) {
  add(scan_at(100.0, "nowhere"));
  EXPECT_TRUE(take(101.0).empty());
  EXPECT_EQ(queue_.waiting(), 1u);
  EXPECT_TRUE(take(101.2).empty());
  EXPECT_EQ(queue_.waiting(), 0u);
  ASSERT_EQ(refusals_.counts().size(), 1u);
  EXPECT_EQ(refusals_.counts().begin()->first, "no transform map <- nowhere at the scan's time");
  EXPECT_NE(refusals_.newest().find("nowhere"), std::string::npos);
}

TEST_F(ScanQueueTest, TakesNoMoreThanTheRateOfEachSensor) {
  for (int i = 0; i < 40; ++i) {  // a second at 40 Hz
    add(scan_at(100.0 + 0.025 * i));
    add(scan_at(100.0 + 0.025 * i, "other"));
  }
  EXPECT_EQ(queue_.waiting(), 20u);
  queue_.clear();
  for (int i = 0; i < 10; ++i)
    add(scan_at(200.0 + 0.1 * i + (i % 2 ? 0.004 : -0.004)), 200.0 + 0.1 * i);
  EXPECT_EQ(queue_.waiting(), 10u) << "jitter costs a 10 Hz sensor nothing";
}

TEST_F(ScanQueueTest, RefusesMalformedScansByReason) {
  const auto refuses = [&](auto change) {
    sensor_msgs::LaserScan scan = scan_at(100.0);
    change(scan);
    const auto before = refusals_.counts();
    add(scan);
    return refusals_.counts() != before && queue_.waiting() == 0;
  };
  EXPECT_TRUE(refuses([](auto& s) { s.angle_increment = NAN; }));
  EXPECT_TRUE(refuses([](auto& s) { s.time_increment = NAN; }));
  EXPECT_TRUE(refuses([](auto& s) { s.ranges.clear(); }));
  EXPECT_TRUE(refuses([](auto& s) { s.ranges.resize(50); }));
  EXPECT_TRUE(refuses([](auto& s) { s.range_max = s.range_min; }));
  EXPECT_TRUE(refuses([](auto& s) { s.header.frame_id = ""; }));
  EXPECT_TRUE(refuses([](auto& s) { s.header.stamp = ros::Time(); }));
  EXPECT_TRUE(refuses([](auto& s) { s.header.stamp = ros::Time(200.0); }));
  EXPECT_TRUE(queue_.received().isZero());
}

TEST_F(ScanQueueTest, ReadsCloudsAndRefusesMalformedOnes) {
  const auto points = from_message(cloud_at(100.0));
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1], Eigen::Vector3f(4.0F, 5.0F, 6.0F));
  const auto fault = [](auto change) {
    sensor_msgs::PointCloud2 cloud = cloud_at(100.0);
    change(cloud);
    return fault_of(cloud);
  };
  EXPECT_EQ(fault([](auto&) {}), "");
  EXPECT_NE(fault([](auto& c) { c.data.resize(c.data.size() - 1); }), "");
  EXPECT_NE(fault([](auto& c) { c.fields[2].name = "w"; }), "");
  EXPECT_NE(fault([](auto& c) { c.fields[0].datatype = sensor_msgs::PointField::FLOAT64; }), "");
  EXPECT_NE(fault([](auto& c) { c.fields[1].offset = c.point_step - 1; }), "");
  EXPECT_NE(fault([](auto& c) { c.fields[1].offset = 0xffffffffU; }), "");
  EXPECT_NE(fault([](auto& c) { c.height = c.width = 0x10000; }), "");
  EXPECT_NE(fault([](auto& c) { c.width = 0; }), "");
  EXPECT_NE(fault([](auto& c) { c.is_bigendian = true; }), "");
  EXPECT_NE(fault([](auto& c) { c.height = 2, c.width = 1, c.row_step = 0; }), "");
  queue_.add(cloud_at(100.0), ros::Time(100.0), refusals_);
  put_transform(transforms_, 100.0, 1.0, "camera");
  EXPECT_EQ(take(100.0).size(), 1u);
}

}  // namespace
}  // namespace mocha
