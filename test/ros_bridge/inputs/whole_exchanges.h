#pragma once

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

#include "simulation/pseudo_terminal.h"

namespace mocha {

/// Waits for what the kernel carries; the time-out only bounds a failure.
template <typename Condition>
void wait_until(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("no bytes come");
    std::this_thread::yield();
  }
}

/// A serial line of software that hands over only whole exchanges.
class Line {
 public:
  explicit Line(const std::string& link)
      : terminal_(link), computer_(::open(terminal_.path().c_str(), O_RDWR | O_NOCTTY)) {}
  ~Line() { ::close(computer_); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;

  /// All that the driver has sent: what comes before a mark that is sent after it.
  std::string read() {
    constexpr char kMark = '\x01';
    if (::write(computer_, &kMark, 1) != 1) throw std::runtime_error("the line takes no mark");
    std::string text;
    wait_until([&] {
      text += terminal_.read();
      return !text.empty() && text.back() == kMark;
    });
    text.pop_back();
    return text;
  }

  /// Returns once the driver can read it.
  void write(const std::string& text) {
    terminal_.write(text);
    wait_until([&] {
      int arrived = 0;
      return ::ioctl(computer_, FIONREAD, &arrived) == 0 &&
             arrived >= static_cast<int>(text.size());
    });
  }

 private:
  PseudoTerminal terminal_;
  int computer_;
};

}  // namespace mocha
