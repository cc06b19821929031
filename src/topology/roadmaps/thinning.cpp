#include "topology/roadmaps/thinning.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace mocha {
namespace {

constexpr int kBuckets = 256;
constexpr int kNone = -1;
constexpr int kNotQueued = -2;
constexpr std::uint8_t kGone = 0;
constexpr std::uint8_t kThere = 1;
constexpr std::uint8_t kAnchor = 2;

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

/// The figure has a margin of places that do not belong to it.
class Thinning {
 public:
  Thinning(const RoomRaster& figure, const std::vector<int>& anchors)
      : figure_(figure),
        stride_(figure.columns + 2),
        around_{1, stride_ + 1, stride_, stride_ - 1, -1, -stride_ - 1, -stride_, -stride_ + 1},
        state_(static_cast<std::size_t>(stride_) * (figure.rows + 2), kGone),
        bucket_(state_.size()),
        next_(state_.size(), kNotQueued) {
    first_.fill(kNone);
    last_.fill(kNone);
    const float most = *std::max_element(figure.room.begin(), figure.room.end());
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
    for (const int anchor : anchors)
      state_[(anchor / figure.columns + 1) * stride_ + anchor % figure.columns + 1] = kAnchor;
  }

  std::vector<std::uint8_t> run() {
    for (std::size_t place = 0; place < state_.size(); ++place) {
      if (state_[place] == kThere && is_at_rim(static_cast<int>(place)))
        push(static_cast<int>(place));
    }
    for (int place = pop(); place != kNone; place = pop()) {
      if (!is_simple(place)) continue;
      state_[place] = kGone;
      for (const int step : around_) push(place + step);
    }
    std::vector<std::uint8_t> remains(figure_.room.size());
    for (int y = 0; y < figure_.rows; ++y) {
      for (int x = 0; x < figure_.columns; ++x)
        remains[y * figure_.columns + x] = state_[(y + 1) * stride_ + x + 1] != kGone;
    }
    return remains;
  }

 private:
  bool is_at_rim(int place) const {
    return state_[place + 1] == kGone || state_[place - 1] == kGone ||
           state_[place + stride_] == kGone || state_[place - stride_] == kGone;
  }

  bool is_simple(int place) const {
    static constexpr std::array<bool, 256> kSimple = simple_places();
    int around = 0;
    for (int k = 0; k < 8; ++k) around |= (state_[place + around_[k]] != kGone) << k;
    return kSimple[around];
  }

  void push(int place) {
    if (state_[place] != kThere || next_[place] != kNotQueued) return;
    const int bucket = bucket_[place];
    (first_[bucket] == kNone ? first_[bucket] : next_[last_[bucket]]) = place;
    last_[bucket] = place;
    next_[place] = kNone;
    lowest_ = std::min(lowest_, bucket);
  }

  /// First come, first served among those of equal room; kNone at the end.
  int pop() {
    while (lowest_ < kBuckets && first_[lowest_] == kNone) ++lowest_;
    if (lowest_ == kBuckets) return kNone;
    const int place = first_[lowest_];
    first_[lowest_] = std::exchange(next_[place], kNotQueued);
    return place;
  }

  const RoomRaster& figure_;
  const int stride_;
  const std::array<int, 8> around_;
  std::vector<std::uint8_t> state_;
  std::vector<std::uint8_t> bucket_;
  // The queue: places of equal room in a row.
  std::array<int, kBuckets> first_;
  std::array<int, kBuckets> last_;
  std::vector<int> next_;
  int lowest_ = kBuckets;
};

}  // namespace

std::vector<std::uint8_t> thinned(const RoomRaster& figure, const std::vector<int>& anchors) {
  if (figure.room.empty()) return {};
  return Thinning(figure, anchors).run();
}

}  // namespace mocha
