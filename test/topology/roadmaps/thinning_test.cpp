#include "topology/roadmaps/thinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace mocha {
namespace {

RoomRaster raster(int columns, int rows) {
  return {columns, rows, std::vector<float>(columns * rows, -1.0f)};
}

std::vector<std::uint8_t> places_of(const RoomRaster& figure) {
  std::vector<std::uint8_t> there;
  for (const float room : figure.room) there.push_back(room >= 0.0f);
  return there;
}

/// How many pieces the places of one value have: of eight neighbours, or of four with a frame
/// around.
int pieces(std::vector<std::uint8_t> places, int columns, std::uint8_t value, bool eight) {
  const int rows = static_cast<int>(places.size()) / columns;
  int count = 0;
  std::vector<int> front;
  for (std::size_t first = 0; first < places.size(); ++first) {
    if (places[first] != value) continue;
    ++count;
    front.assign(1, static_cast<int>(first));
    places[first] = 2;
    while (!front.empty()) {
      const int x = front.back() % columns;
      const int y = front.back() / columns;
      front.pop_back();
      for (int ny = std::max(0, y - 1); ny <= std::min(rows - 1, y + 1); ++ny) {
        for (int nx = std::max(0, x - 1); nx <= std::min(columns - 1, x + 1); ++nx) {
          if ((!eight && nx != x && ny != y) || places[ny * columns + nx] != value) continue;
          places[ny * columns + nx] = 2;
          front.push_back(ny * columns + nx);
        }
      }
    }
  }
  return count;
}

int count(const std::vector<std::uint8_t>& places) {
  return std::accumulate(places.begin(), places.end(), 0);
}

TEST(Thinning, ADiscBecomesAPointAndARingALoop) {
  RoomRaster disc = raster(21, 21);
  RoomRaster ring = raster(21, 21);
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 21; ++x) {
      const float away = std::hypot(x - 10.0f, y - 10.0f);
      if (away < 9.0f) disc.room[y * 21 + x] = 9.0f - away;
      if (away > 4.0f && away < 9.0f) ring.room[y * 21 + x] = 2.5f - std::abs(away - 6.5f);
    }
  }
  EXPECT_EQ(count(Thinning().run(disc, {})), 1);
  EXPECT_EQ(Thinning().run(disc, {})[10 * 21 + 10], 1);  // where there is most room
  const auto loop = Thinning().run(ring, {});
  for (int y = 0; y < 21; ++y) {
    for (int x = 0; x < 21; ++x) {
      if (!loop[y * 21 + x]) continue;
      EXPECT_NEAR(std::hypot(x - 10.0, y - 10.0), 6.5, 1.0);
      int neighbours = -1;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) neighbours += loop[(y + dy) * 21 + x + dx];
      }
      EXPECT_EQ(neighbours, 2) << x << ", " << y;
    }
  }
}

TEST(Thinning, BetweenAnchorsALineInTheMiddleRemains) {
  RoomRaster hall = raster(30, 9);
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 30; ++x) hall.room[y * 30 + x] = static_cast<float>(std::min(y, 8 - y));
  }
  const auto line = Thinning().run(hall, {4 * 30, 4 * 30 + 29});
  EXPECT_EQ(count(line), 30);
  for (int x = 0; x < 30; ++x) EXPECT_EQ(line[4 * 30 + x], 1);
}

TEST(Thinning, KeepsPiecesHolesAndAnchorsAndNothingMore) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    RoomRaster figure = raster(24, 18);
    for (float& room : figure.room) {
      if (random() % 100 < 70) room = static_cast<float>(random() % 1000) * 0.01f;
    }
    const auto before = places_of(figure);
    std::vector<int> anchors;
    for (int place = 0; place < 24 * 18 && anchors.size() < 5; place += 79) {
      if (before[place]) anchors.push_back(place);
    }
    const auto after = Thinning().run(figure, anchors);
    for (std::size_t i = 0; i < after.size(); ++i) ASSERT_LE(after[i], before[i]);
    for (const int anchor : anchors) EXPECT_EQ(after[anchor], 1);
    EXPECT_EQ(pieces(after, 24, 1, true), pieces(before, 24, 1, true)) << trial;
    // With the outside, so that what opens to it is no hole.
    const auto framed = [](const std::vector<std::uint8_t>& places) {
      std::vector<std::uint8_t> wider(26 * 20, 0);
      for (int i = 0; i < 24 * 18; ++i) wider[(i / 24 + 1) * 26 + i % 24 + 1] = places[i];
      return wider;
    };
    EXPECT_EQ(pieces(framed(after), 26, 0, false), pieces(framed(before), 26, 0, false)) << trial;
    const auto again = Thinning().run({24, 18,
                                       [&] {
                                         std::vector<float> room = figure.room;
                                         for (std::size_t i = 0; i < room.size(); ++i) {
                                           if (!after[i]) room[i] = -1.0f;
                                         }
                                         return room;
                                       }()},
                                      anchors);
    EXPECT_EQ(again, after) << trial;
  }
}

TEST(Thinning, IsInUsedMemoryAsInFreshMemory) {
  std::mt19937 random(2);
  Thinning used;
  for (int trial = 0; trial < 200; ++trial) {
    RoomRaster figure =
        raster(1 + static_cast<int>(random() % 30), 1 + static_cast<int>(random() % 30));
    for (float& room : figure.room) {
      if (random() % 100 < 80) room = static_cast<float>(random() % 1000) * 0.01f;
    }
    std::vector<int> anchors;
    if (figure.room.back() >= 0.0f) anchors.push_back(static_cast<int>(figure.room.size()) - 1);
    ASSERT_EQ(used.run(figure, anchors), Thinning().run(figure, anchors))
        << figure.columns << " x " << figure.rows;
  }
}

TEST(Thinning, OfNothingIsNothing) {
  EXPECT_TRUE(Thinning().run({0, 0, {}}, {}).empty());
  EXPECT_EQ(count(Thinning().run(raster(5, 5), {})), 0);
}

}  // namespace
}  // namespace mocha
