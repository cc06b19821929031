#include "topology/space/voxel_thinning.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mocha {
namespace {

constexpr int kNeighbours = 26;
using Mask = std::uint32_t;  // a bit for each neighbour

/// Where the neighbours are, and which of them are neighbours of each other.
struct Neighbourhood {
  std::array<std::array<int, 3>, kNeighbours> offset{};
  std::array<Mask, kNeighbours> by_corner{};  // shared face, edge or corner
  std::array<Mask, kNeighbours> by_face{};    // shared face, both in the eighteen
  Mask faces = 0;                             // that share a face with the voxel
  Mask eighteen = 0;                          // that share a face or an edge with it
};

constexpr int size_of(int i) { return i < 0 ? -i : i; }

constexpr Neighbourhood make_neighbourhood() {
  Neighbourhood hood{};
  int count = 0;
  for (int z = -1; z <= 1; ++z) {
    for (int y = -1; y <= 1; ++y) {
      for (int x = -1; x <= 1; ++x) {
        const int away = size_of(x) + size_of(y) + size_of(z);
        if (away == 0) continue;
        hood.offset[count][0] = x;
        hood.offset[count][1] = y;
        hood.offset[count][2] = z;
        if (away == 1) hood.faces |= Mask{1} << count;
        if (away <= 2) hood.eighteen |= Mask{1} << count;
        ++count;
      }
    }
  }
  for (int a = 0; a < kNeighbours; ++a) {
    for (int b = 0; b < kNeighbours; ++b) {
      int most = 0;
      int sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const int away = size_of(hood.offset[a][axis] - hood.offset[b][axis]);
        most = away > most ? away : most;
        sum += away;
      }
      if (most == 1) hood.by_corner[a] |= Mask{1} << b;
      const Mask both = Mask{1} << a | Mask{1} << b;
      if (sum == 1 && (hood.eighteen & both) == both) hood.by_face[a] |= Mask{1} << b;
    }
  }
  return hood;
}

constexpr Neighbourhood kHood = make_neighbourhood();

/// Takes the part that holds `seed`, one bit, out of `rest`; returns it.
Mask take_part(Mask seed, Mask& rest, const std::array<Mask, kNeighbours>& linked) {
  Mask part = 0;
  for (Mask fresh = seed; fresh != 0;) {
    part |= fresh;
    rest &= ~fresh;
    Mask around = 0;
    for (Mask left = fresh; left != 0; left &= left - 1) around |= linked[__builtin_ctz(left)];
    fresh = around & rest;
  }
  return part;
}

VoxelKind kind_of_mask(Mask solid) {
  VoxelKind kind{0, 0};
  for (Mask rest = solid; rest != 0; ++kind.solid_parts)
    take_part(rest & -rest, rest, kHood.by_corner);
  Mask open = ~solid & kHood.eighteen;
  for (Mask faces = open & kHood.faces; faces != 0; ++kind.open_parts)
    faces &= ~take_part(faces & -faces, open, kHood.by_face);
  return kind;
}

/// Steps from a voxel's number to those of its neighbours.
std::array<int, kNeighbours> steps_of(const SolidVoxels& voxels) {
  const Eigen::Vector3i steps = voxels.steps();
  std::array<int, kNeighbours> to{};
  for (int k = 0; k < kNeighbours; ++k) {
    to[k] = kHood.offset[k][0] * steps.x() + kHood.offset[k][1] * steps.y() +
            kHood.offset[k][2] * steps.z();
  }
  return to;
}

Mask solid_around(const std::uint8_t* voxel, const std::array<int, kNeighbours>& to) {
  Mask mask = 0;
  for (int k = 0; k < kNeighbours; ++k) mask |= Mask{voxel[to[k]]} << k;
  return mask;
}

/// Voxels in the order of their distance, equal ones first come, first served.
class DistanceQueue {
 public:
  DistanceQueue(const std::vector<float>& distance_m, bool far_first)
      : next_(distance_m.size(), kNowhere) {
    const auto [least, most] = std::minmax_element(distance_m.begin(), distance_m.end());
    const float range = *most - *least;
    scale_ = range > 0.0f ? (far_first ? 1 - kBuckets : kBuckets - 1) / range : 0.0f;
    zero_ = far_first ? *most : *least;
    first_.fill(kNowhere);
    last_.fill(kNowhere);
  }

  bool holds(int number) const { return next_[number] != kNowhere; }

  void push(int number, float distance_m) {
    const int bucket = static_cast<int>(scale_ * (distance_m - zero_));
    (first_[bucket] == kNowhere ? first_[bucket] : next_[last_[bucket]]) = number;
    last_[bucket] = number;
    next_[number] = kEnd;
    lowest_ = std::min(lowest_, bucket);
  }

  /// Nothing, below 0, at the end.
  int pop() {
    while (lowest_ < kBuckets && first_[lowest_] == kNowhere) ++lowest_;
    if (lowest_ == kBuckets) return kNowhere;
    const int number = first_[lowest_];
    first_[lowest_] = next_[number] == kEnd ? kNowhere : next_[number];
    next_[number] = kNowhere;
    return number;
  }

 private:
  static constexpr int kBuckets = 1024;
  static constexpr int kNowhere = -1;
  static constexpr int kEnd = -2;

  float scale_;
  float zero_;
  std::array<int, kBuckets> first_;
  std::array<int, kBuckets> last_;
  std::vector<int> next_;  // in the same bucket; kNowhere: not queued
  int lowest_ = kBuckets;
};

/// Turns voxels of one kind into the other as long as that changes nothing; not where `stays` says
/// so of the number of a voxel.
template <typename Stays>
void thin(SolidVoxels& voxels, std::uint8_t from, const Stays& stays) {
  const std::array<int, kNeighbours> to = steps_of(voxels);
  DistanceQueue queue(voxels.distance_m, from == 1);
  std::vector<std::uint8_t>& solid = voxels.solid;
  const Eigen::Vector3i size = voxels.size;
  const auto push_if_simple = [&](int number) {
    if (solid[number] != from || queue.holds(number) || !voxels.contains(voxels.voxel(number)))
      return;
    if (kind_of_mask(solid_around(&solid[number], to)).is_simple() && !stays(number))
      queue.push(number, voxels.distance_m[number]);
  };
  Eigen::Vector3i at;
  for (at.z() = 0; at.z() < size.z(); ++at.z()) {
    for (at.y() = 0; at.y() < size.y(); ++at.y()) {
      for (at.x() = 0; at.x() < size.x(); ++at.x()) push_if_simple(voxels.number(at));
    }
  }
  for (int number = queue.pop(); number >= 0; number = queue.pop()) {
    if (!kind_of_mask(solid_around(&solid[number], to)).is_simple()) continue;
    solid[number] = from == 1 ? 0 : 1;
    for (int k = 0; k < kNeighbours; ++k) push_if_simple(number + to[k]);
  }
}

}  // namespace

VoxelKind kind_of(const SolidVoxels& voxels, int number) {
  return kind_of_mask(solid_around(&voxels.solid[number], steps_of(voxels)));
}

void thin_solid(SolidVoxels& voxels) {
  thin(voxels, 1, [](int) { return false; });
}

void thin_open(SolidVoxels& voxels) {
  const std::array<int, kNeighbours> to = steps_of(voxels);
  const std::vector<float>& distance_m = voxels.distance_m;
  thin(voxels, 0, [&](int number) {
    return std::all_of(to.begin(), to.end(),
                       [&](int step) { return distance_m[number + step] <= distance_m[number]; });
  });
}

}  // namespace mocha
