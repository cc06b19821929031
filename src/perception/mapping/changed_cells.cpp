#include "perception/mapping/changed_cells.h"

#include <utility>

#include "world/distances/window_joining.h"

namespace mocha {
namespace {

constexpr int kTileBits = 5;  // 32 cells along a side of a tile
constexpr int kMargin = 50;   // cells around a rectangle that would cost as much as its message
constexpr std::size_t kMostTiles = 1500;

}  // namespace

void ChangedCells::add(int x, int y) {
  const auto part = [](int i) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i >> kTileBits));
  };
  const std::uint64_t key = part(y) << 32 | part(x);
  if (last_ == nullptr || key != last_key_) {
    last_key_ = key;
    last_ = &tiles_.emplace(key, CornerWindow{x, y, x, y}).first->second;
  }
  *last_ = last_->united({x, y, x, y});
}

std::vector<CornerWindow> ChangedCells::take() {
  std::vector<CornerWindow> windows;
  windows.reserve(tiles_.size());
  for (const auto& [key, window] : tiles_) windows.push_back(window);
  tiles_.clear();
  last_ = nullptr;
  if (windows.size() > kMostTiles) {
    CornerWindow all = windows.front();
    for (const CornerWindow& window : windows) all = all.united(window);
    return {all};
  }
  return joined(std::move(windows), kMargin);
}

}  // namespace mocha
