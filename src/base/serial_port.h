#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/serial_port.hpp>
#include <string>

namespace mocha {

/// A serial line that may be pulled at any time. Nothing here waits: what cannot be read or written
/// at once is not.
///
/// A line that is lost is closed, and opened again by poll() once it is back: tried at once, then
/// after 0.1 s, then ever more rarely down to every 2 s.
class SerialPort {
 public:
  /// `device` such as /dev/ttyAMA0; 8 bits, no parity, one stop bit, no flow control.
  SerialPort(std::string device, int baud);

  /// Opens what is not open, if it is time to try. True where it has just been opened.
  bool poll(double now_s);

  bool is_open() const { return port_.is_open(); }

  /// What has come; closes the port where it is gone.
  std::string read();

  /// Sends `text` whole, later calls carrying on with its rest; false, and nothing of it, while
  /// there is a rest of another one, or no line. So a line never gets into another, and no old
  /// lines pile up before a device that does not listen.
  bool write(const std::string& text);

  const std::string& device() const { return device_; }
  /// Why it is not open, in words; empty where it is.
  const std::string& fault() const { return fault_; }
  int losses() const { return losses_; }

 private:
  void open(double now_s);
  void lose(const std::string& why);
  bool send_rest();

  std::string device_;
  int baud_;
  boost::asio::io_context context_;
  boost::asio::serial_port port_;
  std::string rest_;  // of a text that went out in part
  std::string fault_ = "not opened yet";
  int losses_ = 0;
  double tried_s_;
  double pause_s_ = 0.0;  // from one try to the next
};

}  // namespace mocha
