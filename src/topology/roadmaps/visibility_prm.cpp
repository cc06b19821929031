#include "topology/roadmaps/visibility_prm.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace mocha {
namespace {

constexpr double kBridge = 0.05;  // shares that the ends of a bridge are apart at most, each way

template <int D>
using PointOf = Eigen::Matrix<double, D, 1>;

/// In ascending order.
template <int D>
std::vector<int> within(double radius_m, const PointOf<D>& p,
                        const std::vector<PointOf<D>>& points) {
  std::vector<int> near;
  near.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if ((points[i] - p).squaredNorm() <= radius_m * radius_m) near.push_back(static_cast<int>(i));
  }
  return near;
}

template <int D>
class Sampler {
 public:
  Sampler(const SampledSpace<D>& space, std::vector<PointOf<D>> first_guards,
          const VisibilityPrmOptions& options)
      : space_(space), options_(options), random_(options.seed), guards_(std::move(first_guards)) {}

  void draw() {
    if (const std::optional<PointOf<D>> free = free_sample()) add(*free);
  }

  /// A place where one may be.
  void add(const PointOf<D>& sample) {
    const std::vector<int> guards = guards_that_see(sample);
    if (!is_between(guards, sample)) return guards_.push_back(sample);
    for (int from : guards) {
      for (int to : guards) {
        if (from < to) connect(from, sample, to);
      }
    }
  }

  /// Guards first.
  std::vector<PointOf<D>> nodes() const {
    const auto before = [](const PointOf<D>& a, const PointOf<D>& b) {
      return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    };
    std::set<PointOf<D>, decltype(before)> connectors(before);  // one may serve several links
    for (const auto& [link, connector] : connectors_) connectors.insert(connector.position);
    std::vector<PointOf<D>> nodes = guards_;
    nodes.insert(nodes.end(), connectors.begin(), connectors.end());
    return nodes;
  }

 private:
  /// Written out, as the distributions of the standard library differ from one to the next.
  PointOf<D> random_shares() {
    PointOf<D> shares;
    for (double& share : shares) share = static_cast<double>(random_() >> 11) * 0x1p-53;
    return shares;
  }

  /// Where it is narrow, few samples are free, but many are in the middle between two that are not:
  /// the bridge test of Hsu, Jiang, Reif, Sun 2003 gives what is forbidden a second chance.
  std::optional<PointOf<D>> free_sample() {
    const PointOf<D> shares = random_shares();
    const PointOf<D> sample = space_.at(shares);
    if (space_.clearance_m(sample)) return sample;
    const PointOf<D> aside = kBridge * (2.0 * random_shares() - PointOf<D>::Ones());
    const PointOf<D> across = shares + aside;
    if (across.minCoeff() < 0.0 || across.maxCoeff() >= 1.0) return std::nullopt;
    const PointOf<D> middle = space_.at(shares + 0.5 * aside);
    if (space_.clearance_m(space_.at(across)) || !space_.clearance_m(middle)) return std::nullopt;
    return middle;
  }

  using Link = std::tuple<int, int, SignatureKey>;  // from guard to guard, in which class
  struct Connector {
    PointOf<D> position;
    double length_m;  // of the way from guard to guard
  };

  bool see_each_other(const PointOf<D>& p, const PointOf<D>& q) const {
    if (space_.in_order(p, q)) return space_.clearance_m(p, q).has_value();
    return space_.in_order(q, p) && space_.clearance_m(q, p).has_value();
  }

  std::vector<int> guards_that_see(const PointOf<D>& p) const {
    std::vector<int> guards = within<D>(options_.reach_m, p, guards_);
    const auto hidden = [&](int guard) { return !see_each_other(guards_[guard], p); };
    guards.erase(std::remove_if(guards.begin(), guards.end(), hidden), guards.end());
    return guards;
  }

  /// Whether one can come to p from a guard and go on to a guard; both see p. Where there is no
  /// order, one guard will do.
  bool is_between(const std::vector<int>& guards, const PointOf<D>& p) const {
    const auto before = [&](int guard) { return space_.in_order(guards_[guard], p); };
    const auto after = [&](int guard) { return space_.in_order(p, guards_[guard]); };
    return std::any_of(guards.begin(), guards.end(), before) &&
           std::any_of(guards.begin(), guards.end(), after);
  }

