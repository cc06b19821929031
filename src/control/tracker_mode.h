#pragma once

namespace mocha {

/// What the tracker does with the wheels.
enum class TrackerMode {
  kIdle,          ///< nothing was committed, ever or since an emergency stop: zero
  kTracking,      ///< follows the committed motion
  kBraking,       ///< the lease expired: stops along the path
  kErrorBraking,  ///< too far off, or blind without a lease: stops along the actual heading and
                  ///< stays
  kStale,         ///< the pose is too old: stops without feedback
  kHolding,       ///< stands at the end of the motion
  kEmergency,     ///< emergency stop: stops as hard as the wheels can and stays, whatever comes
};

enum class TrackerEvent {
  kAdopted,       ///< a new committed motion that fits the actual pose was taken up
  kLeaseExpired,  ///< while the motion moves
  kStrayed,       ///< the tracking error is beyond its bound
  kPoseLost,
  kPoseBack,
  kArrived,  ///< the motion has ended
  kStopped,  ///< emergency stop
  kReset,    ///< of that
};

/// The transition table. An event without an entry changes nothing.
TrackerMode next_mode(TrackerMode mode, TrackerEvent event);

/// For people: "tracking", "braking along the path" ...
const char* to_text(TrackerMode mode);

}  // namespace mocha
