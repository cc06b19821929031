#include "planning/passing/place_set.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace mocha {
namespace {

TEST(PlaceSet, AnEmptyOneContainsNothing) {
  for (const int place : {0, 1, 63, 64, 100000}) EXPECT_FALSE(PlaceSet().contains(place));
}

TEST(PlaceSet, ContainsWhatWasInserted) {
  std::mt19937 random(1);
  std::set<int> expected = {0, 63, 64, 127, 128};
  PlaceSet places = {0, 63, 64, 127, 128};
  for (int i = 0; i < 300; ++i) {
    const int place = static_cast<int>(random() % 1000);
    expected.insert(place);
    places.insert(place);
  }
  for (int place = 0; place < 2000; ++place)
    EXPECT_EQ(places.contains(place), expected.count(place) > 0) << place;
}

}  // namespace
}  // namespace mocha
