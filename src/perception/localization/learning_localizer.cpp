#include "perception/localization/learning_localizer.h"

namespace mocha {

LearningLocalizer::LearningLocalizer(const ScanLocalizerOptions& options, const OccupancyGrid& map,
                                     double lasting_s)
    : good_quality_(options.places.good_quality), localizer_(options), changes_(map, lasting_s) {
  localizer_.set_map(map);
}

const Localization& LearningLocalizer::add(const ScanHits& scan, const Pose& odometry) {
  const Localization& now = localizer_.add(scan, odometry);
  const bool is_sure = now.state == Localization::State::kLocalized && now.quality >= good_quality_;
  if (is_sure && changes_.add(scan, now.base.pose)) {
    localizer_.set_map(changes_.map());
    ++changed_;
  }
  return now;
}

void LearningLocalizer::forget() {
  localizer_.forget();
  changes_.forget_doubts();
}

}  // namespace mocha
