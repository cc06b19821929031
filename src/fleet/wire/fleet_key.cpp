#include "fleet/wire/fleet_key.h"

#include <sodium.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace mocha {
namespace {

static_assert(FleetKey::kSealBytes == crypto_verify_16_BYTES);
static_assert(FleetKey::kSealBytes >= crypto_generichash_BYTES_MIN);
static_assert(FleetKey::kSecretBytes == crypto_generichash_KEYBYTES);

[[noreturn]] void fail(const std::string& path, const std::string& trouble) {
  throw std::runtime_error(
      "fleet key " + path + ": " + trouble +
      ". It holds the fleet's secret, 64 hexadecimal digits, the same on every "
      "robot; scripts/fleet_key makes one");
}

}  // namespace

FleetKey::FleetKey(const Secret& secret) : secret_(secret) {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot be initialised");
}

FleetKey FleetKey::load(const std::string& path) {
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0)
    fail(path, std::string("cannot be read (") + std::strerror(errno) + ")");
  if (!S_ISREG(about.st_mode)) fail(path, "is no file");
  if ((about.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    fail(path, "others than its owner may read or write it; chmod 600 it");
  std::ifstream file(path);
  std::string digits;
  std::string rest;
  if (!(file >> digits)) fail(path, "cannot be read, or is empty");
  if (digits.size() != 2 * kSecretBytes || file >> rest)
    fail(path, "does not hold 64 digits and nothing else");
  Secret secret;
  std::size_t read = 0;
  const char* end = nullptr;
  const int trouble = sodium_hex2bin(secret.data(), secret.size(), digits.data(), digits.size(),
                                     nullptr, &read, &end);
  if (trouble != 0 || read != kSecretBytes)
    fail(path, "holds something else than hexadecimal digits");
  return FleetKey(secret);
}

FleetKey::Seal FleetKey::seal(const std::uint8_t* data, std::size_t size) const {
  Seal seal;
  crypto_generichash(seal.data(), seal.size(), data, size, secret_.data(), secret_.size());
  return seal;
}

bool FleetKey::sealed(const Seal& seal, const std::uint8_t* data, std::size_t size) const {
  return crypto_verify_16(seal.data(), this->seal(data, size).data()) == 0;
}

}  // namespace mocha
