#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace mocha {

/// Values of the cells of a plane, in blocks: memory is taken where something was set, and growing
/// moves no values.
template <class T>
class CellBlocks {
 public:
  static constexpr int kSide = 128;  ///< cells along a side of a block

  /// `fill`: of cells that were not set.
  explicit CellBlocks(T fill) : fill_(fill) {}

  bool empty() const { return blocks_.empty(); }

  T at(int x, int y) const {
    const Block* block = find(block_of(x), block_of(y));
    return block == nullptr ? fill_ : (*block)[inside(x, y)];
  }

  T& ref(int x, int y) {
    const int bx = block_of(x);
    const int by = block_of(y);
    if (!holds(bx, by)) grow_to(bx, by);
    std::unique_ptr<Block>& block = blocks_[index(bx, by)];
    if (!block) {
      block = std::make_unique<Block>();
      block->fill(fill_);
    }
    return (*block)[inside(x, y)];
  }

  /// Of `count` cells along x, the first of them at (x, y).
  void copy_row(int x, int y, int count, T* to) const {
    while (count > 0) {
      const int here = std::min(count, kSide - inside(x));
      const Block* block = find(block_of(x), block_of(y));
      if (block == nullptr)
        std::fill_n(to, here, fill_);
      else
        std::copy_n(block->begin() + inside(x, y), here, to);
      x += here;
      to += here;
      count -= here;
    }
  }

  /// Calls visit(x, y, value) for the cells of all blocks, set or not.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      if (!blocks_[b]) continue;
      const int x0 = (x0_ + static_cast<int>(b % columns_)) * kSide;
      const int y0 = (y0_ + static_cast<int>(b / columns_)) * kSide;
      for (int i = 0; i < kSide * kSide; ++i)
        visit(x0 + i % kSide, y0 + i / kSide, (*blocks_[b])[i]);
    }
  }

 private:
  using Block = std::array<T, kSide * kSide>;

  static int block_of(int i) { return (i >= 0 ? i : i - kSide + 1) / kSide; }
  static int inside(int i) { return i - block_of(i) * kSide; }
  static int inside(int x, int y) { return inside(y) * kSide + inside(x); }

  bool holds(int bx, int by) const {
    return bx >= x0_ && by >= y0_ && bx < x0_ + columns_ && by < y0_ + rows_;
  }
  std::size_t index(int bx, int by) const {
    return static_cast<std::size_t>(by - y0_) * columns_ + (bx - x0_);
  }
  const Block* find(int bx, int by) const {
    return holds(bx, by) ? blocks_[index(bx, by)].get() : nullptr;
  }

  void grow_to(int bx, int by) {
    CellBlocks grown(fill_);
    grown.x0_ = empty() ? bx : std::min(x0_, bx);
    grown.y0_ = empty() ? by : std::min(y0_, by);
    grown.columns_ = (empty() ? bx + 1 : std::max(x0_ + columns_, bx + 1)) - grown.x0_;
    grown.rows_ = (empty() ? by + 1 : std::max(y0_ + rows_, by + 1)) - grown.y0_;
    grown.blocks_.resize(static_cast<std::size_t>(grown.columns_) * grown.rows_);
    for (int y = y0_; y < y0_ + rows_; ++y) {
      for (int x = x0_; x < x0_ + columns_; ++x)
        grown.blocks_[grown.index(x, y)] = std::move(blocks_[index(x, y)]);
    }
    *this = std::move(grown);
  }

  T fill_;
  int x0_ = 0;  // of the blocks
  int y0_ = 0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::unique_ptr<Block>> blocks_;  // row by row; none where nothing was set
};

}  // namespace mocha
