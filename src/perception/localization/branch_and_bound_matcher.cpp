#include "perception/localization/branch_and_bound_matcher.h"

#include <algorithm>
#include <cmath>

namespace mocha {
namespace {

constexpr int kTop = 3;       // the search begins with squares of 2^3 cells
constexpr int kAbreast = 16;  // so many of their bounds cost as much as another one
constexpr double kFull = 255.0;
constexpr double kFarthest = 1e9;    // [cells]
constexpr double kSpacing_m = 0.05;  // of the places looked at; not below the map's cells
constexpr double kYawStep_rad = 0.026;
constexpr double kRivalry = 0.15;  // places so much worse than the best are found as well
constexpr double kApart_m = 0.5;   // of places so near to each other, and so alike, the best
constexpr double kApart_rad = 0.35;
constexpr std::size_t kMostPlaces = 16;

/// Values at the centres of the search's cells.
template <class Value>
GridPyramid pyramid(const OccupancyGrid& map, double spacing_m, Value value) {
  const int width = static_cast<int>(std::ceil(map.width * map.resolution_m / spacing_m));
  const int height = static_cast<int>(std::ceil(map.height * map.resolution_m / spacing_m));
  std::vector<std::uint8_t> values;
  values.reserve(static_cast<std::size_t>(width) * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      values.push_back(value(map.origin + spacing_m * Vector2(x + 0.5, y + 0.5)));
    }
  }
  return {std::move(values), width, height, kTop};
}

GridPyramid likelihood_of(const LikelihoodField& walls, double spacing_m) {
  return pyramid(walls.map(), spacing_m, [&](const Vector2& at) {
    const double ratio = walls.sample(at).distance_m / BranchAndBoundMatcher::kReach_m;
    return static_cast<std::uint8_t>(std::lround(kFull * std::exp(-0.5 * ratio * ratio)));
  });
}

GridPyramid free_places(const LikelihoodField& walls, double spacing_m) {
  return pyramid(walls.map(), spacing_m, [&](const Vector2& at) -> std::uint8_t {
    return walls.cell(at) == OccupancyGrid::kFree ? 255 : 0;
  });
}

using Cell = SquareSums::Cell;

/// Squares of places with one heading that share a bound on their scores.
struct Square {
  Cell corner;
  int level;
  int heading;
  double bound;
};

bool is_worse(const Square& a, const Square& b) { return a.bound < b.bound; }

/// One run of the search: always the most promising square first.
class Run {
 public:
  Run(const BranchAndBoundMatcher::Options& options, double spacing_m, const Vector2& origin,
      const GridPyramid& likelihood, const SquareSums& top, const GridPyramid& free_cells,
      const SearchWindow& window)
      : options_(options),
        spacing_m_(spacing_m),
        origin_(origin),
        likelihood_(likelihood),
        top_(top),
        free_(free_cells),
        window_(window) {}

  BranchAndBoundMatcher::Result find(const ScanHits& scan) {
    turn(scan);
    full_ = kFull * static_cast<double>(scan.hits.size());
    begin();
    while (!squares_.empty() && squares_.front().bound >= least() && !is_given_up()) {
      std::pop_heap(squares_.begin(), squares_.end(), is_worse);
      const Square square = squares_.back();
      squares_.pop_back();
      if (square.level == 0) {
        add(square);
      } else if (!is_settled(square)) {
        divide(square);
      }
    }
    const auto worse = [this](const BranchAndBoundMatcher::Place& p) { return p.score < least(); };
    places_.erase(std::remove_if(places_.begin(), places_.end(), worse), places_.end());
    std::sort(places_.begin(), places_.end(),
              [](const auto& a, const auto& b) { return a.score > b.score; });
    if (places_.size() > kMostPlaces) places_.resize(kMostPlaces);
    return {places_, !is_given_up(), looked_at_};
  }

