#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace mocha {

/// Which of the grids and updates of a map count, and in what order.
///
/// The two come by different ways, each in order, but either may be ahead. What puts them together
/// are their stamps, which rise from one publication to the next: a grid contains what is not newer
/// than it, and updates that follow a grid which is only announced (by one without cells) wait for
/// it. Where an update is missing or refused, or the stamps fall, a whole grid is asked for anew,
/// and nothing counts until that comes. The first update asks for a grid, too, as earlier ones may
/// have been missed; updates count in the meantime, as a recording has no other grid to give.
template <typename Update>
class MapOrder {
 public:
  using Stamp = std::uint64_t;  // [ns]

  struct Stamped {
    Stamp stamp_ns;
    bool announces_grid;  ///< with this stamp, and has no cells of its own
    Update update;
  };

  /// `ask_for_grid` asks for a whole grid that is newer than all that came before.
  explicit MapOrder(std::function<void()> ask_for_grid) : ask_for_grid_(std::move(ask_for_grid)) {}

  /// Asks for a grid where the updates, which are numbered, show a gap.
  void hear(std::uint32_t number, Stamp stamp_ns) {
    const auto before = std::exchange(heard_, Heard{number, stamp_ns});
    if (!before) {
      ask();
    } else if (number != before->number + 1 || stamp_ns < before->stamp_ns) {
      start_over();
    }
  }

  /// Whether an update counts now. One that may follow a grid which is still to come is kept.
  bool admits(const Stamped& update) {
    if (awaited_ns_ || is_asked_for_) kept_.push_back(update);
    if (kept_.size() > kMostKept) ask();
    if (awaited_ns_ || update.stamp_ns <= grid_ns_) return false;
    if (update.announces_grid) awaited_ns_ = update.stamp_ns;
    return !update.announces_grid;
  }

  /// Whether a grid counts: it is not older than the one that is waited for.
  bool admits_grid(Stamp stamp_ns) const { return stamp_ns >= awaited_ns_.value_or(0); }

  /// Goes on from a grid. Returns the updates that were kept, to be judged anew one by one.
  std::vector<Stamped> follow(Stamp grid_ns) {
    grid_ns_ = grid_ns;
    awaited_ns_.reset();
    is_asked_for_ = false;
    return std::exchange(kept_, {});
  }

  /// Asks for a grid, and waits for it: what has come cannot be gone on from.
  void start_over() {
    awaited_ns_ = 0;
    ask();
  }

 private:
  struct Heard {
    std::uint32_t number;
    Stamp stamp_ns;
  };

  static constexpr std::size_t kMostKept = 500;

  void ask() {
    is_asked_for_ = true;
    kept_.clear();
    if (ask_for_grid_) ask_for_grid_();
  }

  const std::function<void()> ask_for_grid_;
  Stamp grid_ns_ = 0;                    // of the newest grid
  std::optional<Stamp> awaited_ns_ = 0;  // of the oldest grid that may be gone on from
  bool is_asked_for_ = false;            // a grid
  std::vector<Stamped> kept_;            // that may follow it
  std::optional<Heard> heard_;           // of the newest update, admitted or not
};

}  // namespace mocha
