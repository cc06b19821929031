#include "world/primitive_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "world/primitive.h"

namespace mocha {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Bounds on the grid's memory, whatever it is made of: some so many, and so many a primitive.
constexpr double kCells = 4096.0;
constexpr double kCellsEach = 4.0;
constexpr std::size_t kEntries = 65536;
constexpr std::size_t kEntriesEach = 32;
constexpr double kShareOfListed = 0.25;  // of the listed radius: cells finer than that do not pay

Eigen::AlignedBox2d grown(const Eigen::AlignedBox2d& box, double by_m) {
  const Eigen::Vector2d by = Eigen::Vector2d::Constant(by_m);
  return {Eigen::Vector2d(box.min() - by), Eigen::Vector2d(box.max() + by)};
}

}  // namespace

template <int D>
PrimitiveField<D>::PrimitiveField(std::vector<Primitive> primitives, double reach_m)
    : primitives_(std::move(primitives)), listed_m_(2.0 * reach_m) {
  if (!(reach_m > 0.0) || !std::isfinite(reach_m)) {
    throw std::invalid_argument("PrimitiveField: reach_m = " + std::to_string(reach_m) +
                                ": expected a finite value above 0");
  }
  Eigen::AlignedBox2d all;
  for (const Primitive& primitive : primitives_) {
    check(primitive);
    all.extend(extent(primitive));
  }
  if (primitives_.empty()) return;
  const double count = static_cast<double>(primitives_.size());
  listed_m_ = std::max(listed_m_, std::sqrt(all.volume() / count));
  all = grown(all, listed_m_);
  const double most_cells = kCells + kCellsEach * count;
  double cell_m =
      std::max({reach_m, kShareOfListed * listed_m_, std::sqrt(all.volume() / most_cells),
                all.sizes().maxCoeff() / most_cells});
  while (!fill(all, cell_m)) cell_m *= 2.0;
}

/// False if there would be too many entries; a single cell always does.
template <int D>
bool PrimitiveField<D>::fill(const Eigen::AlignedBox2d& ground, double cell_m) {
  origin_ = ground.min();
  cell_m_ = cell_m;
  cells_per_m_ = 1.0 / cell_m;
  columns_ = 1 + static_cast<int>(ground.sizes().x() / cell_m);
  rows_ = 1 + static_cast<int>(ground.sizes().y() / cell_m);
  struct Listing {
    int cell;
    Entry entry;
  };
  std::vector<Listing> listings;
  const std::size_t most =
      columns_ * rows_ == 1 ? primitives_.size() : kEntries + kEntriesEach * primitives_.size();
  for (int i = 0; i < static_cast<int>(primitives_.size()); ++i) {
    const Eigen::AlignedBox2d near = grown(extent(primitives_[i]), listed_m_);
    const Eigen::Vector2d low = (near.min() - origin_) / cell_m_;
    const Eigen::Vector2d high = (near.max() - origin_) / cell_m_;
    const int last_row = std::min(static_cast<int>(high.y()), rows_ - 1);
    const int last_column = std::min(static_cast<int>(high.x()), columns_ - 1);
    for (int row = std::max(0, static_cast<int>(low.y())); row <= last_row; ++row) {
      for (int column = std::max(0, static_cast<int>(low.x())); column <= last_column; ++column) {
        const double distance = distance_m(primitives_[i], cell_box(column, row));
        if (distance > listed_m_) continue;
        if (listings.size() == most) return false;
        listings.push_back({row * columns_ + column, {std::max(0.0, distance), i}});
      }
    }
  }
  starts_.assign(columns_ * rows_ + 1, 0);
  for (const Listing& listing : listings) ++starts_[listing.cell + 1];
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  entries_.resize(listings.size());
  std::vector<int> next(starts_.begin(), starts_.end() - 1);  // where each cell's next entry goes
  for (const Listing& listing : listings) entries_[next[listing.cell]++] = listing.entry;
  for (int cell = 0; cell < columns_ * rows_; ++cell) {
    std::sort(entries_.begin() + starts_[cell], entries_.begin() + starts_[cell + 1],
              [](const Entry& a, const Entry& b) {
                return std::tie(a.bound_m, a.primitive) < std::tie(b.bound_m, b.primitive);
              });
  }
  return true;
}