  void connect(int from, const PointOf<D>& via, int to) {
    if (!space_.in_order(guards_[from], via)) std::swap(from, to);
    const PointOf<D>& p = guards_[from];
    const PointOf<D>& q = guards_[to];
    if (!space_.in_order(p, via) || !space_.in_order(via, q)) return;
    const double length_m = space_.length_m(p, via) + space_.length_m(via, q);
    const Link link(from, to, space_.key(p, via) + space_.key(via, q));
    const auto [known, is_new] = connectors_.try_emplace(link, Connector{via, length_m});
    if (!is_new && length_m < known->second.length_m) known->second = {via, length_m};
  }

  const SampledSpace<D>& space_;
  const VisibilityPrmOptions options_;
  std::mt19937_64 random_;
  std::vector<PointOf<D>> guards_;
  std::map<Link, Connector> connectors_;
};

/// Appends the straight edge between two nodes, if there is one.
template <int D>
void join(int from, int to, const SampledSpace<D>& space, Roadmap<D>& roadmap) {
  if (!space.in_order(roadmap.nodes[from].position, roadmap.nodes[to].position)) {
    std::swap(from, to);
  }
  const PointOf<D>& p = roadmap.nodes[from].position;
  const PointOf<D>& q = roadmap.nodes[to].position;
  if (!space.in_order(p, q)) return;
  const auto clearance_m = space.clearance_m(p, q);
  if (clearance_m) roadmap.edges.push_back({from, to, {}, space.length_m(p, q), *clearance_m});
}

void check(const VisibilityPrmOptions& options) {
  const auto refuse = [](const std::string& value, const char* range) {
    throw std::invalid_argument("VisibilityPrmOptions: " + value + ": expected " + range);
  };
  if (options.samples < 0) refuse("samples = " + std::to_string(options.samples), "at least 0");
  if (!(options.reach_m > 0.0) || !std::isfinite(options.reach_m)) {
    refuse("reach_m = " + std::to_string(options.reach_m), "a finite value above 0");
  }
}

}  // namespace

template <int D>
Roadmap<D> visibility_prm(const SampledSpace<D>& space, const PointOf<D>& start,
                          const PointOf<D>& goal, const VisibilityPrmOptions& options,
                          const std::vector<PointOf<D>>& first) {
  check(options);
  Roadmap<D> roadmap;
  const auto add_node = [&](const PointOf<D>& p) {
    roadmap.nodes.push_back({p, space.clearance_m(p).value_or(0.0)});
  };
  add_node(start);
  add_node(goal);
  join(Roadmap<D>::kStart, Roadmap<D>::kGoal, space, roadmap);
  if (start == goal || !start.allFinite() || !goal.allFinite()) return roadmap;

  Sampler<D> sampler(space, {start, goal}, options);
  for (const PointOf<D>& place : first) {
    if (options.should_stop()) break;
    if (space.clearance_m(place)) sampler.add(place);
  }
  for (int i = 0; i < options.samples && !options.should_stop(); ++i) sampler.draw();

  const std::vector<PointOf<D>> nodes = sampler.nodes();
  for (int i = Roadmap<D>::kGoal + 1; i < static_cast<int>(nodes.size()); ++i) {
    add_node(nodes[i]);
    for (int other : within<D>(options.reach_m, nodes[i], nodes)) {
      if (other < i) join(other, i, space, roadmap);
    }
  }
  return roadmap;
}

template Roadmap<2> visibility_prm(const SampledSpace<2>&, const Eigen::Vector2d&,
                                   const Eigen::Vector2d&, const VisibilityPrmOptions&,
                                   const std::vector<Eigen::Vector2d>&);
template Roadmap<3> visibility_prm(const SampledSpace<3>&, const Eigen::Vector3d&,
                                   const Eigen::Vector3d&, const VisibilityPrmOptions&,
                                   const std::vector<Eigen::Vector3d>&);
template Roadmap<4> visibility_prm(const SampledSpace<4>&, const Eigen::Vector4d&,
                                   const Eigen::Vector4d&, const VisibilityPrmOptions&,
                                   const std::vector<Eigen::Vector4d>&);

}  // namespace mocha
