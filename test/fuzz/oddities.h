#pragma once

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <random>

namespace mocha {

/// Ends the program with status 1, saying what does not hold.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::exit(1);
}

/// Chances, and numbers as broken sensors, drivers and files give them.
class Oddities {
 public:
  explicit Oddities(unsigned seed) : random_(seed) {}

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  bool one_in(int n) { return below(n) == 0; }
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  double number() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kOdd[] = {0.0,  5e-324, 1e-300, 1e-12,  1e-3,    1.0,       30.0,
                               1e3,  1600.0, 1638.4, 9.99e4, 1e5,     2147483.0, 1.07374e8,
                               1e10, 1e30,   1e38,   1e300,  1.7e308, kInfinity};
    if (one_in(8)) return std::numeric_limits<double>::quiet_NaN();
    const double size = kOdd[below(static_cast<int>(std::size(kOdd)))];
    return one_in(2) ? size : -size;
  }

 private:
  std::mt19937 random_;
};

}  // namespace mocha
