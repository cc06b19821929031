#include "perception/tracking/hit_clusters.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "perception/tracking/watch.h"

namespace mocha {
namespace {

/// The hits of a scan on discs in the open, from the origin.
class Discs {
 public:
  explicit Discs(const std::vector<Circle>& discs, double noise_m = 0.01)
      : watch_({{-15.0, -15.0}, {15.0, 15.0}, {}}, 1, senses(noise_m)) {
    for (const Circle& disc : discs)
      watch_.walkers.push_back(walker(disc.radius_m, disc.centre, {0.0, 0.0}));
    beams = watch_.scan({});
    for (std::size_t i = 0; i < beams.size(); ++i) {
      const Vector2 end = beams[i].end.head<2>();
      const bool on_disc = std::any_of(discs.begin(), discs.end(), [&](const Circle& disc) {
        return std::abs((end - disc.centre).norm() - disc.radius_m) < 0.1;
      });
      if (on_disc) hits.push_back(static_cast<int>(i));
    }
  }

  /// The disc that all hits of a part are on; -1 where they are on several.
  int disc_of(const BeamIndices& part) const {
    for (std::size_t k = 0; k < watch_.walkers.size(); ++k) {
      const Walker& disc = watch_.walkers[k];
      const bool all = std::all_of(part.begin(), part.end(), [&](int i) {
        const Vector2 end = beams[i].end.head<2>();
        return std::abs((end - disc.at(0.0)).norm() - disc.radius_m) < 0.1;
      });
      if (all) return static_cast<int>(k);
    }
    return -1;
  }

  std::vector<Beam> beams;
  BeamIndices hits;

 private:
  static Senses senses(double noise_m) {
    Senses senses;
    senses.noise_m = noise_m;
    senses.dropout = 0.0;
    return senses;
  }

  Watch watch_;
};

TEST(PartAtNotches, PartsDiscsThatTouchOrNearlyDo) {
  const std::vector<std::vector<Circle>> scenes = {
      {{{3.0, -0.5}, 0.5}, {{3.0, 0.5}, 0.5}},                     // side by side
      {{{3.0, 0.0}, 0.5}, {{3.8, 0.8}, 0.5}},                      // one half behind the other
      {{{3.0, -1.0}, 0.5}, {{3.0, 0.0}, 0.5}, {{3.0, 1.0}, 0.5}},  // three in a row
      {{{-3.0, -0.5}, 0.5}, {{-3.0, 0.5}, 0.5}},                   // where the sweep begins
      {{{-3.0, 0.2}, 0.5}, {{-3.6, 1.1}, 0.5}},
      // Small, with space between them: no edge is much farther away than the next disc's front.
      {{{2.5, -0.9}, 0.25}, {{2.5, -0.3}, 0.25}, {{2.5, 0.3}, 0.25}, {{2.5, 0.9}, 0.25}}};
  for (const auto& scene : scenes) {
    const Discs discs(scene);
    SCOPED_TRACE(scene[0].centre.transpose());
    const auto parts = part_at_notches(discs.beams, discs.hits, 0.15);
    EXPECT_EQ(parts.size(), scene.size());
    std::vector<int> found;
    std::size_t hits = 0;
    for (const BeamIndices& part : parts) {
      EXPECT_TRUE(std::is_sorted(part.begin(), part.end()));
      found.push_back(discs.disc_of(part));
      hits += part.size();
    }
    std::sort(found.begin(), found.end());
    std::vector<int> all(scene.size());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(found, all);
    EXPECT_EQ(hits, discs.hits.size());
  }
}

TEST(PartAtNotches, LeavesOneDiscWhole) {
  for (const double radius_m : {0.2, 0.35, 0.5}) {
    for (const Vector2& centre : {Vector2(1.5, 0.0), Vector2(-3.0, 0.1), Vector2(0.0, 5.0)}) {
      const Discs disc({{centre, radius_m}}, 0.02);
      const auto parts = part_at_notches(disc.beams, disc.hits, 0.15);
      ASSERT_EQ(parts.size(), 1u) << radius_m << " at " << centre.transpose();
      EXPECT_EQ(parts[0], disc.hits);
    }
  }
}

TEST(PartAtNotches, ABeamWithoutReturnPartsNothing) {
  Discs disc({{{2.5, 0.0}, 0.35}});
  const int lost = disc.hits[disc.hits.size() / 2];
  disc.beams[lost].kind = BeamEnd::kMiss;
  disc.hits.erase(disc.hits.begin() + static_cast<std::ptrdiff_t>(disc.hits.size() / 2));
  EXPECT_EQ(part_at_notches(disc.beams, disc.hits, 0.15).size(), 1u);
}

TEST(PartAtNotches, LeavesAWallWhole) {
  Watch watch({{-4.0, -3.0}, {4.0, 3.0}, {}});
  const std::vector<Beam> beams = watch.scan({});
  BeamIndices wall;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].end.y() > 2.9 && std::abs(beams[i].end.x()) < 3.5)
      wall.push_back(static_cast<int>(i));
  }
  ASSERT_GT(wall.size(), 100u);
  EXPECT_EQ(part_at_notches(beams, wall, 0.15).size(), 1u);
}

TEST(PartAtNotches, OfNothingThereIsNoPart) { EXPECT_TRUE(part_at_notches({}, {}, 0.15).empty()); }

}  // namespace
}  // namespace mocha