 private:
  /// The hits in cells from a robot in the corner of a cell, for every heading of the window.
  void turn(const ScanHits& scan) {
    const int headings = static_cast<int>(std::ceil(2.0 * M_PI / kYawStep_rad));
    yaw_step_rad_ = 2.0 * M_PI / headings;
    hits_.resize(headings);
    for (int heading = 0; heading < headings; ++heading) {
      if (std::abs(wrap_angle(heading * yaw_step_rad_ - window_.centre.yaw_rad)) > window_.turn_rad)
        continue;
      const Eigen::Rotation2Dd turned(heading * yaw_step_rad_);
      hits_[heading].reserve(scan.hits.size());
      for (const Vector2& hit : scan.hits) {
        // The robot stands in the middle of its cell.
        const Vector2 at = turned * hit / spacing_m_ + Vector2(0.5, 0.5);
        hits_[heading].push_back(
            {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))});
      }
    }
  }

  Cell cell_of(const Vector2& position) const {
    const Vector2 cell =
        ((position - origin_) / spacing_m_).cwiseMin(kFarthest).cwiseMax(-kFarthest);
    return {static_cast<int>(cell.x()), static_cast<int>(cell.y())};
  }

  /// The coarsest squares that are good enough.
  void begin() {
    const Vector2 reach_m = Vector2::Constant(window_.radius_m);
    const SquareSums::Part part = top_.part(cell_of(window_.centre.position - reach_m),
                                            cell_of(window_.centre.position + reach_m));
    std::vector<std::uint16_t> sums;
    for (int heading = 0; heading < static_cast<int>(hits_.size()) && !is_given_up(); ++heading) {
      if (hits_[heading].empty()) continue;
      top_.add_up(hits_[heading], part, sums);
      looked_at_ += part.squares() / kAbreast + 1;
      for (int i = 0; i < part.squares(); ++i) {
        const double bound = score_of(sums[i]);
        if (bound < least()) continue;
        const Cell corner{(part.begin[0] + i % part.columns()) << kTop,
                          (part.begin[1] + i / part.columns()) << kTop};
        const Square square{corner, kTop, heading, bound};
        if (is_possible(square)) squares_.push_back(square);
      }
    }
    std::make_heap(squares_.begin(), squares_.end(), is_worse);
  }

  void divide(const Square& square) {
    const int half = 1 << (square.level - 1);
    for (const Cell& by : {Cell{0, 0}, Cell{half, 0}, Cell{0, half}, Cell{half, half}}) {
      Square quarter{{square.corner[0] + by[0], square.corner[1] + by[1]},
                     square.level - 1,
                     square.heading,
                     0.0};
      if (!is_possible(quarter)) continue;
      quarter.bound = bound_of(quarter);
      if (quarter.bound < least()) continue;
      squares_.push_back(quarter);
      std::push_heap(squares_.begin(), squares_.end(), is_worse);
    }
  }

  bool is_given_up() const { return looked_at_ >= options_.budget; }

  double least() const { return std::max(options_.min_score, best_ - kRivalry); }

  /// Whether the robot may stand somewhere in the square, and in the window.
  bool is_possible(const Square& square) const {
    if (free_.at(square.level, square.corner[0], square.corner[1]) == 0) return false;
    const double far_m = (pose_of(square).position - window_.centre.position).norm();
    return far_m <= window_.radius_m + M_SQRT1_2 * spacing_m_ * (1 << square.level);
  }

  double score_of(int sum) const { return sum / full_; }

  double bound_of(const Square& square) {
    ++looked_at_;
    int sum = 0;
    for (const Cell& hit : hits_[square.heading])
      sum += likelihood_.at(square.level, square.corner[0] + hit[0], square.corner[1] + hit[1]);
    return score_of(sum);
  }

  Pose pose_of(const Square& square) const {
    const double half = 0.5 * (1 << square.level);
    return {origin_ + spacing_m_ * Vector2(square.corner[0] + half, square.corner[1] + half),
            wrap_angle(square.heading * yaw_step_rad_)};
  }

  bool is_near(const Pose& a, const Pose& b, double slack_m) const {
    return (a.position - b.position).norm() + slack_m <= kApart_m &&
           std::abs(wrap_angle(a.yaw_rad - b.yaw_rad)) <= kApart_rad;
  }

  /// Whether nothing in the square could replace the place that all of it belongs to.
  bool is_settled(const Square& square) const {
    const Pose middle = pose_of(square);
    const double radius_m = M_SQRT1_2 * spacing_m_ * (1 << square.level);
    return std::any_of(
        places_.begin(), places_.end(), [&](const BranchAndBoundMatcher::Place& place) {
          return place.score >= square.bound && is_near(place.pose, middle, radius_m);
        });
  }

  void add(const Square& square) {
    const BranchAndBoundMatcher::Place found{pose_of(square), square.bound};
    const auto same = std::find_if(places_.begin(), places_.end(), [&](const auto& place) {
      return is_near(place.pose, found.pose, 0.0);
    });
    if (same == places_.end()) {
      places_.push_back(found);
    } else if (same->score < found.score) {
      *same = found;
    }
    best_ = std::max(best_, found.score);
  }

  const BranchAndBoundMatcher::Options& options_;
  double spacing_m_;
  Vector2 origin_;
  const GridPyramid& likelihood_;
  const SquareSums& top_;
  const GridPyramid& free_;
  const SearchWindow& window_;
  double yaw_step_rad_ = 0.0;
  std::vector<std::vector<Cell>> hits_;  // of each heading
  double full_ = 1.0;                    // sum of a scan whose hits all lie on walls
  std::vector<BranchAndBoundMatcher::Place> places_;
  std::vector<Square> squares_;  // to be looked at, a heap
  double best_ = 0.0;
  int looked_at_ = 0;
};

}  // namespace

BranchAndBoundMatcher::BranchAndBoundMatcher(const LikelihoodField& walls, const Options& options)
    : options_(options),
      spacing_m_(std::max(kSpacing_m, walls.map().resolution_m)),
      origin_(walls.map().origin),
      likelihood_(likelihood_of(walls, spacing_m_)),
      top_(likelihood_, kTop),
      free_(free_places(walls, spacing_m_)) {}

BranchAndBoundMatcher::Result BranchAndBoundMatcher::find(const ScanHits& scan,
                                                          const SearchWindow& window) const {
  if (scan.hits.empty()) return {};
  return Run(options_, spacing_m_, origin_, likelihood_, top_, free_, window)
      .find(thinned(scan, options_.hits));
}

}  // namespace mocha
