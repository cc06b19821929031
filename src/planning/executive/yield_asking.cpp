#include "planning/executive/yield_asking.h"

#include <utility>

namespace mocha {
namespace {

constexpr double kPatience_s = 1.5;  // of standing, before the first request
constexpr double kAgain_s = 0.5;
constexpr double kNobodyNear_s = 3.0;  // until the request ends

}  // namespace

bool YieldAsking::due(double now_s, bool rests) {
  if (!rests) stands_since_s_.reset();
  if (rests && !stands_since_s_) stands_since_s_ = now_s;
  const bool stood_long = stands_since_s_ && now_s >= *stands_since_s_ + kPatience_s;
  return (asks_ || stood_long) && now_s >= looked_s_ + kAgain_s;
}

bool YieldAsking::look(double now_s, bool on_it, bool near_it) {
  looked_s_ = now_s;
  if (near_it) near_s_ = now_s;
  if (asks_ && now_s > near_s_ + kNobodyNear_s) {
    stop();
  } else if (on_it) {
    asks_ = true;
    withdraws_ = false;
  }
  return asks_;
}

void YieldAsking::stop() {
  withdraws_ = withdraws_ || asks_;
  asks_ = false;
  stands_since_s_.reset();
}

bool YieldAsking::take_withdrawal() { return std::exchange(withdraws_, false); }

}  // namespace mocha
