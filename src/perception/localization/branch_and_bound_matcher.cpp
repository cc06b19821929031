#include "perception/localization/branch_and_bound_matcher.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mocha {
namespace {

constexpr int kTop = 6;  // the search begins with squares of 2^6 cells
constexpr double kFull = 255.0;
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

using Cell = std::array<int, 2>;

/// Squares of places with one heading that share a bound on their scores.
struct Square {
  Cell corner;
  int level;
  int heading;
  double bound;
};

/// One run of the search: depth first, the most promising squares first.
class Run {
 public:
  Run(const BranchAndBoundMatcher::Options& options, double spacing_m, const Vector2& origin,
      const GridPyramid& likelihood, const GridPyramid& free_cells, const SearchWindow& window)
      : options_(options),
        spacing_m_(spacing_m),
        origin_(origin),
        likelihood_(likelihood),
        free_(free_cells),
        window_(window) {}

  BranchAndBoundMatcher::Result find(const ScanHits& scan) {
    turn(scan);
    std::vector<Square> squares;
    const int edge = 1 << kTop;
    for (int heading = 0; heading < static_cast<int>(hits_.size()); ++heading) {
      if (std::abs(wrap_angle(heading * yaw_step_rad_ - window_.centre.yaw_rad)) > window_.turn_rad)
        continue;
      for (int y = 0; y < free_.height(); y += edge) {
        for (int x = 0; x < free_.width(); x += edge) consider({{x, y}, kTop, heading, 0}, squares);
      }
    }
    descend(squares);
    const auto worse = [this](const BranchAndBoundMatcher::Place& p) { return p.score < least(); };
    places_.erase(std::remove_if(places_.begin(), places_.end(), worse), places_.end());
    std::sort(places_.begin(), places_.end(),
              [](const auto& a, const auto& b) { return a.score > b.score; });
    if (places_.size() > kMostPlaces) places_.resize(kMostPlaces);
    return {places_, !is_given_up(), squares_};
  }

 private:
  /// The hits in cells from a robot in the corner of a cell, for every heading.
  void turn(const ScanHits& scan) {
    const int headings = static_cast<int>(std::ceil(2.0 * M_PI / kYawStep_rad));
    yaw_step_rad_ = 2.0 * M_PI / headings;
    hits_.resize(headings);
    for (int heading = 0; heading < headings; ++heading) {
      const Eigen::Rotation2Dd turned(heading * yaw_step_rad_);
      for (const Vector2& hit : scan.hits) {
        // The robot stands in the middle of its cell.
        const Vector2 at = turned * hit / spacing_m_ + Vector2(0.5, 0.5);
        hits_[heading].push_back(
            {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y()))});
      }
    }
  }

  bool is_given_up() const { return squares_ >= options_.budget; }

  double least() const { return std::max(options_.min_score, best_ - kRivalry); }

  bool is_outside(const Square& square) const {
    const double far_m = (pose_of(square).position - window_.centre.position).norm();
    return far_m > window_.radius_m + M_SQRT1_2 * spacing_m_ * (1 << square.level);
  }

  double bound_of(const Square& square) const {
    int sum = 0;
    for (const Cell& hit : hits_[square.heading]) {
      sum += likelihood_.at(square.level, square.corner[0] + hit[0], square.corner[1] + hit[1]);
    }
    return sum / (kFull * static_cast<double>(hits_[square.heading].size()));
  }

  void consider(Square square, std::vector<Square>& squares) {
    if (is_outside(square) || free_.at(square.level, square.corner[0], square.corner[1]) == 0)
      return;
    ++squares_;
    square.bound = bound_of(square);
    if (square.bound >= least()) squares.push_back(square);
  }

  void descend(std::vector<Square>& squares) {
    std::sort(squares.begin(), squares.end(),
              [](const Square& a, const Square& b) { return a.bound > b.bound; });
    for (const Square& square : squares) {
      if (square.bound < least() || is_given_up()) return;
      if (square.level == 0) {
        add(square);
      } else if (!is_settled(square)) {
        std::vector<Square> quarters;
        const int half = 1 << (square.level - 1);
        for (const Cell& by : {Cell{0, 0}, Cell{half, 0}, Cell{0, half}, Cell{half, half}}) {
          consider({{square.corner[0] + by[0], square.corner[1] + by[1]},
                    square.level - 1,
                    square.heading,
                    0.0},
                   quarters);
        }
        descend(quarters);
      }
    }
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
  const GridPyramid& free_;
  const SearchWindow& window_;
  double yaw_step_rad_ = 0.0;
  std::vector<std::vector<Cell>> hits_;  // of each heading
  std::vector<BranchAndBoundMatcher::Place> places_;
  double best_ = 0.0;
  int squares_ = 0;
};

}  // namespace

BranchAndBoundMatcher::BranchAndBoundMatcher(const LikelihoodField& walls, const Options& options)
    : options_(options),
      spacing_m_(std::max(kSpacing_m, walls.map().resolution_m)),
      origin_(walls.map().origin),
      likelihood_(likelihood_of(walls, spacing_m_)),
      free_(free_places(walls, spacing_m_)) {}

BranchAndBoundMatcher::Result BranchAndBoundMatcher::find(const ScanHits& scan,
                                                          const SearchWindow& window) const {
  if (scan.hits.empty()) return {};
  return Run(options_, spacing_m_, origin_, likelihood_, free_, window)
      .find(thinned(scan, options_.hits));
}

}  // namespace mocha
