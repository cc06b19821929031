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
// Of a place that the search has found.
constexpr double kFoundSigma_m = 0.1;
constexpr double kFoundSigma_rad = 0.03;
constexpr double kOdometrySlack_m = 0.5;
constexpr double kSamePlace_m = 0.2;
constexpr double kSamePlace_rad = 0.2;

Eigen::Matrix3d diagonal(double sigma_m, double sigma_rad) {
  return Eigen::Vector3d(sigma_m * sigma_m, sigma_m * sigma_m, sigma_rad * sigma_rad).asDiagonal();
}

bool is_same(const Pose& a, const Pose& b) {
  return (a.position - b.position).norm() < kSamePlace_m &&
         std::abs(wrap_angle(a.yaw_rad - b.yaw_rad)) < kSamePlace_rad;
}

bool is_within(const PoseEstimate& expected, const Pose& pose) {
  Eigen::Vector3d off;
  off << pose.position - expected.pose.position, wrap_angle(pose.yaw_rad - expected.pose.yaw_rad);
  return off.dot(expected.covariance.inverse() * off) <= 9.0;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("ScanLocalizer: ") + what);
}

}  // namespace

ScanLocalizerOptions ScanLocalizerOptions::from(const ParameterTable& values,
                                                const RobotModel& model) {
  ScanLocalizerOptions options;
  options.hits = values.integer("hits");
  // The faces of a map that is only being made are not worn yet.
  options.wall_depth_m = values.flag("mapping") ? 0.0 : values.number("wall_depth");
  options.matcher.hit_noise_m = values.number("hit_noise");
  options.matcher.hit_reach_m = values.number("hit_reach");
  options.matcher.independent_hits = values.integer("independent_hits");
  options.tolerance_m = values.number("tolerance");
  options.least_hits = values.integer("least_hits");
  options.sure_quality = values.number("sure_quality");
  options.good_quality = values.number("good_quality");
  options.poor_quality = values.number("poor_quality");
  options.rivalry = values.number("rivalry");
  options.trial_s = values.number("trial_time");
  options.search_interval_s = values.number("search_interval");
  options.search_budget = values.integer("search_budget");
  options.max_sigma_m = values.number("max_sigma");
  // An odometry that is a little worse than it says is not to mislead.
  options.odometry_noise_distance = 2.0 * model.odometry_noise_distance;
  options.odometry_noise_yaw = 2.0 * model.odometry_noise_yaw;
  options.max_speed = model.limits.max_speed;
  return options;
}

void ScanLocalizer::set_map(const OccupancyGrid& map) {
  walls_.emplace(map, 1.0);
  search_.reset();  // built when it is needed
}

void ScanLocalizer::expect(const PoseEstimate& base) {
  const std::string fault = fault_of(base);
  require(fault.empty(), fault.c_str());
  places_.clear();
  expected_ = base;
  searched_s_.reset();
}

void ScanLocalizer::forget() {
  places_.clear();
  expected_.reset();
  odometry_.reset();
  time_s_.reset();
  searched_s_.reset();
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
  if (walls_ && static_cast<int>(thin.hits.size()) >= options_.least_hits) {
    fit(thin, dt_s);
    drop_hopeless(scan.time_s);
    if (wants_search(scan.time_s)) search(thin);
  }
  decide(scan.time_s, odometry);
  return localization_;
}

void ScanLocalizer::predict(const Pose& odometry, double dt_s) {
  Pose step = odometry_ ? relative(*odometry_, odometry) : Pose{};
  odometry_ = odometry;
  const double along_m = options_.odometry_noise_distance * std::sqrt(step.position.norm());
  const double turn_rad = options_.odometry_noise_yaw * std::sqrt(std::abs(step.yaw_rad));
  Eigen::Matrix3d noise = diagonal(along_m, turn_rad) + diagonal(kStepNoise_m, kStepNoise_rad);
  if (step.position.norm() > options_.max_speed * dt_s + kOdometrySlack_m) {
    step = Pose{};
    noise = diagonal(kFoundSigma_m, kFoundSigma_rad);
  }
  for (Place& place : places_) {
    place.base.pose = composed(place.base.pose, step);
    place.base.covariance += noise;
  }
}

