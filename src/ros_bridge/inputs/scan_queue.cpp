#include "ros_bridge/inputs/scan_queue.h"

#include <ros/console.h>
#include <tf2/exceptions.h>

#include "ros_bridge/messages/sensor_conversions.h"

namespace mocha {
namespace {

constexpr std::size_t kMostWaiting = 200;
constexpr double kRateSlack =
    0.9;  // jitter is not to cost a sensor at just the permitted rate every other scan

}  // namespace

ScanQueue::ScanQueue(std::string map_frame, double rate, double patience_s)
    : map_frame_(std::move(map_frame)), spacing_(kRateSlack / rate), patience_s_(patience_s) {}

void ScanQueue::add(const sensor_msgs::LaserScan& message, ros::Time now, Refusals& refusals) {
  PlanarScan scan = from_message(message);
  if (const std::string fault = fault_of(scan); !fault.empty())
    return refusals.add("scan: " + fault);
  const auto& [seq, stamp, frame] = message.header;
  if (!accept(frame, stamp, now, refusals)) return;
  const ros::Time last = stamp + ros::Duration(scan.end_time_s() - scan.start_time_s);
  waiting_.push_back({frame, stamp, last, std::move(scan), {}});
}

void ScanQueue::add(const sensor_msgs::PointCloud2& cloud, ros::Time now, Refusals& refusals) {
  if (const std::string fault = fault_of(cloud); !fault.empty())
    return refusals.add("points: " + fault);
  const auto& [seq, stamp, frame] = cloud.header;
  if (!accept(frame, stamp, now, refusals)) return;
  waiting_.push_back({frame, stamp, stamp, from_message(cloud), {}});
}

bool ScanQueue::accept(const std::string& frame, ros::Time first, ros::Time now,
                       Refusals& refusals) {
  const auto refuse = [&](const std::string& reason) {
    refusals.add(reason);
    return false;
  };
  if (frame.empty()) return refuse("no frame_id");
  if (first.isZero()) return refuse("no time stamp");
  if ((first - now).toSec() > patience_s_) return refuse("time stamp in the future");
  received_ = now;
  ros::Time& newest = accepted_[frame];
  if (first >= newest && first - newest < spacing_) return false;
  if (waiting_.size() >= kMostWaiting) return refuse("too many scans wait for their transforms");
  newest = first;
  return true;
}

bool ScanQueue::locate(Measurement& measurement, const tf2::BufferCore& transforms,
                       std::string& why) const {
  const auto pose_at = [&](ros::Time time) {
    return from_message(transforms.lookupTransform(map_frame_, measurement.frame, time).transform);
  };
  try {
    measurement.poses = {pose_at(measurement.first), pose_at(measurement.last)};
    return true;
  } catch (const tf2::TransformException& error) {
    why = error.what();
    return false;
  }
}

std::vector<Measurement> ScanQueue::take_ready(const tf2::BufferCore& transforms, ros::Time now,
                                               Refusals& refusals) {
  std::vector<Measurement> ready;
  std::deque<Measurement> still_waiting;
  for (Measurement& measurement : waiting_) {
    std::string why;
    if (locate(measurement, transforms, why)) {
      ready.push_back(std::move(measurement));
    } else if ((now - measurement.last).toSec() > patience_s_) {
      refusals.add(
          "no transform " + map_frame_ + " <- " + measurement.frame + " at the scan's time", why);
    } else {
      still_waiting.push_back(std::move(measurement));
    }
  }
  waiting_.swap(still_waiting);
  return ready;
}

void ScanQueue::clear() {
  waiting_.clear();
  accepted_.clear();
  received_ = ros::Time();
}

}  // namespace mocha
