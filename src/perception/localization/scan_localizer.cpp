#include "perception/localization/scan_localizer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "trajectory/frame_change.h"

namespace mocha {
namespace {

// What a scan's fit does not tell of itself: the map's own error, the same from scan to scan.
constexpr double kStepNoise_m = 0.005;
constexpr double kStepNoise_rad = 0.002;
constexpr double kFoundSigma_m = 0.1;
constexpr double kFoundSigma_rad = 0.03;
constexpr double kOdometrySlack_m = 0.5;
constexpr double kJump = 0.05;         // more has to be explained where it should not be
constexpr double kSlip_m = 1.0;        // of the odometry at once
constexpr double kMostUnknown = 0.35;  // share of a scan of which the map says nothing
constexpr double kLeastScore = 0.6;    // of places that are looked at more closely
constexpr int kMostRefutations = 3;    // of what the odometry says
constexpr double kMostPatience = 8.0;  // between searches that are in vain, in intervals

Eigen::Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

/// Of a place that a search has found.
PoseEstimate found_at(const Pose& pose) { return {pose, diagonal(kFoundSigma_m, kFoundSigma_rad)}; }

bool is_within(const PoseEstimate& expected, const Pose& pose) {
  Eigen::Vector3d off;
  off << pose.position - expected.pose.position, wrap_angle(pose.yaw_rad - expected.pose.yaw_rad);
  return off.dot(expected.covariance.inverse() * off) <= 9.0;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("ScanLocalizer: ") + what);
}

}  // namespace

ScanLocalizer::ScanLocalizer(const ScanLocalizerOptions& options)
    : options_(options), places_(options.places) {
  forget();
}

void ScanLocalizer::set_map(const OccupancyGrid& map) {
  walls_.emplace(map, 1.0);
  search_.reset();
}

void ScanLocalizer::expect(const PoseEstimate& base) {
  const std::string fault = fault_of(base);
  require(fault.empty(), fault.c_str());
  places_.clear();
  expected_ = base;
  reckoned_.reset();
  search_s_ = around_s_ = -INFINITY;
  search_interval_s_ = options_.search_interval_s;
}

void ScanLocalizer::forget() {
  places_.clear();
  expected_.reset();
  reckoned_.reset();
  odometry_.reset();
  time_s_.reset();
  refutations_ = 0;
  search_s_ = around_s_ = -INFINITY;
  search_interval_s_ = options_.search_interval_s;
  searched_in_vain_ = false;
  localization_ = {};
}

const Localization& ScanLocalizer::add(const ScanHits& scan, const Pose& odometry) {
  check_measured(scan, odometry);
  require(!time_s_ || scan.time_s > *time_s_, "the scan is not newer than the one before");
  const double dt_s = time_s_ ? scan.time_s - *time_s_ : 0.0;
  time_s_ = scan.time_s;
  predict(odometry, dt_s);
  const ScanHits thin = deepened(thinned(scan, options_.hits), options_.wall_depth_m);
  const bool may_tell = walls_ && static_cast<int>(thin.hits.size()) >= options_.least_hits;
  if (may_tell) fit(thin, dt_s);
  places_.drop([this](const PlaceHypothesis& place) { return is_unsure(place.base); });
  sift(scan.time_s);
  if (may_tell && wants_search(scan.time_s)) search(thin);
  decide(scan.time_s, odometry);
  return localization_;
}

void ScanLocalizer::predict(const Pose& odometry, double dt_s) {
  Pose step = odometry_ ? relative(*odometry_, odometry) : Pose{};
  odometry_ = odometry;
  Eigen::Matrix3d noise = diagonal(kStepNoise_m, kStepNoise_rad);
  if (step.position.norm() > options_.max_speed * dt_s + kOdometrySlack_m) {
    step = Pose{};
    noise = diagonal(kFoundSigma_m, kFoundSigma_rad);
  }
  const auto move = [&](PoseEstimate& base) {
    base = options_.odometry.after(base, step);
    base.covariance += noise;
  };
  for (PlaceHypothesis& place : places_.all()) move(place.base);
  if (reckoned_) move(*reckoned_);
}

ScanLocalizer::FittedPlace ScanLocalizer::fitted(const ScanHits& scan,
                                                 const PoseEstimate& guess) const {
  const PoseEstimate base = ScanMatcher(options_.matcher).match(scan, *walls_, guess);
  return {base, fit_of(scan, base.pose, *walls_, options_.tolerance_m)};
}

/// The places within three standard deviations that a search finds.
std::vector<ScanLocalizer::FittedPlace> ScanLocalizer::look_around(const ScanHits& scan,
                                                                   const PoseEstimate& base) {
  std::vector<FittedPlace> places;
  for (const auto& found : searcher().find(scan, SearchWindow::around(base)).places) {
    const FittedPlace place = fitted(scan, found_at(found.pose));
    if (is_within(base, place.base.pose)) places.push_back(place);
  }
  return places;
}

/// Fits the scan where the robot should be. What may be farther off than hits reach is looked for
/// around, so that a slip does not end at the wrong one of many doors.
ScanLocalizer::FittedPlace ScanLocalizer::follow(const ScanHits& scan, const PoseEstimate& base) {
  FittedPlace best = fitted(scan, base);
  if (3.0 * base.sigma_m() < options_.matcher.hit_reach_m) return best;
  double needed = best.fit.quality() + kJump;
  for (const FittedPlace& other : look_around(scan, base)) {
    if (other.fit.quality() <= needed) continue;
    best = other;
    needed = other.fit.quality();
  }
  return best;
}

