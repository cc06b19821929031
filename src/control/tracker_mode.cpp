#include "control/tracker_mode.h"

namespace mocha {
namespace {

struct Transition {
  TrackerMode from;
  TrackerEvent event;
  TrackerMode to;
};

using M = TrackerMode;
using E = TrackerEvent;

constexpr Transition kTransitions[] = {
    {M::kIdle, E::kAdopted, M::kTracking},

    {M::kTracking, E::kLeaseExpired, M::kBraking},
    {M::kTracking, E::kStrayed, M::kErrorBraking},
    {M::kTracking, E::kPoseLost, M::kStale},
    {M::kTracking, E::kArrived, M::kHolding},

    {M::kBraking, E::kAdopted, M::kTracking},
    {M::kBraking, E::kStrayed, M::kErrorBraking},
    {M::kBraking, E::kPoseLost, M::kStale},
    {M::kBraking, E::kArrived, M::kHolding},

    {M::kErrorBraking, E::kAdopted, M::kTracking},

    // Blind and without a lease, it has to stay where it stopped: the path is no longer promised
    // when the pose is back.
    {M::kStale, E::kLeaseExpired, M::kErrorBraking},
    {M::kStale, E::kPoseBack, M::kTracking},

    {M::kHolding, E::kAdopted, M::kTracking},
    {M::kHolding, E::kStrayed, M::kErrorBraking},
    {M::kHolding, E::kPoseLost, M::kStale},

    {M::kIdle, E::kStopped, M::kEmergency},
    {M::kTracking, E::kStopped, M::kEmergency},
    {M::kBraking, E::kStopped, M::kEmergency},
    {M::kErrorBraking, E::kStopped, M::kEmergency},
    {M::kStale, E::kStopped, M::kEmergency},
    {M::kHolding, E::kStopped, M::kEmergency},

    // What was committed before is not driven any more.
    {M::kEmergency, E::kReset, M::kIdle},
};

}  // namespace

TrackerMode next_mode(TrackerMode mode, TrackerEvent event) {
  for (const Transition& transition : kTransitions) {
    if (transition.from == mode && transition.event == event) return transition.to;
  }
  return mode;
}

const char* to_text(TrackerMode mode) {
  switch (mode) {
    case M::kIdle:
      return "idle, nothing to drive";
    case M::kTracking:
      return "tracking";
    case M::kBraking:
      return "braking along the path";
    case M::kErrorBraking:
      return "stopped off the path";
    case M::kStale:
      return "stopping without a pose";
    case M::kHolding:
      return "standing at the end";
    case M::kEmergency:
      return "emergency stop";
  }
  return "unknown";
}

}  // namespace mocha
