#include "fleet/storage/epoch_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace mocha {
namespace {

class EpochStore : public ::testing::Test {
 protected:
  EpochStore()
      : folder_(std::filesystem::temp_directory_path() /
                ("mocha_epoch_" + std::to_string(::getpid()))),
        path_((folder_ / "deeper" / "ugv1.epoch").string()) {}
  ~EpochStore() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& text) {
    std::filesystem::create_directories(folder_ / "deeper");
    std::ofstream(path_) << text;
  }

  std::string error() {
    try {
      next_epoch(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }

  std::filesystem::path folder_;
  std::string path_;
};

TEST_F(EpochStore, CountsStarts) {
  EXPECT_EQ(next_epoch(path_), 1u);
  EXPECT_EQ(next_epoch(path_), 2u);
  write("41\n");
  EXPECT_EQ(next_epoch(path_), 42u);
  std::ifstream file(path_);
  int kept = 0;
  file >> kept;
  EXPECT_EQ(kept, 42);
  EXPECT_FALSE(std::filesystem::exists(path_ + ".new"));
}

TEST_F(EpochStore, SaysWhatIsWrongAndLeavesTheFileAlone) {
  for (const char* text : {"", "seven", "-3", "12 13", "4294967295", "99999999999999999999"}) {
    write(text);
    EXPECT_NE(error().find(path_), std::string::npos) << text;
    std::ifstream file(path_);
    const std::string kept((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(kept, text);
  }
}

TEST_F(EpochStore, SaysWhenItCannotWrite) {
  std::filesystem::create_directories(folder_);
  std::ofstream((folder_ / "deeper").string()) << "a file where a folder should be";
  EXPECT_NE(error().find(path_), std::string::npos);
}

TEST_F(EpochStore, IsRaisedButNeverLowered) {
  raise_epoch(path_, 41);
  EXPECT_EQ(next_epoch(path_), 42u);
  raise_epoch(path_, 7);
  EXPECT_EQ(next_epoch(path_), 43u);
}

TEST_F(EpochStore, RefusesAFolder) {
  std::filesystem::create_directories(path_);
  EXPECT_NE(error().find(path_), std::string::npos);
}

}  // namespace
}  // namespace mocha
