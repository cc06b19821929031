#include "world/distances/distance_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "world/distances/distance_transform.h"

namespace mocha {
namespace {

constexpr int kTile = 64;  // corners along the sides of what is told to be touched
constexpr float kNone = std::numeric_limits<float>::infinity();

/// How much a squared distance may have lost as a float of metres [steps^2].
double rounding(double squared) { return 0.25 + 1e-6 * squared; }

double square(double value) { return value * value; }

}  // namespace

DistanceRepair::DistanceRepair(std::vector<float>& signed_m, int columns, int rows, float step_m,
                               int side, std::int64_t most_work)
    : signed_m_(signed_m),
      columns_(columns),
      all_{0, 0, columns - 1, rows - 1},
      step_m_(step_m),
      side_(static_cast<float>(side)),
      work_left_(most_work),
      touched_of_tile_(static_cast<std::size_t>(columns / kTile + 1) * (rows / kTile + 1), -1) {}

bool DistanceRepair::remove(const std::vector<Eigen::Vector2i>& sites) {
  affected_.clear();
  for (const Eigen::Vector2i& site : sites) {
    if (!lose(site)) return false;
  }
  for (const Affected& affected : affected_) {
    const auto squared = static_cast<float>(nearest(affected));
    at(affected.corner.x(), affected.corner.y()) = side_ * step_m_ * std::sqrt(squared);
    if (used_up()) return false;
  }
  return true;
}

bool DistanceRepair::add(const std::vector<Eigen::Vector2i>& sites) {
  const auto come_closer = [this](int x, int y, double squared) {
    const float away_m = step_m_ * std::sqrt(static_cast<float>(squared));
    if (away_m >= distance_m(x, y)) return;
    at(x, y) = side_ * away_m;
    touch(x, y);
  };
  return std::all_of(sites.begin(), sites.end(),
                     [&](const Eigen::Vector2i& site) { return visit_cell(site, come_closer); });
}

/// Calls visit(x, y, squared distance to the site [steps^2]) for all corners of its Voronoi cell,
/// by rings of squares around the site, and for some beside it. The cell is convex: where a corner
/// of a ring is in it, so is all of the line from there to the site. On each ring before, a corner
/// is at most half a step off that line, thus nearer to another site by one at most, and such
/// corners of two rings are at most one apart along the ring. Corners of the squares are visited
/// twice. False where the work is used up.
template <typename Visit>
bool DistanceRepair::visit_cell(const Eigen::Vector2i& site, const Visit& visit) {
  constexpr double kSlack = 1.0 + 1e-3;
  struct Range {
    int low, high;
    bool empty() const { return high < low; }
  };
  visit(site.x(), site.y(), 0.0);
  std::array<Range, 4> sides{};  // of a ring: what of each is visited, from its middle
  const auto is_over = [](const Range& side) { return side.empty(); };
  for (int ring = 1; !std::all_of(sides.begin(), sides.end(), is_over); ++ring) {
    const double growth = ring / (ring - 1.0);
    for (int i = 0; i < 4; ++i) {
      if (sides[i].empty()) continue;
      const double low = std::max(-1.0 * ring, std::ceil((sides[i].low - 1) * growth));
      const double high = std::min(1.0 * ring, std::floor((sides[i].high + 1) * growth));
      sides[i] = {ring, -ring};
      for (int along = static_cast<int>(low); along <= high; ++along) {
        const int across = i % 2 == 0 ? ring : -ring;
        const int x = site.x() + (i < 2 ? across : along);
        const int y = site.y() + (i < 2 ? along : across);
        if (!all_.holds(x, y)) continue;
        if (--work_left_ < 0) return false;
        const double squared = square(ring) + square(along);
        if (square(distance_m(x, y) / step_m_ + kSlack) < squared) continue;
        sides[i] = {std::min(sides[i].low, along), along};
        visit(x, y, squared);
      }
    }
  }
  return true;
}

/// Forgets the distances of all corners that a site may have been nearest to.
bool DistanceRepair::lose(const Eigen::Vector2i& site) {
  at(site.x(), site.y()) = 0.0f;
  return visit_cell(site, [&](int x, int y, double squared) {
    const double before = square(distance_m(x, y) / step_m_);
    if (std::abs(before - squared) > rounding(squared)) return;
    affected_.push_back({{x, y}, site, before});
    at(x, y) = side_ * kNone;
    touch(x, y);
  });
}

/// At least the squared distance of a corner to the nearest site: by what its neighbours know, and
/// by the sites beside the lost one, which often are as near as any.
double DistanceRepair::bound(const Affected& affected) const {
  double least = kNoSite;
  const auto [corner, lost, squared] = affected;
  for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
    const int x = corner.x() + dx;
    const int y = corner.y() + dy;
    if (!all_.holds(x, y)) continue;
    const double steps = distance_m(x, y) / step_m_ + 1.0;
    least = std::min(least, square(steps) + 2.0 * rounding(square(steps)));
  }
  for (int y = lost.y() - 1; y <= lost.y() + 1; ++y) {
    for (int x = lost.x() - 1; x <= lost.x() + 1; ++x) {
      if (is_site(x, y)) least = std::min(least, square(x - corner.x()) + square(y - corner.y()));
    }
  }
  return least;
}

/// The squared distance of a corner to the nearest site [steps^2], or kNoSite.
double DistanceRepair::nearest(const Affected& affected) {
  const int x = affected.corner.x();
  const int y = affected.corner.y();
  const auto least =
      static_cast<std::int64_t>(std::ceil(affected.squared - rounding(affected.squared)));
  auto best = static_cast<std::int64_t>(bound(affected)) + 1;
  const int most_rows = std::max(y, all_.y1 - y);
  const int most_columns = std::max(x, all_.x1 - x);
  std::int64_t first = 1 + static_cast<std::int64_t>(std::sqrt(static_cast<double>(least)));
  for (std::int64_t dy = 0; dy <= most_rows && dy * dy < best; ++dy) {
    if (--work_left_ < 0) break;
    while (first > 0 && (first - 1) * (first - 1) >= least - dy * dy) --first;
    for (std::int64_t dx = first; dx <= most_columns && dx * dx < best - dy * dy; ++dx) {
      if (--work_left_ < 0) break;
      const auto [left, right] = std::pair<int, int>(x - dx, x + dx);
      const auto [below, above] = std::pair<int, int>(y - dy, y + dy);
      if (is_site(left, below) || is_site(right, below) || is_site(left, above) ||
          is_site(right, above))
        best = dx * dx + dy * dy;
    }
  }
  return static_cast<double>(best);
}

/// Makes the window of a corner's tile hold it.
void DistanceRepair::touch(int x, int y) {
  int& window =
      touched_of_tile_[static_cast<std::size_t>(y / kTile) * (columns_ / kTile + 1) + x / kTile];
  if (window < 0) {
    window = static_cast<int>(touched_.size());
    touched_.push_back({x, y, x, y});
  }
  touched_[window] = touched_[window].united({x, y, x, y});
}

}  // namespace mocha
