#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "fleet/wire/byte_codec.h"
#include "trajectory/motion.h"

namespace mocha {

// What the parts of a message have in common: numbers as integers, times, places, names. Everything
// throws std::invalid_argument, saying what is wrong, for values that cannot be encoded or decoded.

// What an integer counts, in one second, metre, and so on. Whole numbers: so the nearest double to
// a decimal number comes back as it went.
constexpr double kTimes = 1e6;       // in [s]
constexpr double kPlaces = 1e5;      // in [m]
constexpr double kFine = 1e5;        // in [rad], [m/s], [m/s^2]
constexpr double kFiner = 1e7;       // in [rad], of short turns
constexpr double kRadii = 1e3;       // in [m]
constexpr double kBrakings = 1e3;    // in [m/s^2]
constexpr double kMostCount = 9e15;  // doubles hold whole numbers exactly up to about here
constexpr double kMostPlaceCount = kMostCount / 4.0;  // place_of() loses none up to here

constexpr std::size_t kMostName = 63;

inline void require_said(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument("message: " + what);
}

template <typename Integer>
void put_number(ByteWriter& out, double value, double counts, const char* name) {
  const double count = std::round(value * counts);
  const bool held = std::abs(count) < kMostCount &&
                    count >= static_cast<double>(std::numeric_limits<Integer>::min()) &&
                    count <= static_cast<double>(std::numeric_limits<Integer>::max());
  require_said(held, std::string(name) + " = " + std::to_string(value) + " is out of range");
  out.put(static_cast<Integer>(count));
}

template <typename Integer>
double get_number(ByteReader& in, double counts) {
  return static_cast<double>(in.get<Integer>()) / counts;
}

/// Of either sign, as put_number() takes it.
double get_time(ByteReader& in);

/// A place of the map, which may begin far away.
struct PlaceCounts {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

PlaceCounts counts_of(const Vector2& place);
/// The place of which these are the counts.
Vector2 place_of(const PlaceCounts& counts);

/// Names of robots are words of letters, digits, "_" and "/".
void put_name(ByteWriter& out, const std::string& name);
std::string get_name(ByteReader& in);

/// The number of `what` as one byte.
std::uint8_t count_of(std::size_t size, const char* what);

}  // namespace mocha
