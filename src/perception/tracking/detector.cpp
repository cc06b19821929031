#include "perception/tracking/detector.h"

#include <algorithm>
#include <utility>

namespace mocha {
namespace {

constexpr double kNotch_m = 0.15;  // between two things, in the ranges of the beams that hit them
constexpr double kGoesOn_m = 0.3;  // a hit so near is on the same surface, of the next beams
constexpr int kBeamsBeside = 2;
constexpr double kMostHaveCome = 0.5;  // of the hits on a surface or thing have come: it has

std::vector<bool> mask_of(const BeamIndices& hits, std::size_t size) {
  std::vector<bool> mask(size, false);
  for (const int i : hits) mask[i] = true;
  return mask;
}

bool have_mostly_come(const BeamIndices& hits, const std::vector<bool>& has_come) {
  const auto came = std::count_if(hits.begin(), hits.end(), [&](int i) { return has_come[i]; });
  return static_cast<double>(came) > kMostHaveCome * static_cast<double>(hits.size());
}

/// Whether something that has not come goes on beside a group of hits.
bool is_continued(const std::vector<Beam>& beams, const BeamIndices& group,
                  const std::vector<bool>& may_move) {
  const int size = static_cast<int>(beams.size());
  for (const int i : group) {
    for (int step = -kBeamsBeside; step <= kBeamsBeside; ++step) {
      const int next = (i + step + kBeamsBeside * size) % size;
      if (beams[next].kind != BeamEnd::kHit || !is_usable(beams[next]) || may_move[next]) continue;
      if ((beams[next].end - beams[i].end).head<2>().norm() > kGoesOn_m) continue;
      if (!std::binary_search(group.begin(), group.end(), next)) return true;
    }
  }
  return false;
}

/// As how many legs of a person the hits of a thing look; `shared` of them are on such legs.
int legs_of(const Detector::Thing& thing, const LegHits& legs, std::size_t shared) {
  if (legs.legs == 2 && 2 * shared > legs.hits.size()) return 2;
  return 4 * shared > 3 * thing.hits.size() ? 1 : 0;
}

/// Says which things look like legs, and adds legs that are on none of them.
void add_legs(const std::vector<Beam>& beams, const std::vector<LegHits>& legs,
              std::vector<Detector::Thing>& things) {
  const std::size_t others = things.size();
  for (const LegHits& leg : legs) {
    bool is_known = false;
    for (std::size_t k = 0; k < others; ++k) {
      const BeamIndices& hits = things[k].hits;
      const auto shared = std::count_if(leg.hits.begin(), leg.hits.end(), [&](int i) {
        return std::binary_search(hits.begin(), hits.end(), i);
      });
      if (shared == 0) continue;
      is_known = true;
      int& looks = things[k].detection.legs;
      looks = std::max(looks, legs_of(things[k], leg, static_cast<std::size_t>(shared)));
    }
    if (is_known) continue;
    things.push_back({leg.hits, sight_disc(beams, leg.hits)});
    things.back().detection.legs = leg.legs;
  }
}

}  // namespace

std::vector<Detector::Thing> Detector::detect(const std::vector<Beam>& beams,
                                              const BeamIndices& came,
                                              const std::vector<TrackedObstacle>& known) const {
  std::vector<TrackedObstacle> lively;
  std::vector<TrackedObstacle> still;
  for (const TrackedObstacle& thing : known)
    (thing.stands && !thing.is_mover ? still : lively).push_back(thing);
  const std::vector<ScanSegment> segments = scan_segments(beams);
  const std::vector<bool> has_come = mask_of(came, beams.size());
  const std::vector<bool> on_surface = on_large_surfaces(segments, has_come);
  BeamIndices lively_hits;
  BeamIndices other_hits;
  for (int i = 0; i < static_cast<int>(beams.size()); ++i) {
    if (beams[i].kind != BeamEnd::kHit || !is_usable(beams[i]) || on_surface[i]) continue;
    const bool is_lively = has_come[i] || is_on_standing_person(beams[i], lively);
    (is_lively ? lively_hits : other_hits).push_back(i);
  }
  const std::vector<bool> may_move = mask_of(lively_hits, beams.size());
  std::vector<Thing> things;
  const auto add = [&](const BeamIndices& group) {
    things.push_back({group, sight_disc(beams, group)});
    Detection& detection = things.back().detection;
    detection.has_come = have_mostly_come(group, has_come);
    detection.is_continued = is_continued(beams, group, may_move);
  };
  for (const BeamIndices& group : lively_things(beams, lively_hits, lively)) add(group);
  for (const BeamIndices& group : still_things(beams, other_hits, still)) add(group);
  add_legs(beams, find_legs(beams, segments), things);
  return things;
}

/// Returns for each beam whether it hits a surface that is too large to move. Segments that have
/// mostly come do not count: they may be several things that are near to each other.
std::vector<bool> Detector::on_large_surfaces(const std::vector<ScanSegment>& segments,
                                              const std::vector<bool>& has_come) const {
  std::vector<bool> large(has_come.size(), false);
  for (const ScanSegment& segment : segments) {
    if (segment.width_m <= options_.extent_m) continue;
    if (have_mostly_come(segment.hits, has_come)) continue;
    for (const int i : segment.hits) large[i] = true;
  }
  return large;
}

/// Returns whether the beam ends on a known person who stands, or close by. The map may hold that
/// person already; when it sets off, only the leg that moves is new.
bool Detector::is_on_standing_person(const Beam& beam,
                                     const std::vector<TrackedObstacle>& lively) const {
  return std::any_of(lively.begin(), lively.end(), [&](const TrackedObstacle& thing) {
    return thing.stands && is_in_reach(beam, thing);
  });
}

/// Clusters of hits that are small enough to move. Those within reach of a lively thing are one, as
/// the legs of a walking person; one that several of these can reach is parted among them. What is
/// too large for one thing may be several that are near to each other.
std::vector<BeamIndices> Detector::lively_things(const std::vector<Beam>& beams,
                                                 const BeamIndices& hits,
                                                 const std::vector<TrackedObstacle>& lively) const {
  std::vector<BeamIndices> owned(lively.size());
  std::vector<BeamIndices> others;
  for (BeamIndices& cluster : cluster_hits(beams, hits, options_.gap_m)) {
    std::vector<std::size_t> owners;
    std::vector<Vector2> centres;
    for (std::size_t k = 0; k < lively.size(); ++k) {
      const bool holds = std::any_of(cluster.begin(), cluster.end(),
                                     [&](int i) { return is_in_reach(beams[i], lively[k]); });
      if (!holds) continue;
      owners.push_back(k);
      centres.push_back(lively[k].position);
    }
    if (owners.empty()) {
      others.push_back(std::move(cluster));
      continue;
    }
    const auto parts = part_cluster(beams, cluster, centres);
    for (std::size_t k = 0; k < owners.size(); ++k)
      owned[owners[k]].insert(owned[owners[k]].end(), parts[k].begin(), parts[k].end());
  }
  for (std::size_t k = 0; k < lively.size(); ++k) {
    for (BeamIndices& rest : keep_to_reach(beams, lively[k], owned[k]))
      others.push_back(std::move(rest));
  }
  for (const BeamIndices& other : others) {
    if (is_one_thing(beams, other)) {
      owned.push_back(other);
      continue;
    }
    for (BeamIndices& part : part_at_notches(beams, other, kNotch_m))
      owned.push_back(std::move(part));
  }
  const auto no_thing = [&](const BeamIndices& group) { return !is_thing(beams, group); };
  for (BeamIndices& group : owned) std::sort(group.begin(), group.end());
  owned.erase(std::remove_if(owned.begin(), owned.end(), no_thing), owned.end());
  return owned;
}

/// What is seen of things that stand: of each, the hits that are nearer to it than to others.
std::vector<BeamIndices> Detector::still_things(const std::vector<Beam>& beams,
                                                const BeamIndices& hits,
                                                const std::vector<TrackedObstacle>& still) const {
  std::vector<BeamIndices> parts(still.size());
  for (const int i : hits) {
    double least_m = options_.reach_m;
    BeamIndices* nearest = nullptr;
    for (std::size_t k = 0; k < still.size(); ++k) {
      const double off_m = (beams[i].end.head<2>() - still[k].position).norm() - still[k].radius_m;
      if (off_m > least_m) continue;
      least_m = off_m;
      nearest = &parts[k];
    }
    if (nearest != nullptr) nearest->push_back(i);
  }
  const auto no_thing = [&](const BeamIndices& group) { return !is_thing(beams, group); };
  parts.erase(std::remove_if(parts.begin(), parts.end(), no_thing), parts.end());
  return parts;
}

bool Detector::is_thing(const std::vector<Beam>& beams, const BeamIndices& group) const {
  return static_cast<int>(group.size()) >= options_.points && is_one_thing(beams, group);
}

bool Detector::is_in_reach(const Beam& beam, const TrackedObstacle& thing) const {
  return (beam.end.head<2>() - thing.position).norm() <= thing.radius_m + 0.5 * options_.gap_m;
}

bool Detector::is_one_thing(const std::vector<Beam>& beams, const BeamIndices& group) const {
  return extent_m(beams, group) <= options_.extent_m;
}

/// Of a group that is too large, the hits out of the thing's reach are others'.
std::vector<BeamIndices> Detector::keep_to_reach(const std::vector<Beam>& beams,
                                                 const TrackedObstacle& thing,
                                                 BeamIndices& group) const {
  if (is_one_thing(beams, group)) return {};
  const auto rest = std::stable_partition(group.begin(), group.end(),
                                          [&](int i) { return is_in_reach(beams[i], thing); });
  const BeamIndices others(rest, group.end());
  group.erase(rest, group.end());
  return cluster_hits(beams, others, options_.gap_m);
}

}  // namespace mocha
