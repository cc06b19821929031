// A localiser that gets maps, scans, odometry and words of its place that are broken in all places.
// Whatever it was told, it finds its place again with a sound map and sound scans. Built with the
// sanitizers; whatever they or the checks below find ends the program with a status that is not 0.
//
//   fuzz_localizer COUNT SEED

#include <cmath>
#include <stdexcept>

#include "fuzz/lives.h"
#include "fuzz/oddities.h"
#include "perception/room.h"
#include "perception/shipped_options.h"

namespace mocha {
namespace {

constexpr int kLifetime = 200;  // broken inputs, after which it has to find its place
constexpr int kBeams = 180;
constexpr double kHitSpacing_m = 0.05;

/// A room that looks the same from nowhere else.
Room room() {
  Room room;
  room.low = {-2.0, -1.5};
  room.high = {2.5, 1.5};
  room.circles = {{{1.5, 0.7}, 0.4}, {{-1.2, -1.0}, 0.2}};
  return room;
}

ScanHits hits_from(const Pose& pose, double time_s) {
  auto beams = beams_at(room(), pose, 20.0, kBeams);
  for (Beam& beam : beams) beam.time_s = time_s;
  return hits_of(beams, pose, kHitSpacing_m);
}

OccupancyGrid sound_map() {
  OccupancyMap map(shipped_map_options());
  for (int i = 0; i < 5; ++i) {
    for (const Pose& pose : {Pose{{0.0, 0.0}, 0.0}, Pose{{0.8, -0.9}, 1.0}, Pose{{-1.0, 0.8}, 2.0}})
      map.insert_scan(beams_at(room(), pose));
  }
  return map.slice(0.5);
}

class Fuzzer {
 public:
  explicit Fuzzer(unsigned seed)
      : odd_(seed), map_(sound_map()), localizer_(shipped_localizer_options()) {}

  void run(int count) {
    for (int i = 0; i < count; ++i) {
      try {
        tell();
        ++taken_;
      } catch (const std::invalid_argument&) {
        ++refused_;
      }
    }
    recover();
  }

  int taken() const { return taken_; }
  int refused() const { return refused_; }

 private:
  void tell() {
    switch (odd_.below(16)) {
      case 0:
        return localizer_.set_map(odd_.one_in(2) ? map_ : damaged(map_));
      case 1:
        return localizer_.expect(estimate());
      case 2:
        if (odd_.one_in(3)) time_s_ = 0.0, localizer_.forget();
        return;
      default:
        scan();
    }
  }

  OccupancyGrid damaged(OccupancyGrid map) {
    if (odd_.one_in(2)) map.resolution_m = odd_.number();
    if (odd_.one_in(3)) map.origin[odd_.below(2)] = odd_.number();
    if (odd_.one_in(6)) map.width = odd_.below(300) - 100;
    if (odd_.one_in(6)) map.height = -map.height;
    if (odd_.one_in(6)) map.cells.resize(odd_.below(50));
    for (int i = odd_.below(20); i > 0 && !map.cells.empty(); --i)
      map.cells[odd_.below(static_cast<int>(map.cells.size()))] =
          static_cast<std::int8_t>(odd_.below(256) - 128);
    return map;
  }

  PoseEstimate estimate() {
    PoseEstimate estimate{{{odd_.between(-2.0, 2.0), 0.0}, 0.5},
                          Eigen::Vector3d(0.1, 0.1, 0.05).asDiagonal()};
    if (odd_.one_in(3)) estimate.pose.position[odd_.below(2)] = odd_.number();
    if (odd_.one_in(6)) estimate.pose.yaw_rad = odd_.number();
    if (odd_.one_in(3)) estimate.covariance(odd_.below(3), odd_.below(3)) = odd_.number();
    return estimate;
  }

  void scan() {
    Pose pose{{odd_.between(-1.5, 1.0), odd_.between(-0.8, 0.8)}, odd_.between(-3.0, 3.0)};
    ScanHits scan = hits_from(pose, time_s_ += 0.1);
    if (odd_.one_in(2)) damage(scan);
    if (odd_.one_in(8)) pose.position[odd_.below(2)] = odd_.number();
    if (odd_.one_in(20)) pose.yaw_rad = odd_.number();
    localizer_.add(scan, pose);
  }

  void damage(ScanHits& scan) {
    if (odd_.one_in(10)) scan.time_s = odd_.number();
    if (odd_.one_in(10)) scan.sensor[odd_.below(2)] = odd_.number();
    if (odd_.one_in(10)) scan.hits.resize(odd_.below(40), Vector2(1.0, 0.0));
    const int places = odd_.one_in(2) ? 0 : odd_.below(10);
    for (int i = 0; i < places && !scan.hits.empty(); ++i)
      scan.hits[odd_.below(static_cast<int>(scan.hits.size()))][odd_.below(2)] =
          odd_.one_in(3) ? odd_.number() : odd_.between(-30.0, 30.0);
  }

  void recover() {
    localizer_.set_map(map_);
    localizer_.forget();
    const Pose place{{0.5, -0.5}, 0.7};
    for (int i = 1; i <= 30; ++i) localizer_.add(hits_from(place, 0.1 * i), place);
    const Localization& now = localizer_.localization();
    require(now.state == Localization::State::kLocalized, "it does not find its place again");
    require((now.base.pose.position - place.position).norm() < 0.1, "it finds a wrong place");
  }

  Oddities odd_;
  const OccupancyGrid map_;
  ScanLocalizer localizer_;
  double time_s_ = 0.0;
  int taken_ = 0;
  int refused_ = 0;
};

}  // namespace
}  // namespace mocha

int main(int argc, char** argv) {
  return mocha::fuzz_lives<mocha::Fuzzer>(argc, argv, "fuzz_localizer", mocha::kLifetime);
}