void ScanLocalizer::fit(const ScanHits& scan, double dt_s) {
  const double weight = 2.0 * dt_s < options_.trial_s ? 2.0 * dt_s / options_.trial_s : 1.0;
  for (Place& place : places_) {
    place.base = ScanMatcher(options_.matcher).match(scan, *walls_, place.base);
    const ScanFit fit = fit_of(scan, place.base.pose, *walls_, options_.tolerance_m);
    if (fit.hits() - fit.unknown < options_.least_hits) continue;
    place.quality += weight * (fit.quality() - place.quality);
  }
}

/// Whether the place explains too little, or clearly less than another one. A believed place yields
/// only to one that has been tried as well.
bool ScanLocalizer::is_hopeless(const Place& place, double time_s) const {
  if (place.quality < options_.poor_quality) return true;
  return std::any_of(places_.begin(), places_.end(), [&](const Place& other) {
    return other.quality > place.quality + options_.rivalry &&
           (!place.believed || other.proved_s <= time_s);
  });
}

void ScanLocalizer::drop_hopeless(double time_s) {
  std::stable_sort(places_.begin(), places_.end(),
                   [](const Place& a, const Place& b) { return a.quality > b.quality; });
  std::vector<Place> kept;
  for (const Place& place : places_) {
    if (is_hopeless(place, time_s)) continue;
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Place& other) {
      return is_same(place.base.pose, other.base.pose);
    });
    if (same == kept.end()) {
      kept.push_back(place);
    } else {
      same->proved_s = std::min(same->proved_s, place.proved_s);
      same->believed |= place.believed;
      same->needed_quality = std::min(same->needed_quality, place.needed_quality);
    }
  }
  places_ = std::move(kept);
}

bool ScanLocalizer::wants_search(double time_s) const {
  if (searched_s_ && time_s - *searched_s_ < options_.search_interval_s) return false;
  return places_.empty() || places_[0].quality < options_.good_quality;
}

void ScanLocalizer::search(const ScanHits& scan) {
  searched_s_ = scan.time_s;
  if (!search_) search_.emplace(*walls_, BranchAndBoundMatcher::Options{options_.search_budget});
  const BranchAndBoundMatcher::Result result = search_->find(scan);
  searched_in_vain_ = !result.complete;
  const auto add_found = [&](const BranchAndBoundMatcher::Place& found, double needed_quality) {
    add_place(scan, {found.pose, diagonal(kFoundSigma_m, kFoundSigma_rad)}, needed_quality);
  };
  if (expected_) {
    add_place(scan, *expected_, options_.good_quality);
    for (const BranchAndBoundMatcher::Place& found : result.places) {
      if (is_within(*expected_, found.pose)) add_found(found, options_.good_quality);
    }
    expected_.reset();
    drop_hopeless(scan.time_s);
    if (!places_.empty()) return;
  }
  if (!result.complete) return;
  for (const BranchAndBoundMatcher::Place& found : result.places)
    add_found(found, options_.sure_quality);
  drop_hopeless(scan.time_s);
}

void ScanLocalizer::add_place(const ScanHits& scan, const PoseEstimate& guess,
                              double needed_quality) {
  const PoseEstimate base = ScanMatcher(options_.matcher).match(scan, *walls_, guess);
  const ScanFit fit = fit_of(scan, base.pose, *walls_, options_.tolerance_m);
  // What is unknown explains nothing: the robot is not to be taken for one at the rim of the map.
  const double quality = static_cast<double>(fit.on_wall) / fit.hits();
  places_.push_back({base, quality, needed_quality, scan.time_s + options_.trial_s, false});
}

void ScanLocalizer::decide(double time_s, const Pose& odometry) {
  localization_ = {};
  localization_.time_s = time_s;
  localization_.places = static_cast<int>(places_.size());
  localization_.searched_in_vain = places_.empty() && searched_in_vain_;
  if (places_.empty()) return;
  // The believed place stays believed while no other is clearly better.
  const auto believed = std::find_if(places_.begin(), places_.end(),
                                     [](const Place& place) { return place.believed; });
  Place& best = believed == places_.end() ? places_[0] : *believed;
  const bool proved =
      places_.size() == 1 && best.quality >= best.needed_quality && best.proved_s <= time_s;
  best.believed |= proved;
  const double sigma_m = std::sqrt(best.base.covariance.topLeftCorner<2, 2>().trace());
  if (sigma_m > options_.max_sigma_m) best.believed = false;
  localization_.state =
      best.believed ? Localization::State::kLocalized : Localization::State::kAmbiguous;
  localization_.base = best.base;
  localization_.quality = best.quality;
  localization_.odom_in_map = composed(best.base.pose, relative(odometry, Pose{}));
}

}  // namespace mocha
