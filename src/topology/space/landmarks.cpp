#include "topology/space/landmarks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "topology/space/voxel_thinning.h"

namespace mocha {
namespace {

constexpr int kNone = -1;
constexpr double kLeastSpacingCells = 2.0;
constexpr double kMuchMore = 1.1;  // room at a corner of a voxel, over that at its centre

/// What remains of the open voxels, widest first.
std::vector<int> middle_voxels(const SolidVoxels& voxels) {
  SolidVoxels thinned = voxels;
  thin_open(thinned);
  std::vector<int> middle;
  for (int number = 0; number < static_cast<int>(thinned.solid.size()); ++number) {
    if (thinned.solid[number] == 0) middle.push_back(number);
  }
  std::stable_sort(middle.begin(), middle.end(),
                   [&](int a, int b) { return voxels.distance_m[a] > voxels.distance_m[b]; });
  return middle;
}

/// Places by how far they are apart, and by cubes of that size: so that few cubes are looked at,
/// and few places in each.
class PlaceIndex {
 public:
  explicit PlaceIndex(double least_m) : least_m_(least_m) {}

  /// `apart_m`: no other place is as close.
  void add(const Eigen::Vector3d& place, double apart_m) {
    const auto level = static_cast<std::size_t>(std::max(0.0, std::log2(apart_m / least_m_)));
    if (level >= levels_.size()) levels_.resize(level + 1);
    levels_[level][key(cube(place, level))].push_back(static_cast<int>(places_.size()));
    places_.push_back(place);
  }

  /// Returns a place within `radius_m`, by its number in the order in which they came, or kNone.
  int find(const Eigen::Vector3d& place, double radius_m) const {
    int found = kNone;
    for (std::size_t level = 0; found == kNone && level < levels_.size(); ++level)
      found = find(place, radius_m, level);
    return found;
  }

 private:
  int find(const Eigen::Vector3d& place, double radius_m, std::size_t level) const {
    if (levels_[level].empty()) return kNone;
    const Eigen::Vector3d aside = Eigen::Vector3d::Constant(radius_m);
    const Eigen::Vector3i low = cube(place - aside, level);
    const Eigen::Vector3i high = cube(place + aside, level);
    Eigen::Vector3i at;
    for (at.z() = low.z(); at.z() <= high.z(); ++at.z()) {
      for (at.y() = low.y(); at.y() <= high.y(); ++at.y()) {
        for (at.x() = low.x(); at.x() <= high.x(); ++at.x()) {
          const auto found = levels_[level].find(key(at));
          if (found == levels_[level].end()) continue;
          for (const int number : found->second) {
            if ((places_[number] - place).norm() <= radius_m) return number;
          }
        }
      }
    }
    return kNone;
  }

  Eigen::Vector3i cube(const Eigen::Vector3d& place, std::size_t level) const {
    const double cube_m = std::ldexp(least_m_, static_cast<int>(level) + 1);
    return (place / cube_m).array().floor().matrix().cast<int>();
  }
  static std::uint64_t key(const Eigen::Vector3i& cube) {
    constexpr std::uint64_t kMost = 2097152;  // others share a key, which costs a look
    return (static_cast<std::uint64_t>(cube.x()) * kMost + cube.y()) * kMost + cube.z();
  }

  const double least_m_;
  std::vector<Eigen::Vector3d> places_;
  std::vector<std::unordered_map<std::uint64_t, std::vector<int>>> levels_;
};

/// The best place within a voxel: its centre, or a corner with much more room. Where a way is an
/// even number of voxels wide, corners are in its middle.
Eigen::Vector3d best_place(const SolidVoxels& voxels, const VoxelDistanceField& field,
                           const Eigen::Vector3i& voxel) {
  Eigen::Vector3d best = voxels.centre(voxel);
  double most_m = kMuchMore * field.distance_bound(best);
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d step(corner & 1, corner >> 1 & 1, corner >> 2);
    const Eigen::Vector3d place =
        voxels.origin + voxels.resolution_m * (voxel.cast<double>() + step);
    const double room_m = field.distance_bound(place);
    if (room_m <= most_m) continue;
    most_m = room_m;
    best = place;
  }
  return best;
}

using Pairs = std::vector<std::pair<int, int>>;

void keep_one_of_each(Pairs& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Pairs of places that stand for voxels beside each other.
Pairs neighbours_of(const SolidVoxels& voxels, const std::vector<int>& middle,
                    const std::vector<int>& place_of) {
  Pairs pairs;
  for (const int number : middle) {
    for (const int step : voxels.steps()) {
      const int other = place_of[number + step];
      if (other != kNone && other != place_of[number])
        pairs.push_back(std::minmax(place_of[number], other));
    }
  }
  keep_one_of_each(pairs);
  return pairs;
}

/// The pairs, and those of places that have a neighbour in common: ways through these are
/// straighter.
Pairs with_next_but_one(Pairs pairs, std::size_t places) {
  std::vector<std::vector<int>> beside(places);
  for (const auto& [a, b] : pairs) {
    beside[a].push_back(b);
    beside[b].push_back(a);
  }
  for (const std::vector<int>& around : beside) {
    for (std::size_t i = 0; i < around.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) pairs.push_back(std::minmax(around[i], around[k]));
    }
  }
  keep_one_of_each(pairs);
  return pairs;
}

}  // namespace

Landmarks landmarks(const SolidVoxels& voxels, const VoxelDistanceField& field,
                    double clearance_m) {
  Landmarks found;
  const std::vector<int> middle = middle_voxels(voxels);
  std::vector<int> place_of(voxels.solid.size(), kNone);  // that stands for a voxel
  const double least_m = kLeastSpacingCells * voxels.resolution_m;
  PlaceIndex index(least_m);
  for (const int number : middle) {
    const Eigen::Vector3i voxel = voxels.voxel(number);
    const Eigen::Vector3d centre = voxels.centre(voxel);
    const double apart_m = std::max(voxels.distance_m[number] - clearance_m, least_m);
    place_of[number] = index.find(centre, apart_m);
    if (place_of[number] != kNone) continue;
    place_of[number] = static_cast<int>(found.places.size());
    index.add(centre, apart_m);
    found.places.push_back(best_place(voxels, field, voxel));
  }
  found.neighbours =
      with_next_but_one(neighbours_of(voxels, middle, place_of), found.places.size());
  return found;
}

}  // namespace mocha
