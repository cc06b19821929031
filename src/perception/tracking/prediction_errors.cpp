#include "perception/tracking/prediction_errors.h"

#include <algorithm>
#include <utility>

namespace mocha {
namespace {

constexpr double kAhead_s[] = {0.5, 1.0, 2.0};
constexpr double kConfidences[] = {0.5, 0.8, 0.9, 0.95, 0.98, 0.99};
// Errors: fewer follow faster, more are steadier.
constexpr double kMemory = 300.0;
constexpr double kLongest_s = 0.25;  // between two scans
// Of errors in 14 recorded crowds (ETH, UCY).
constexpr FadingQuantiles::Prior kAt = {0.52, 0.89, 150.0};
constexpr FadingQuantiles::Prior kThroughout = {0.83, 0.85, 150.0};

}  // namespace

PredictionErrors::PredictionErrors()
    : at_(std::size(kAhead_s), FadingQuantiles(kMemory, kAt)),
      throughout_(std::size(kAhead_s), FadingQuantiles(kMemory, kThroughout)) {}

void PredictionErrors::update(const std::vector<TrackedObstacle>& things) {
  std::map<std::uint32_t, std::vector<Prediction>> pending;
  for (const TrackedObstacle& thing : things) {
    std::vector<Prediction>& predictions = pending[thing.id];
    if (const auto former = pending_.find(thing.id); former != pending_.end())
      predictions = std::move(former->second);
    if (!thing.is_seen) continue;
    for (Prediction& prediction : predictions) compare(prediction, thing);
    predictions.erase(
        std::remove_if(predictions.begin(), predictions.end(),
                       [](const Prediction& each) { return each.next == std::size(kAhead_s); }),
        predictions.end());
    predictions.push_back({thing, PredictedDeviation::of(thing.covariance)});
  }
  pending_ = std::move(pending);
}

void PredictionErrors::compare(Prediction& prediction, const TrackedObstacle& seen) {
  const TrackedObstacle& then = prediction.thing;
  const double ahead_s = seen.time_s - then.time_s;
  const double off_m = (seen.seen_at - then.position - ahead_s * then.velocity).norm();
  const double off = off_m / prediction.deviation.after(ahead_s);
  const double since_s = ahead_s - prediction.ahead_s;
  for (; prediction.next < std::size(kAhead_s) && ahead_s >= kAhead_s[prediction.next];
       ++prediction.next) {
    if (since_s > kLongest_s) continue;  // it was not seen then
    const double share = (kAhead_s[prediction.next] - prediction.ahead_s) / since_s;
    const double off_then = prediction.off + share * (off - prediction.off);
    at_[prediction.next].add(off_then);
    throughout_[prediction.next].add(std::max(off_then, prediction.farthest));
  }
  prediction.ahead_s = ahead_s;
  prediction.off = off;
  prediction.farthest = std::max(prediction.farthest, off);
}

PredictionSpread PredictionErrors::spread() const {
  PredictionSpread spread{{std::begin(kAhead_s), std::end(kAhead_s)},
                          {std::begin(kConfidences), std::end(kConfidences)},
                          {},
                          {}};
  spread.at.resize(std::size(kAhead_s), std::size(kConfidences));
  spread.throughout = spread.at;
  for (std::size_t row = 0; row < std::size(kAhead_s); ++row) {
    for (std::size_t column = 0; column < std::size(kConfidences); ++column) {
      spread.at(row, column) = at_[row].quantile(kConfidences[column]);
      spread.throughout(row, column) = throughout_[row].quantile(kConfidences[column]);
    }
  }
  return spread;
}

}  // namespace mocha
