#pragma once

#include <cstdint>
#include <map>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace mocha {

/// How a network treats each message to each receiver, independently of all others.
struct NetworkLink {
  double min_delay_s = 0.0;
  double max_delay_s = 0.01;  ///< delays are uniform between the two
  double loss = 0.0;          ///< probability
};

/// A network between numbered members that delays messages, loses some, and so reorders them: the
/// same for the same seed, on every machine. Time is an argument.
template <typename Message>
class LossyNetwork {
 public:
  struct Delivery {
    double due_s;
    int from;
    int to;
    Message message;
  };

  /// Throws std::invalid_argument for a link that cannot be.
  LossyNetwork(std::uint64_t seed, const NetworkLink& link) : random_(seed) { set_link(link); }

  /// For what is sent from now on. Throws like the constructor.
  void set_link(const NetworkLink& link) {
    const bool valid = link.min_delay_s >= 0.0 && link.max_delay_s >= link.min_delay_s &&
                       link.loss >= 0.0 && link.loss <= 1.0;
    if (!valid) {
      throw std::invalid_argument(
          "a network needs 0 <= min_delay <= max_delay and a loss of 0 to 1");
    }
    link_ = link;
  }
  const NetworkLink& link() const { return link_; }

  /// A member that is cut off neither sends nor receives; what is under way to it is lost.
  void cut_off(int member, bool off) { off_[member] = off; }

  /// From one member to all others of `members`, numbered from 0 on.
  void broadcast(int from, int members, const Message& message, double now_s) {
    for (int to = 0; to < members; ++to) {
      if (to != from) send(from, to, message, now_s);
    }
  }

  void send(int from, int to, const Message& message, double now_s) {
    const bool lost = draw() < link_.loss;
    const double delay_s = link_.min_delay_s + draw() * (link_.max_delay_s - link_.min_delay_s);
    if (lost || is_off(from)) return;
    const double due_s = now_s + delay_s;
    under_way_.emplace(due_s, Delivery{due_s, from, to, message});
  }

  /// What has arrived by now, in order of arrival.
  std::vector<Delivery> receive(double now_s) {
    std::vector<Delivery> arrived;
    const auto end = under_way_.upper_bound(now_s);
    for (auto each = under_way_.begin(); each != end; ++each) {
      if (!is_off(each->second.to)) arrived.push_back(std::move(each->second));
    }
    under_way_.erase(under_way_.begin(), end);
    return arrived;
  }

 private:
  bool is_off(int member) const {
    const auto found = off_.find(member);
    return found != off_.end() && found->second;
  }
  /// Uniform in [0, 1), the same with every standard library.
  double draw() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }

  NetworkLink link_;
  std::mt19937_64 random_;
  std::map<int, bool> off_;
  std::multimap<double, Delivery> under_way_;  // by time of arrival
};

}  // namespace mocha
