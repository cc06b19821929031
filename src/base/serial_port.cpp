#include "base/serial_port.h"

#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>
#include <utility>

namespace mocha {
namespace {

constexpr double kFirstPause_s = 0.1;
constexpr double kLongestPause_s = 2.0;
constexpr std::size_t kMostAtOnce =
    65536;  // bytes in one read(): a line that floods does not hold us

bool would_block() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

void configure(boost::asio::serial_port& port, int baud) {
  using boost::asio::serial_port_base;
  port.set_option(serial_port_base::baud_rate(static_cast<unsigned>(baud)));
  port.set_option(serial_port_base::character_size(8));
  port.set_option(serial_port_base::parity(serial_port_base::parity::none));
  port.set_option(serial_port_base::stop_bits(serial_port_base::stop_bits::one));
  port.set_option(serial_port_base::flow_control(serial_port_base::flow_control::none));
}

}  // namespace

SerialPort::SerialPort(std::string device, int baud)
    : device_(std::move(device)),
      baud_(baud),
      port_(context_),
      tried_s_(-std::numeric_limits<double>::infinity()) {}

bool SerialPort::poll(double now_s) {
  if (is_open()) return false;
  const bool set_back = now_s < tried_s_;
  if (!set_back && now_s - tried_s_ < pause_s_) return false;
  open(now_s);
  return is_open();
}

void SerialPort::open(double now_s) {
  tried_s_ = now_s;
  pause_s_ = std::clamp(2.0 * pause_s_, kFirstPause_s, kLongestPause_s);
  try {
    port_.open(device_);  // raw, and non-blocking
    configure(port_, baud_);
  } catch (const boost::system::system_error& error) {
    boost::system::error_code ignored;
    port_.close(ignored);
    fault_ = device_ + ": " + error.code().message();
    return;
  }
  ::tcflush(port_.native_handle(), TCIOFLUSH);  // what was sent to another program
  fault_.clear();
  rest_.clear();
}

void SerialPort::lose(const std::string& why) {
  boost::system::error_code ignored;
  port_.close(ignored);
  fault_ = device_ + ": " + why;
  ++losses_;
}

std::string SerialPort::read() {
  std::string text;
  std::array<char, 4096> bytes;
  while (is_open() && text.size() < kMostAtOnce) {
    const ssize_t count = ::read(port_.native_handle(), bytes.data(), bytes.size());
    if (count > 0) {
      text.append(bytes.data(), static_cast<std::size_t>(count));
      pause_s_ = 0.0;  // it is alive: when it is lost, the first try comes at once
    } else if (count == 0) {
      lose("the line was cut");
    } else if (would_block()) {
      break;
    } else {
      lose(std::strerror(errno));
    }
  }
  return text;
}

bool SerialPort::write(const std::string& text) {
  if (!send_rest()) return false;
  rest_ = text;
  send_rest();
  return is_open();
}

bool SerialPort::send_rest() {
  while (is_open() && !rest_.empty()) {
    const ssize_t count = ::write(port_.native_handle(), rest_.data(), rest_.size());
    if (count >= 0) {
      rest_.erase(0, static_cast<std::size_t>(count));
    } else if (would_block()) {
      return false;
    } else {
      lose(std::strerror(errno));
    }
  }
  return is_open();
}

}  // namespace mocha