template <int D>
auto PrimitiveField<D>::cell_box(int column, int row) const -> Box {
  const Eigen::Vector2d low = origin_ + cell_m_ * Eigen::Vector2d(column, row);
  Vector min = Vector::Constant(-kInfinity);
  Vector max = Vector::Constant(kInfinity);
  min.template head<2>() = low;
  max.template head<2>() = low + Eigen::Vector2d::Constant(cell_m_);
  return {min, max};
}

template <int D>
auto PrimitiveField<D>::sample(const Vector& p) const -> Sample {
  if (!p.allFinite()) return {kNan, Vector::Constant(kNan)};
  const Primitive* nearest = nullptr;
  double nearest_m = kInfinity;
  const auto keep_nearer = [&](const Primitive& primitive) {
    const double distance = distance_m(primitive, p);
    if (!(distance < nearest_m)) return;
    nearest_m = distance;
    nearest = &primitive;
  };
  for (const Entry& entry : listed(p)) {
    if (entry.bound_m > std::max(0.0, nearest_m)) break;
    keep_nearer(primitives_[entry.primitive]);
  }
  if (nearest_m > listed_m_) {  // what is not listed may be as near
    for (const Primitive& primitive : primitives_) keep_nearer(primitive);
  }
  return nearest ? mocha::sample(*nearest, p) : Sample{kInfinity, Vector::Zero()};
}

template <int D>
void PrimitiveField<D>::visit_near(const Vector& p, double radius_m, Visitor visit) const {
  const auto visit_if_near = [&](const Primitive& primitive) {
    const Sample sample = mocha::sample(primitive, p);
    if (sample.distance_m < radius_m) visit(sample);
  };
  if (!p.allFinite()) {
    visit(sample(p));
  } else if (radius_m <= listed_m_) {
    for (const Entry& entry : listed(p)) {
      if (entry.bound_m > radius_m) return;
      visit_if_near(primitives_[entry.primitive]);
    }
  } else {
    for (const Primitive& primitive : primitives_) visit_if_near(primitive);
  }
}

template <int D>
double PrimitiveField<D>::distance_bound(const Vector& p) const {
  const double distance = sample(p).distance_m;
  return distance > 0.0 ? distance : 0.0;
}

template <int D>
double PrimitiveField<D>::room(const Vector& p, double radius_m) const {
  if (!p.allFinite()) return 0.0;
  double nearest_m = listed_m_;  // what is not listed is farther
  for (const Entry& entry : listed(p)) {
    if (entry.bound_m >= nearest_m) break;
    nearest_m = std::min(nearest_m, distance_m(primitives_[entry.primitive], p));
  }
  return std::max(0.0, nearest_m - radius_m);
}

template <int D>
bool PrimitiveField<D>::clear(const Box& box, double radius_m) const {
  const auto is_clear = [&](const Primitive& primitive) {
    const double distance = distance_m(primitive, box);
    return distance > 0.0 && distance >= radius_m;
  };
  // A primitive farther from the centre than the radius and half the diagonal is out of reach. It
  // is compared by squares, as this is asked of every piece of a trajectory at every evaluation.
  const double half_diagonal2 = 0.25 * box.diagonal().squaredNorm();
  const auto out_of_reach = [&](double from_centre_m) {
    const double gap_m = from_centre_m - radius_m;
    return gap_m > 0.0 && gap_m * gap_m > half_diagonal2;
  };
  if (out_of_reach(listed_m_)) {
    for (const Entry& entry : listed(box.center())) {
      if (out_of_reach(entry.bound_m)) return true;
      if (!is_clear(primitives_[entry.primitive])) return false;
    }
    return true;
  }
  return std::all_of(primitives_.begin(), primitives_.end(), is_clear);
}

template class PrimitiveField<2>;
template class PrimitiveField<3>;

}  // namespace mocha