void ScanLocalizer::fit(const ScanHits& scan, double dt_s) {
  const double weight = 2.0 * dt_s < options_.trial_s ? 2.0 * dt_s / options_.trial_s : 1.0;
  for (PlaceHypothesis& place : places_.all()) {
    const FittedPlace now = follow(scan, place.base);
    if (now.fit.known() < options_.least_hits) continue;
    place.base = now.base;
    place.quality += weight * (now.fit.quality() - place.quality);
  }
}

/// What the odometry says ends with the place that it led on from.
void ScanLocalizer::sift(double time_s) {
  if (places_.sift(time_s)) reckoned_.reset();
}

bool ScanLocalizer::is_unsure(const PoseEstimate& base) const {
  return base.sigma_m() > options_.max_sigma_m || base.sigma_rad() > options_.max_sigma_yaw_rad;
}

/// Where nothing is known for good, and where a place has to be found once more to be believed.
bool ScanLocalizer::wants_search(double time_s) const {
  if (places_.empty()) return true;
  if (best().quality < options_.places.good_quality) return true;
  return places_.all().size() == 1 && !best().confirmed && best().proved_s <= time_s;
}

/// Made when it is needed: that takes a while in large maps.
const BranchAndBoundMatcher& ScanLocalizer::searcher() {
  if (!search_) {
    BranchAndBoundMatcher::Options options{options_.search_budget};
    options.min_score = kLeastScore;
    search_.emplace(*walls_, options);
  }
  return *search_;
}

void ScanLocalizer::search(const ScanHits& scan) {
  searched_in_vain_ = false;
  if (const auto hint = std::exchange(expected_, std::nullopt)) {
    if (search_around(scan, *hint, true)) return;
  } else if (reckoned_) {
    if (scan.time_s < around_s_) return;
    around_s_ = scan.time_s + options_.search_interval_s;
    // Where the odometry has led far, much looks alike.
    if (search_around(scan, *reckoned_, !is_unsure(*reckoned_))) return;
    const bool doubts =
        places_.is_doubted() || (!places_.empty() && (best().believed || best().carried));
    if (!doubts && !is_refuted(scan)) return;
  }
  if (scan.time_s >= search_s_) search_everywhere(scan);
}

/// Whether the robot is not where the odometry has led it: the map knows that place, and does not
/// explain several scans there.
bool ScanLocalizer::is_refuted(const ScanHits& scan) {
  const ScanFit there = fit_of(scan, reckoned_->pose, *walls_, options_.tolerance_m);
  if (there.unknown > kMostUnknown * there.hits()) return false;
  if (++refutations_ >= kMostRefutations) return true;
  around_s_ = scan.time_s;
  return false;
}

/// Adds the places near to where the robot should be. Returns whether one of them is good.
bool ScanLocalizer::search_around(const ScanHits& scan, const PoseEstimate& base, bool is_sure) {
  add(scan.time_s, fitted(scan, base), is_sure);
  for (const FittedPlace& place : look_around(scan, base)) add(scan.time_s, place, is_sure);
  sift(scan.time_s);
  return !places_.empty() && !best().carried && best().quality >= options_.places.good_quality;
}

void ScanLocalizer::search_everywhere(const ScanHits& scan) {
  search_s_ = scan.time_s + search_interval_s_;
  search_interval_s_ =
      std::min(2.0 * search_interval_s_, kMostPatience * options_.search_interval_s);
  const BranchAndBoundMatcher::Result result = searcher().find(scan);
  searched_in_vain_ = !result.complete;
  if (!result.complete) return;
  for (const BranchAndBoundMatcher::Place& found : result.places)
    add(scan.time_s, fitted(scan, found_at(found.pose)), false);
  sift(scan.time_s);
}

void ScanLocalizer::add(double time_s, const FittedPlace& place, bool confirmed) {
  // What is unknown explains nothing: the robot is not to be taken for one at the rim of the map.
  const double quality = static_cast<double>(place.fit.on_wall) / place.fit.hits();
  const bool carried = reckoned_ && !places_.is_doubted() &&
                       (place.base.pose.position - reckoned_->pose.position).norm() >
                           3.0 * reckoned_->sigma_m() + kSlip_m;
  places_.add({place.base, quality, time_s + options_.trial_s, carried, confirmed});
}

void ScanLocalizer::decide(double time_s, const Pose& odometry) {
  if (places_.believe(time_s)) search_interval_s_ = options_.search_interval_s;
  localization_ = {};
  localization_.time_s = time_s;
  localization_.places = static_cast<int>(places_.all().size());
  localization_.searched_in_vain = places_.empty() && searched_in_vain_;
  if (places_.empty()) return;
  localization_.state =
      places_.is_certain() ? Localization::State::kLocalized : Localization::State::kAmbiguous;
  localization_.base = best().base;
  localization_.quality = best().quality;
  localization_.odom_in_map = composed(best().base.pose, relative(odometry, Pose{}));
  if (!best().believed) return;
  reckoned_ = best().base;
  if (best().quality >= options_.places.good_quality) refutations_ = 0;
}

}  // namespace mocha
