#include "topology/roadmaps/thinning.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mocha {
namespace {

constexpr int kNoPixel = -1;
constexpr std::uint8_t kGone = 0;
constexpr std::uint8_t kThere = 1;
constexpr std::uint8_t kAnchor = 2;
constexpr std::uint8_t kQueued = 3;

/// Whether a place may go without a change to pieces and holes, by which of its eight neighbours
/// are there; bits counter-clockwise from +x. Its 8-connectivity number (Yokoi) is 1.
constexpr std::array<bool, 256> simple_places() {
  std::array<bool, 256> simple{};
  for (int around = 0; around < 256; ++around) {
    int number = 0;
    for (int k = 0; k < 8; k += 2) {
      const bool gone = (around >> k & 1) == 0;
      const bool both_gone = (around >> (k + 1) % 8 & 1) == 0 && (around >> (k + 2) % 8 & 1) == 0;
      number += gone && !both_gone;
    }
    simple[around] = number == 1;
  }
  return simple;
}

constexpr std::array<bool, 256> kSimple = simple_places();

/// A place's bit among the neighbours of its own neighbour `k`.
constexpr std::uint8_t opposite(int k) { return static_cast<std::uint8_t>(1 << (k + 4) % 8); }

}  // namespace

void Thinning::start(const RoomRaster& figure, const std::vector<int>& anchors) {
  stride_ = figure.columns + 2;
  around_ = {1, stride_ + 1, stride_, stride_ - 1, -1, -stride_ - 1, -stride_, -stride_ + 1};
  const std::size_t places = static_cast<std::size_t>(stride_) * (figure.rows + 2);
  state_.assign(places, kGone);
  around_it_.resize(places);
  bucket_.resize(places);
  next_.resize(places);
  first_.fill(kNoPixel);
  float most = 0.0f;
  for (const float room : figure.room) most = std::max(most, room);
  const float scale = most > 0.0f ? (kBuckets - 1) / most : 0.0f;
  for (int y = 0; y < figure.rows; ++y) {
    for (int x = 0; x < figure.columns; ++x) {
      const float room = figure.room[y * figure.columns + x];
      if (room < 0.0f) continue;
      const int place = (y + 1) * stride_ + x + 1;
      state_[place] = kThere;
      bucket_[place] = static_cast<std::uint8_t>(scale * room);
    }
  }
  for (std::size_t place = stride_ + 1; place + stride_ + 1 < places; ++place) {
    int there = 0;
    for (int k = 0; k < 8; ++k) there |= state_[place + around_[k]] << k;
    around_it_[place] = static_cast<std::uint8_t>(there);
  }
  for (const int anchor : anchors)
    state_[(anchor / figure.columns + 1) * stride_ + anchor % figure.columns + 1] = kAnchor;
}

std::vector<std::uint8_t> Thinning::run(const RoomRaster& figure, const std::vector<int>& anchors) {
  if (figure.room.empty()) return {};
  start(figure, anchors);
  for (int place = 0; place < static_cast<int>(state_.size()); ++place) push(place);
  for (int place = pop(); place != kNoPixel; place = pop()) {
    if (!kSimple[around_it_[place]]) continue;
    state_[place] = kGone;
    for (int k = 0; k < 8; ++k) {
      around_it_[place + around_[k]] &= ~opposite(k);
      push(place + around_[k]);
    }
  }
  std::vector<std::uint8_t> remains(figure.room.size());
  for (int y = 0; y < figure.rows; ++y) {
    for (int x = 0; x < figure.columns; ++x)
      remains[y * figure.columns + x] = state_[(y + 1) * stride_ + x + 1] != kGone;
  }
  return remains;
}

void Thinning::push(int place) {
  if (state_[place] != kThere || !kSimple[around_it_[place]]) return;
  state_[place] = kQueued;
  const int bucket = bucket_[place];
  (first_[bucket] == kNoPixel ? first_[bucket] : next_[last_[bucket]]) = place;
  last_[bucket] = place;
  next_[place] = kNoPixel;
  lowest_ = std::min(lowest_, bucket);
}

int Thinning::pop() {
  while (lowest_ < kBuckets && first_[lowest_] == kNoPixel) ++lowest_;
  if (lowest_ == kBuckets) return kNoPixel;
  const int place = first_[lowest_];
  first_[lowest_] = next_[place];
  state_[place] = kThere;
  return place;
}

}  // namespace mocha
