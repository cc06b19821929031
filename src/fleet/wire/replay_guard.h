#pragma once

#include <cstdint>

namespace mocha {

/// Takes each of a sender's datagrams once, and none that is much older than the newest: a
/// recording played again changes nothing. Knows how many got lost, too.
class ReplayGuard {
 public:
  /// So many numbers behind the newest one, a datagram that comes late is still taken.
  static constexpr std::uint32_t kWindow = 64;

  /// False for what came before (or is too old to tell). A higher epoch begins anew.
  bool take(std::uint32_t epoch, std::uint32_t number);

  /// Of an epoch before the one that is known.
  bool is_past(std::uint32_t epoch) const { return epoch < epoch_; }

  /// Share of the newest datagrams (up to kWindow) that have not come.
  double loss() const;

 private:
  std::uint32_t epoch_ = 0;
  std::uint32_t newest_ = 0;
  std::uint32_t watched_ = 0;  // numbers up to the newest, since the first one, up to kWindow
  std::uint64_t came_ = 0;     // bit i: the one that is i before the newest
};

}  // namespace mocha
