#pragma once

#include <array>

namespace mocha {

/// The quantiles of positive values that come one after another, of which older ones count less: a
/// histogram over their logarithms, from 0.02 to 50 (values beyond count as these), that fades.
class FadingQuantiles {
 public:
  /// What is taken for granted before the first value: a log-normal distribution.
  struct Prior {
    double median;
    double log_sigma;  ///< standard deviation of the natural logarithm
    double weight;     ///< counts as so many values
  };

  /// A value counts 1 when it comes, and 1 - 1 / `memory` of that with each one that follows.
  /// Throws std::invalid_argument for a memory below 1 and a prior that is not positive.
  FadingQuantiles(double memory, const Prior& prior);

  void add(double value);

  /// What a share in (0, 1) of the values is below.
  double quantile(double share) const;

 private:
  static constexpr int kBins = 128;

  double memory_;
  std::array<double, kBins> weights_ = {};
};

}  // namespace mocha
