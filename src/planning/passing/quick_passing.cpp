#include "planning/passing/quick_passing.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>

#include "planning/passing/partial_search.h"
#include "planning/passing/passing_order.h"

namespace mocha {
namespace {

constexpr int kMostAtOnce = 3;  // robots
constexpr int kChoicesAtOnce = 10000;
constexpr double kQuicker_s = 1e-6;

class Quickening {
 public:
  Quickening(const PassingProblem& problem, std::vector<JointStep> sequence,
             const PassingPace& pace, int left, const std::function<bool()>& should_stop)
      : problem_(problem),
        pace_(pace),
        should_stop_(should_stop),
        search_(problem),
        sequence_(std::move(sequence)),
        takes_s_(duration(sequence_)),
        left_(left) {}

  std::vector<JointStep> run() {
    while (goes_on()) {
      one_by_one();
      for (int count = 2; count <= kMostAtOnce && goes_on(); ++count) some_together(count);
    }
    return std::move(sequence_);
  }

 private:
  double duration(const std::vector<JointStep>& sequence) const {
    return duration_s(order_of(sequence, problem_.robots()), pace_);
  }

  bool goes_on() const { return left_ > 0 && !should_stop_(); }

  /// Until none can do better.
  void one_by_one() {
    for (double before_s = takes_s_ + 1.0; takes_s_ < before_s - kQuicker_s && goes_on();) {
      before_s = takes_s_;
      for (int robot = 0; robot < problem_.robots() && goes_on(); ++robot) find_anew({robot});
    }
  }

  /// So many at once, until it helps.
  void some_together(int count) {
    std::vector<int> robots(problem_.robots());
    std::iota(robots.begin(), robots.end(), 0);
    count = std::min(count, problem_.robots());
    const double before_s = takes_s_;
    for (int round = 0; round < 2 * problem_.robots() && goes_on(); ++round) {
      for (int i = 0; i < count; ++i)
        std::swap(robots[i], robots[i + random_() % (robots.size() - i)]);
      find_anew({robots.begin(), robots.begin() + count});
      if (takes_s_ < before_s - kQuicker_s) return;
    }
  }

  void find_anew(const std::vector<int>& robots) {
    const int most = std::min(left_, kChoicesAtOnce);
    int left = most;
    auto found = search_.run(sequence_, robots, variant_++, left, should_stop_);
    left_ -= std::max(1, most - left);
    if (found.outcome != PassingSequence::Outcome::kFound) return;
    const double takes_s = duration(found.steps);
    if (takes_s > takes_s_) return;
    takes_s_ = takes_s;
    sequence_ = std::move(found.steps);
  }

  const PassingProblem& problem_;
  const PassingPace pace_;
  const std::function<bool()>& should_stop_;
  const PartialSearch search_;
  std::vector<JointStep> sequence_;
  double takes_s_;
  int left_;
  std::mt19937 random_{1};
  std::uint32_t variant_ = 0;
};

}  // namespace

std::vector<JointStep> quickened(const PassingProblem& problem, std::vector<JointStep> sequence,
                                 const PassingPace& pace, int left,
                                 const std::function<bool()>& should_stop) {
  return Quickening(problem, std::move(sequence), pace, left, should_stop).run();
}

}  // namespace mocha
