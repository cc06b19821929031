// Scans, clouds, transforms and team-mates that are broken in all places, on the way that
// perception takes them: beams, moving things, map. Built with the sanitizers; whatever they or the
// checks below find ends the program with a status that is not 0.
//
//   fuzz_scans COUNT SEED

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fleet/protocol/motions.h"
#include "fuzz/lives.h"
#include "fuzz/oddities.h"
#include "perception/room.h"
#include "perception/sensor/point_cloud.h"
#include "perception/sensor/range_smoothing.h"
#include "perception/shipped_options.h"
#include "perception/tracking/peer_tracks.h"
#include "trajectory/rover_braking.h"

namespace mocha {
namespace {

constexpr int kLifetime = 50;  // scans, after which a map that may be full of errors is replaced
constexpr int kBeams = 90;
constexpr double kSpacing_m = 0.05;  // of the points of a cloud that are taken
constexpr BeamReach kReach{30.0, 10.0};

class Fuzzer {
 public:
  explicit Fuzzer(unsigned seed)
      : odd_(seed),
        map_(shipped_map_options()),
        filter_(shipped_sorter_options()),
        peers_(0.15, 1.0) {}

  void run(int count) {
    for (int i = 0; i < count; ++i) {
      time_s_ += 0.1;
      if (odd_.one_in(4)) hear_peer();
      try {
        odd_.one_in(4) ? see_points() : see_scan();
      } catch (const MapError&) {
        ++refused_;
      }
    }
    check();
  }

  int taken() const { return taken_; }
  int refused() const { return refused_; }

 private:
  void hear_peer() {
    const double x = odd_.one_in(4) ? odd_.number() : odd_.between(-3.0, 3.0);
    if (!(std::abs(x) < 1e12)) return;  // no motion
    const auto motion = test::shared(test::stand(time_s_, {x, 1.0}));
    const double radius_m = odd_.between(0.1, 1.0);
    peers_.update(time_s_, {{"ugv2", {1, ++promises_}, motion, radius_m, test::kRoverBraking}});
  }

  void see_scan() {
    const Pose pose{{odd_.between(-3.0, 3.0), odd_.between(-2.0, 2.0)}, odd_.between(-3.0, 3.0)};
    Room room;
    room.circles = {{{1.5 * std::sin(time_s_), 1.0}, 0.25}, {{-1.0, 1.5 * std::cos(time_s_)}, 0.3}};
    PlanarScan scan = sweep(
        room, [&](double) { return pose; }, 20.0, kBeams, 0.1);
    scan.start_time_s = time_s_;
    SweepPoses poses{sensor_pose(pose), sensor_pose(pose)};
    if (odd_.one_in(4)) turn_round(scan);
    if (!odd_.one_in(3)) damage(scan);
    if (odd_.one_in(3)) damage(odd_.one_in(2) ? poses.first : poses.last);
    take(scan, poses);
  }

  /// Makes it a clockwise scan of the mirrored room.
  static void turn_round(PlanarScan& scan) {
    std::swap(scan.angle_min_rad, scan.angle_max_rad);
    scan.angle_increment_rad = -scan.angle_increment_rad;
  }

  void damage(PlanarScan& scan) {
    for (double* value :
         {&scan.start_time_s, &scan.time_increment_s, &scan.angle_min_rad, &scan.angle_max_rad,
          &scan.angle_increment_rad, &scan.range_min_m, &scan.range_max_m}) {
      if (odd_.one_in(40)) *value = odd_.number();
    }
    if (odd_.one_in(20)) scan.ranges_m.resize(odd_.below(4));
    for (float& range : scan.ranges_m) {
      if (odd_.one_in(20)) range = static_cast<float>(odd_.number());
    }
  }

  void damage(Eigen::Isometry3d& pose) {
    pose.translation()[odd_.below(3)] = odd_.number();
    if (odd_.one_in(10)) pose.linear()(odd_.below(3), odd_.below(3)) = odd_.number();
  }

  void take(const PlanarScan& scan, const SweepPoses& poses) {
    if (!fault_of(scan).empty()) {
      ++refused_;
      return;
    }
    auto beams = to_beams(smoothed(scan, smoothing_m_), poses, kReach);
    clear_peers();
    const Pose base{poses.last.translation().head<2>(), odd_.number()};
    map_.see_robot(base, start_ground_, blind_walls(beams));
    peers_.ignore_peers(beams);
    filter_.sort(beams, map_);
    map_.insert_scan(beams);
    map_.clear_body(base, robot_.footprint);
    filter_.moving(time_s_);
    ++taken_;
  }

  void see_points() {
    std::vector<Eigen::Vector3f> points;
    for (int i = odd_.below(50); i >= 0; --i) {
      points.emplace_back(odd_.between(-4.0, 4.0), odd_.between(-4.0, 4.0),
                          odd_.between(-0.5, 1.5));
      if (odd_.one_in(10)) points.back()[odd_.below(3)] = static_cast<float>(odd_.number());
    }
    Eigen::Isometry3d pose = sensor_pose({{odd_.between(-3.0, 3.0), 0.0}, 0.3});
    if (odd_.one_in(4)) damage(pose);
    auto beams = to_beams(points, pose, time_s_, 5.0, kSpacing_m);
    clear_peers();
    peers_.ignore_peers(beams);
    map_.insert_points(beams);
    ++taken_;
  }

  void clear_peers() {
    for (const auto& disc : peers_.at(time_s_)) map_.clear_disc(disc.centre, disc.radius_m);
  }

  void check() const {
    const OccupancyGrid slice = map_.slice(0.5);
    require(slice.cells.size() == static_cast<std::size_t>(slice.width) * slice.height,
            "the map's sizes do not match");
    for (const Eigen::Vector3f& voxel : map_.occupied_voxels())
      require(voxel.allFinite(), "something stands nowhere");
    for (const TrackedObstacle& thing : filter_.moving(time_s_))
      require(thing.radius_m > 0.0 && thing.radius_m < 1.0, "a moving thing has an odd radius");
  }

  Oddities odd_;
  const RobotModel robot_ = load_robot_model("config", "jackal");
  const StartGround start_ground_{robot_};
  const double smoothing_m_ = shipped_smoothing_m();
  OccupancyMap map_;
  MovingObjectFilter filter_;
  PeerTracks peers_;
  double time_s_ = 100.0;
  std::uint32_t promises_ = 0;
  int taken_ = 0;
  int refused_ = 0;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::fuzz_lives<mocha::Fuzzer>(argc, argv, "fuzz_scans", mocha::kLifetime);
}
