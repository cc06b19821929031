#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <type_traits>

namespace mocha::test {

/// 128 bits that stand for a whole state: among a billion states, two share them by accident with a
/// probability below 1e-20.
struct Fingerprint {
  std::uint64_t high = 0;
  std::uint64_t low = 0;

  bool operator==(const Fingerprint& other) const { return high == other.high && low == other.low; }
};

/// Takes values in order, and makes a fingerprint of them.
class StateHash {
 public:
  void add(std::uint64_t value) {
    print_.high = mixed(print_.high ^ mixed(value + 0x9e3779b97f4a7c15u));
    print_.low = mixed(print_.low + 0x632be59bd9b4e019u) ^ mixed(value ^ 0xd6e8feb86659fd93u);
  }
  template <typename T, std::enable_if_t<std::is_integral_v<T> || std::is_enum_v<T>, int> = 0>
  void add(T value) {
    add(static_cast<std::uint64_t>(value));
  }
  void add(double value) {
    std::uint64_t bits;
    const double sum = value + 0.0;  // one zero
    std::memcpy(&bits, &sum, sizeof(bits));
    add(bits);
  }
  void add(const std::string& text) { add(std::hash<std::string>()(text)); }
  void add(const Fingerprint& print) {
    add(print.high);
    add(print.low);
  }

  const Fingerprint& print() const { return print_; }

 private:
  /// The last step of splitmix64: each bit of the result depends on each of the value.
  static std::uint64_t mixed(std::uint64_t value) {
    value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
    value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
    return value ^ (value >> 31);
  }

  Fingerprint print_;
};

}  // namespace mocha::test

template <>
struct std::hash<mocha::test::Fingerprint> {
  std::size_t operator()(const mocha::test::Fingerprint& print) const { return print.low; }
};
