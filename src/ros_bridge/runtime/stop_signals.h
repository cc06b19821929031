#pragma once

#include <csignal>

namespace mocha {

/// SIGINT and SIGTERM, which no longer end the process but wait until they are asked for. To be
/// made before there are other threads, which then leave these signals alone, too.
class StopSignals {
 public:
  StopSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
  }

  /// Whether one has come.
  bool came() const {
    sigset_t waiting;
    sigpending(&waiting);
    return sigismember(&waiting, SIGINT) == 1 || sigismember(&waiting, SIGTERM) == 1;
  }

 private:
  sigset_t signals_;
};

}  // namespace mocha
