#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace mocha {

/// The secret that the robots of a fleet share, and by which they know each other's datagrams.
class FleetKey {
 public:
  static constexpr std::size_t kSecretBytes = 32;
  static constexpr std::size_t kSealBytes = 16;
  using Secret = std::array<std::uint8_t, kSecretBytes>;
  using Seal = std::array<std::uint8_t, kSealBytes>;

  explicit FleetKey(const Secret& secret);

  /// From a file of 64 hexadecimal digits that its owner alone can read or write. Throws
  /// std::runtime_error, naming the file, the trouble and the remedy, for any other.
  static FleetKey load(const std::string& path);

  /// The keyed hash (BLAKE2b) of these bytes.
  Seal seal(const std::uint8_t* data, std::size_t size) const;
  /// Whether this is the seal of these bytes by this key; takes equally long, whatever is wrong.
  bool sealed(const Seal& seal, const std::uint8_t* data, std::size_t size) const;

 private:
  Secret secret_;
};

}  // namespace mocha
