#include "world/distances/window_joining.h"

#include <algorithm>
#include <tuple>

namespace mocha {
namespace {

double size_with(const CornerWindow& window, int margin) {
  const CornerWindow grown = window.grown(margin);
  return static_cast<double>(grown.columns()) * grown.rows();
}

/// Whether a window has become part of one of the others.
bool join(std::vector<CornerWindow>& others, const CornerWindow& window, int margin) {
  for (CornerWindow& other : others) {
    const CornerWindow both = other.united(window);
    if (size_with(both, margin) > size_with(other, margin) + size_with(window, margin)) continue;
    other = both;
    return true;
  }
  return false;
}

}  // namespace

std::vector<CornerWindow> joined(std::vector<CornerWindow> windows, int margin) {
  std::sort(windows.begin(), windows.end(), [](const CornerWindow& a, const CornerWindow& b) {
    return std::tie(a.y0, a.x0, a.y1, a.x1) < std::tie(b.y0, b.x0, b.y1, b.x1);
  });
  for (bool is_done = false; !is_done;) {
    is_done = true;
    std::vector<CornerWindow> fewer;
    for (const CornerWindow& window : windows) {
      if (join(fewer, window, margin))
        is_done = false;
      else
        fewer.push_back(window);
    }
    windows.swap(fewer);
  }
  return windows;
}

}  // namespace mocha
