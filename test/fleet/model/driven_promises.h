#pragma once

#include <algorithm>
#include <vector>

#include "fleet/protocol/reservation_chain.h"

namespace mocha {
class ProtocolFingerprint;
}

namespace mocha::test {

/// When and how a promise became binding.
struct Binding {
  TrajectoryId id;
  double time_s;   ///< by the robot's own clock
  unsigned asked;  ///< bit i: robot i was in reach then, had to agree, and remembers
  bool emergency;
};

/// What the tracker of one robot drives, whatever its broadcaster remembers: the promises of all
/// its epochs, by its own clock.
class DrivenPromises {
 public:
  void bind(const CommittedTrajectory& trajectory, double now_s, unsigned asked) {
    const bool emergency = trajectory.state == TrajectoryState::kEmergency;
    chain_.bind(trajectory);
    bindings_.push_back({trajectory.id, now_s, asked, emergency});
    forget();
  }
  /// Robot i has been started anew.
  void forgotten_by(int i) {
    for (Binding& each : bindings_) each.asked &= ~(1u << i);
  }
  void prune(double now_s) {
    chain_.prune(now_s);
    forget();
  }

  const ReservationChain& chain() const { return chain_; }
  const Binding& binding(TrajectoryId id) const {
    return *std::find_if(bindings_.begin(), bindings_.end(),
                         [id](const Binding& each) { return each.id == id; });
  }

 private:
  friend class mocha::ProtocolFingerprint;

  void forget() {
    const auto gone = [this](const Binding& each) {
      for (const Reservation& reservation : chain_.reservations()) {
        if (reservation.trajectory.id == each.id) return false;
      }
      return true;
    };
    bindings_.erase(std::remove_if(bindings_.begin(), bindings_.end(), gone), bindings_.end());
  }

  ReservationChain chain_;
  std::vector<Binding> bindings_;  // of the chain's reservations, in its order
};

}  // namespace mocha::test
