#include "fleet/wire/fleet_key.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace mocha {
namespace {

const std::string kDigits = "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f";
const std::uint8_t kText[] = {'m', 'o', 'c', 'h', 'a'};

class FleetKeyFile : public ::testing::Test {
 protected:
  FleetKeyFile() : path_(std::filesystem::temp_directory_path() / "mocha_fleet_key_test") {}
  ~FleetKeyFile() override { std::filesystem::remove(path_); }

  void write(const std::string& text, mode_t mode = 0600) const {
    std::ofstream(path_) << text;
    ASSERT_EQ(::chmod(path_.c_str(), mode), 0);
  }
  std::string trouble() const {
    try {
      FleetKey::load(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  const std::string path_;
};

TEST_F(FleetKeyFile, IsReadWithAndWithoutEndOfLine) {
  FleetKey::Secret secret;
  for (std::size_t i = 0; i < secret.size(); ++i) secret[i] = static_cast<std::uint8_t>(i);
  for (const std::string end : {"", "\n"}) {
    write(kDigits + end);
    EXPECT_EQ(FleetKey::load(path_).seal(kText, 5), FleetKey(secret).seal(kText, 5));
  }
}

TEST_F(FleetKeyFile, OthersMayNotRead) {
  for (const mode_t mode : {0640, 0604, 0620, 0666}) {
    write(kDigits, mode);
    EXPECT_NE(trouble().find("chmod 600"), std::string::npos) << mode;
  }
  write(kDigits, 0400);
  EXPECT_EQ(trouble(), "");
}

TEST_F(FleetKeyFile, WhatHoldsNoKeyIsNamed) {
  EXPECT_NE(trouble().find(path_), std::string::npos);  // there is none
  for (const std::string& text : {std::string(), kDigits.substr(1), kDigits + "00",
                                  kDigits + "\n" + kDigits, "zz" + kDigits.substr(2)}) {
    write(text);
    EXPECT_NE(trouble().find("scripts/fleet_key"), std::string::npos) << text;
  }
}

/// Computed by Python: hashlib.blake2b(b"mocha", key=bytes(range(32)), digest_size=16).
TEST(FleetKey, SealsAsBlake2b) {
  FleetKey::Secret secret;
  for (std::size_t i = 0; i < secret.size(); ++i) secret[i] = static_cast<std::uint8_t>(i);
  const FleetKey::Seal expected = {0xdb, 0x47, 0x4b, 0x2d, 0x35, 0x00, 0x3d, 0xb8,
                                   0x69, 0xe4, 0xa7, 0x1b, 0xa2, 0xd7, 0xe6, 0x2a};
  EXPECT_EQ(FleetKey(secret).seal(kText, 5), expected);
  EXPECT_TRUE(FleetKey(secret).sealed(expected, kText, 5));
  EXPECT_FALSE(FleetKey(secret).sealed(expected, kText, 4));
  secret[31] ^= 1;
  EXPECT_FALSE(FleetKey(secret).sealed(expected, kText, 5));
}

}  // namespace
}  // namespace mocha
