#include "planning/executive/followed_order.h"

#include <algorithm>
#include <cmath>

#include "planning/candidates/start_maneuver.h"
#include "trajectory/plane_vectors.h"
#include "trajectory/polyline.h"
#include "world/obstacle.h"

namespace mocha {
namespace {

constexpr double kAtEnd_m = 0.03;  // of a move, along its path
constexpr double kOnPath_m = 0.5;  // a motion that ends farther off it is not of this order
constexpr double kMeets_m = 0.3;   // where two paths are nearer, a place may be on either
constexpr double kStep_m = 0.1;

/// How far along the path its point nearest to `place` is, and how far away.
struct Projection {
  double along_m = 0.0;
  double off_m = 0.0;
};

Projection projected(const Vector2& place, const std::vector<Vector2>& path) {
  Projection best{0.0, (place - path.front()).norm()};
  double begin_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 nearest = nearest_on_segment(place, path[i - 1], path[i]);
    const double off_m = (place - nearest).norm();
    if (off_m < best.off_m) best = {begin_m + (nearest - path[i - 1]).norm(), off_m};
    begin_m += (path[i] - path[i - 1]).norm();
  }
  return best;
}

bool turns_back(const std::vector<Vector2>& before, const std::vector<Vector2>& after) {
  const Vector2 in = before.back() - before[before.size() - 2];
  const Vector2 out = after[1] - after.front();
  return std::abs(angle_between(in, out)) > kTurnsBack_rad;
}

/// Whether a path comes to where another one leads.
bool meets(const std::vector<Vector2>& path, const std::vector<Vector2>& other) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector2 leg = path[i] - path[i - 1];
    const int steps = static_cast<int>(std::ceil(leg.norm() / kStep_m));
    for (int k = 1; k <= steps; ++k) {
      const Vector2 place = path[i - 1] + leg * k / steps;
      if (projected(place, other).off_m < kMeets_m) return true;
    }
  }
  return false;
}

}  // namespace

FollowedOrder::FollowedOrder(const PassingInstruction& beginning)
    : id_(beginning.id),
      robots_(beginning.robots),
      turns_(beginning.turns),
      alone_from_(beginning.alone_from) {
  add(beginning);
}

void FollowedOrder::add(const PassingInstruction& part) {
  if (part.robots != robots_ || part.turns != turns_.size()) return;
  for (std::size_t i = 0; i < part.part.size() && part.first + i < turns_.size(); ++i)
    turns_[part.first + i] = part.part[i];
}

std::optional<Vector2> FollowedOrder::start() const {
  if (turns_.empty() || !turns_.front()) return std::nullopt;
  return turns_.front()->path.front();
}

bool FollowedOrder::may_begin(std::size_t move, const PromisedBy& promised_by) const {
  if (!turns_[move]) return false;
  const auto& after = turns_[move]->after;
  return std::all_of(after.begin(), after.end(), [&](const PassingProgress& progress) {
    return promised_by(robots_[progress.robot]) >= progress.moves;
  });
}

bool FollowedOrder::ends_stretch_before(std::uint32_t move) const {
  if (move == made_) return false;
  if (turns_back(turns_[move - 1]->path, turns_[move]->path)) return true;
  if (move - 1 == made_) return false;
  return meets(turns_[move]->path, stretch_until(move - 1).path);
}

PassingStretch FollowedOrder::stretch_until(std::uint32_t until) const {
  PassingStretch stretch{id_, made_, until, {}};
  for (std::uint32_t move = made_; move < until; ++move) {
    const auto& path = turns_[move]->path;
    stretch.path.insert(stretch.path.end(), path.begin() + (stretch.path.empty() ? 0 : 1),
                        path.end());
  }
  return stretch;
}

std::optional<PassingStretch> FollowedOrder::grant(const PromisedBy& promised_by) {
  // The robot drives to the end of what it has promised, whatever follows: the way back can be
  // promised by now.
  if (made_ < promised_ && promised_ == granted_ && promised_ < turns_.size() &&
      may_begin(promised_, promised_by) && ends_stretch_before(promised_))
    made_ = promised_;
  std::uint32_t until = made_;
  while (until < turns_.size()) {
    if (until >= granted_ && !may_begin(until, promised_by)) break;
    if (ends_stretch_before(until)) break;
    ++until;
  }
  granted_ = std::max(granted_, until);
  if (until == made_) return std::nullopt;
  return stretch_until(until);
}

std::vector<std::string> FollowedOrder::waits_for(const PromisedBy& promised_by) const {
  std::vector<std::string> names;
  if (made_ == turns_.size() || !turns_[made_]) return names;
  for (const PassingProgress& progress : turns_[made_]->after) {
    const std::string& name = robots_[progress.robot];
    if (promised_by(name) < progress.moves) names.push_back(name);
  }
  return names;
}

std::optional<double> FollowedOrder::next_heading_rad() const {
  if (made_ == turns_.size() || !turns_[made_]) return std::nullopt;
  const auto& path = turns_[made_]->path;
  const Vector2 along = path[1] - path[0];
  return std::atan2(along.y(), along.x());
}

void FollowedOrder::note_promise(const Motion& committed) {
  if (committed.empty() || granted_ <= made_) return;
  const Projection end = projected(committed.end_pose().position, stretch_until(granted_).path);
  if (end.off_m > kOnPath_m) return;
  double along_m = 0.0;
  for (std::uint32_t move = made_; move < granted_; ++move) {
    along_m += length_of(turns_[move]->path);
    if (along_m <= end.along_m + kAtEnd_m) promised_ = std::max(promised_, move + 1);
  }
}

void FollowedOrder::note_stand(const Vector2& place, double tolerance_m) {
  for (std::uint32_t move = made_; move < promised_; ++move) {
    if ((turns_[move]->path.back() - place).norm() < tolerance_m) made_ = move + 1;
  }
}

void FollowedOrder::note_drive(const Vector2& place) {
  if (is_over() || promised_ < alone_from_) return;
  const double needed_m = length_of(stretch_until(alone_from_).path);
  const double along_m = projected(place, stretch_until(granted_).path).along_m;
  if (along_m >= needed_m - kAtEnd_m) made_ = alone_from_;
}

}  // namespace mocha
