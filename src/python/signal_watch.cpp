#include "python/signal_watch.h"

#include <pybind11/pybind11.h>

namespace mocha {

bool SignalWatch::has_raised() {
  constexpr std::chrono::milliseconds kPeriod(50);
  if (raised_ || std::this_thread::get_id() != owner_ || Clock::now() < next_) return raised_;
  const pybind11::gil_scoped_acquire python;
  raised_ = PyErr_CheckSignals() != 0;
  next_ = Clock::now() + kPeriod;
  return raised_;
}

void SignalWatch::rethrow() const {
  if (raised_) throw pybind11::error_already_set();
}

}  // namespace mocha
