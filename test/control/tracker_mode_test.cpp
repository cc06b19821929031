#include "control/tracker_mode.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace mocha {
namespace {

using M = TrackerMode;
using E = TrackerEvent;

constexpr M kModes[] = {M::kIdle,  M::kTracking, M::kBraking,  M::kErrorBraking,
                        M::kStale, M::kHolding,  M::kEmergency};
constexpr E kEvents[] = {E::kAdopted,  E::kLeaseExpired, E::kStrayed, E::kPoseLost,
                         E::kPoseBack, E::kArrived,      E::kStopped, E::kReset};

/// One row a mode, one column an event in the order of kEvents.
const std::map<M, std::vector<M>> kTable = {
    {M::kIdle,
     {M::kTracking, M::kIdle, M::kIdle, M::kIdle, M::kIdle, M::kIdle, M::kEmergency, M::kIdle}},
    {M::kTracking,
     {M::kTracking, M::kBraking, M::kErrorBraking, M::kStale, M::kTracking, M::kHolding,
      M::kEmergency, M::kTracking}},
    {M::kBraking,
     {M::kTracking, M::kBraking, M::kErrorBraking, M::kStale, M::kBraking, M::kHolding,
      M::kEmergency, M::kBraking}},
    {M::kErrorBraking,
     {M::kTracking, M::kErrorBraking, M::kErrorBraking, M::kErrorBraking, M::kErrorBraking,
      M::kErrorBraking, M::kEmergency, M::kErrorBraking}},
    {M::kStale,
     {M::kStale, M::kErrorBraking, M::kStale, M::kStale, M::kTracking, M::kStale, M::kEmergency,
      M::kStale}},
    {M::kHolding,
     {M::kTracking, M::kHolding, M::kErrorBraking, M::kStale, M::kHolding, M::kHolding,
      M::kEmergency, M::kHolding}},
    {M::kEmergency,
     {M::kEmergency, M::kEmergency, M::kEmergency, M::kEmergency, M::kEmergency, M::kEmergency,
      M::kEmergency, M::kIdle}},
};

TEST(TrackerMode, FollowsTheTable) {
  for (const M mode : kModes) {
    for (std::size_t i = 0; i < std::size(kEvents); ++i) {
      EXPECT_EQ(next_mode(mode, kEvents[i]), kTable.at(mode)[i])
          << to_text(mode) << ", event " << i;
    }
  }
}

TEST(TrackerMode, OnlyANewMotionEndsAStopOffThePath) {
  for (const E event : kEvents) {
    if (event == E::kStopped) continue;  // which stays more strictly
    EXPECT_EQ(next_mode(M::kErrorBraking, event) != M::kErrorBraking, event == E::kAdopted);
  }
}

TEST(TrackerMode, AnEmergencyStopGoesBeforeEverythingAndOnlyItsResetEndsIt) {
  for (const M mode : kModes) EXPECT_EQ(next_mode(mode, E::kStopped), M::kEmergency);
  for (const E event : kEvents)
    EXPECT_EQ(next_mode(M::kEmergency, event) != M::kEmergency, event == E::kReset);
}

}  // namespace
}  // namespace mocha
