#include "python/signal_watch.h"

#include <pybind11/pybind11.h>

#include "python/steady_now.h"

namespace mocha {

bool SignalWatch::has_raised() {
  constexpr double kPeriod_s = 0.05;
  if (raised_ || std::this_thread::get_id() != owner_ || steady_now_s() < next_s_) return raised_;
  const pybind11::gil_scoped_acquire python;
  raised_ = PyErr_CheckSignals() != 0;
  next_s_ = steady_now_s() + kPeriod_s;
  return raised_;
}

void SignalWatch::rethrow() const {
  if (raised_) throw pybind11::error_already_set();
}

}  // namespace mocha
