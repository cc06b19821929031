#include "perception/tracking/fading_quantiles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace mocha {
namespace {

constexpr double kLeast = 0.02;
constexpr double kMost = 50.0;

void require(bool holds, const std::string& name, double value, const std::string& range) {
  if (holds) return;
  throw std::invalid_argument("FadingQuantiles: " + name + " is " + std::to_string(value) +
                              ", but must be " + range);
}

/// Of a normal distribution, the share below so many standard deviations.
double share_below(double deviations) { return 0.5 * std::erfc(-deviations * M_SQRT1_2); }

}  // namespace

FadingQuantiles::FadingQuantiles(double memory, const Prior& prior) : memory_(memory) {
  require(memory >= 1.0, "the memory", memory, "at least 1 value");
  require(prior.median > 0.0, "the prior's median", prior.median, "above 0");
  require(prior.log_sigma > 0.0, "the prior's log_sigma", prior.log_sigma, "above 0");
  require(prior.weight > 0.0, "the prior's weight", prior.weight, "above 0");
  const double step = std::log(kMost / kLeast) / kBins;
  double before = 0.0;
  for (int bin = 0; bin < kBins; ++bin) {
    const double end = std::log(kLeast / prior.median) + (bin + 1) * step;
    const double share = bin + 1 == kBins ? 1.0 : share_below(end / prior.log_sigma);
    weights_[bin] = prior.weight * (share - before);
    before = share;
  }
}

void FadingQuantiles::add(double value) {
  for (double& weight : weights_) weight *= 1.0 - 1.0 / memory_;
  const double place = std::log(std::clamp(value, kLeast, kMost) / kLeast);
  const int bin = static_cast<int>(place / std::log(kMost / kLeast) * kBins);
  weights_[std::min(bin, kBins - 1)] += 1.0;
}

double FadingQuantiles::quantile(double share) const {
  double left = share * std::accumulate(weights_.begin(), weights_.end(), 0.0);
  int bin = 0;
  while (bin + 1 < kBins && left > weights_[bin]) left -= weights_[bin++];
  const double inside = weights_[bin] > 0.0 ? std::min(1.0, left / weights_[bin]) : 1.0;
  return kLeast * std::pow(kMost / kLeast, (bin + inside) / kBins);
}

}  // namespace mocha
