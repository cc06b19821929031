#include "fleet/storage/stop_store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace mocha {
namespace {

class StopStore : public ::testing::Test {
 protected:
  StopStore()
      : folder_(std::filesystem::temp_directory_path() /
                ("mocha_stops_" + std::to_string(::getpid()))),
        path_((folder_ / "deeper" / "ugv1.stops").string()) {}
  ~StopStore() override { std::filesystem::remove_all(folder_); }

  static StopRecord record() {
    StopRecord record;
    record.robot = true;
    record.since_s = 1.7e9 + 0.25;
    record.reason = "told by /joystick";
    record.resets = 12;
    record.fleet["ugv1"] = {"ugv1", 3, 2, 1.7e9, "called by /rviz"};
    record.fleet["ugv2"] = {"ugv2", 1, 1, 0.5, ""};
    return record;
  }

  std::string text() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write(const std::string& text) const { std::ofstream(path_) << text; }

  const std::filesystem::path folder_;
  const std::string path_;
};

TEST_F(StopStore, WithoutAFileNothingIsStopped) {
  const StopRecord none = load_stops(path_);
  EXPECT_FALSE(none.robot);
  EXPECT_TRUE(none.fleet.empty());
}

TEST_F(StopStore, GivesBackWhatWasKept) {
  save_stops(path_, StopRecord());
  EXPECT_FALSE(load_stops(path_).robot);
  save_stops(path_, record());
  const StopRecord kept = load_stops(path_);
  EXPECT_TRUE(kept.robot);
  EXPECT_DOUBLE_EQ(kept.since_s, 1.7e9 + 0.25);
  EXPECT_EQ(kept.reason, "told by /joystick");
  EXPECT_EQ(kept.resets, 12U);
  ASSERT_EQ(kept.fleet.size(), 2U);
  EXPECT_EQ(kept.fleet.at("ugv1").ordered, 3U);
  EXPECT_EQ(kept.fleet.at("ugv1").released, 2U);
  EXPECT_EQ(kept.fleet.at("ugv1").reason, "called by /rviz");
  EXPECT_EQ(kept.fleet.at("ugv2").since_s, 0.5);
  EXPECT_EQ(kept.fleet.at("ugv2").reason, "");
  EXPECT_FALSE(std::filesystem::exists(path_ + ".new"));
}

TEST_F(StopStore, WhatCannotBeReadCountsAsStopped) {
  save_stops(path_, StopRecord());
  const std::string free = text();
  save_stops(path_, record());
  const std::string sound = text();
  for (std::size_t cut = 0; cut < free.size() - 1; ++cut) {
    write(free.substr(0, cut));
    EXPECT_TRUE(load_stops(path_).robot) << "after " << cut << " characters";
  }
  for (const std::string damage : {"", "\n", "emergency stops 2\nend\n", "\xff\xfe\x00"}) {
    write(damage);
    EXPECT_TRUE(load_stops(path_).robot) << damage;
  }
  for (const auto& [from, to] :
       {std::pair("ugv1 3 2", "ugv1 3 x"), std::pair("ugv1 3 2", "ugv1 3 4"),
        std::pair("resets 12", "resets -"), std::pair("robot 1", "robot 7"),
        std::pair("fleet", "fl\x01t")}) {
    std::string damaged = sound;
    damaged.replace(damaged.find(from), std::string(from).size(), to);
    write(damaged);
    const StopRecord stopped = load_stops(path_);
    EXPECT_TRUE(stopped.robot);
    EXPECT_NE(stopped.reason.find(path_), std::string::npos) << to;
    EXPECT_EQ(stopped.reason, plain_reason(stopped.reason, 300));
  }
}

TEST_F(StopStore, AFolderInItsPlaceCountsAsStopped) {
  std::filesystem::create_directories(path_);
  EXPECT_TRUE(load_stops(path_).robot);
  EXPECT_THROW(save_stops(path_, record()), std::runtime_error);
}

TEST_F(StopStore, SaysWhenItCannotWrite) {
  std::filesystem::create_directories(folder_);
  std::ofstream((folder_ / "deeper").string()) << "a file where a folder should be";
  try {
    save_stops(path_, record());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path_), std::string::npos);
  }
}

}  // namespace
}  // namespace mocha
