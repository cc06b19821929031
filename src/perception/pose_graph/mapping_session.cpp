#include "perception/pose_graph/mapping_session.h"

#include <limits>
#include <numeric>
#include <utility>

#include "perception/pose_graph/scan_grid.h"
#include "trajectory/frame_change.h"

namespace mocha {
namespace {

constexpr double kMapCell_m = 0.05;

}  // namespace

MappingSession::MappingSession(const GraphMapperOptions& mapping,
                               const ScanLocalizerOptions& localization, DrivenMap map)
    : mapping_(mapping), localizing_(localization), before_(std::move(map)) {
  forget();
}

void MappingSession::forget() {
  mapper_ = std::make_unique<GraphMapper>(mapping_, before_);
  finder_.reset();
  localization_ = {};
  if (before_.keyframes.empty()) return;
  std::vector<int> all(before_.keyframes.size());
  std::iota(all.begin(), all.end(), 0);
  finder_.emplace(localizing_);
  finder_->set_map(grid_of(chosen(all, before_.graph, before_.keyframes), Vector2::Zero(),
                           std::numeric_limits<double>::max(), kMapCell_m));
}

void MappingSession::expect(const PoseEstimate& base) {
  if (finder_) finder_->expect(base);
}

void MappingSession::finish() {
  if (!finder_) mapper_->finish();
}

MapMatch::Fault MappingSession::merge(const DrivenMap& other) {
  const PoseGraph before = mapper_->graph();
  MergedMaps both = merged({before, mapper_->keyframes()}, other, mapping_.loops, mapping_.hits);
  if (both.fault != MapMatch::Fault::kNone) return both.fault;
  const int newest = before.size() - 1;
  const Pose base = composed(both.map.graph.poses()[newest],
                             relative(before.poses()[newest], localization_.base.pose));
  mapper_ = std::make_unique<GraphMapper>(mapping_, std::move(both.map));
  mapper_->begin({base, localization_.base.covariance});
  return both.fault;
}

const Localization& MappingSession::add(const ScanHits& scan, const Pose& odometry) {
  if (finder_) {
    localization_ = finder_->add(scan, odometry);
    if (localization_.state != Localization::State::kLocalized) return localization_;
    mapper_->begin(localization_.base);
    finder_.reset();
  }
  localization_ = {};
  localization_.base = mapper_->add(scan, odometry);
  localization_.state = Localization::State::kLocalized;
  localization_.time_s = scan.time_s;
  localization_.odom_in_map = composed(localization_.base.pose, relative(odometry, Pose{}));
  localization_.quality = mapper_->explained();
  localization_.places = 1;
  return localization_;
}

}  // namespace mocha
