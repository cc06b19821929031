#include "base/serial_port.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

namespace mocha {
namespace {

namespace fs = std::filesystem;

/// The other end of a line, found by a link that stays the same, as udev makes them.
class Device {
 public:
  explicit Device(const fs::path& link) : link_(link) {
    fd_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    ::grantpt(fd_);
    ::unlockpt(fd_);
    fs::remove(link_);
    fs::create_symlink(::ptsname(fd_), link_);
  }
  ~Device() {
    fs::remove(link_);
    ::close(fd_);
  }

  void send(const std::string& text) {
    ASSERT_EQ(::write(fd_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  std::string receive() {
    std::string text(1 << 16, '\0');
    const ssize_t count = ::read(fd_, text.data(), text.size());
    text.resize(count > 0 ? count : 0);
    return text;
  }

 private:
  fs::path link_;
  int fd_;
};

class SerialPortTest : public testing::Test {
 protected:
  const fs::path link_ = fs::temp_directory_path() / ("mocha_port_" + std::to_string(::getpid()));
};

TEST_F(SerialPortTest, CarriesBytesAsTheyAre) {
  Device device(link_);
  SerialPort port(link_.string(), 115200);
  EXPECT_FALSE(port.is_open());
  ASSERT_TRUE(port.poll(0.0)) << port.fault();
  EXPECT_EQ(port.read(), "");
  const std::string bytes("a\r\n\0\x03\x11\x7f\xffz", 9);
  device.send(bytes);
  EXPECT_EQ(port.read(), bytes);
  EXPECT_TRUE(port.write(bytes));
  EXPECT_EQ(device.receive(), bytes);
  EXPECT_EQ(port.fault(), "");
}

TEST_F(SerialPortTest, TriesAMissingDeviceEverMoreRarely) {
  SerialPort port(link_.string(), 115200);
  const auto opened_after = [&](double absent_s, double from_s) {
    double t = from_s;
    for (; t < from_s + absent_s; t += 0.01) EXPECT_FALSE(port.poll(t));
    const Device device(link_);
    const double there_s = t;
    while (!port.poll(t) && t < from_s + 100.0) t += 0.01;
    return t - there_s;
  };
  SerialPort other(link_.string(), 115200);
  EXPECT_FALSE(other.poll(0.0));
  EXPECT_NE(other.fault().find("No such file"), std::string::npos) << other.fault();
  EXPECT_NE(other.fault().find(link_.string()), std::string::npos);
  const double late_s = opened_after(20.05, 0.0);
  EXPECT_GT(late_s, 0.2);  // rarely by then
  EXPECT_LT(late_s, 2.02);
}

TEST_F(SerialPortTest, AClockThatIsSetBackDoesNotKeepItFromTrying) {
  SerialPort port(link_.string(), 115200);
  for (double t = 1000.0; t < 1010.0; t += 0.01) EXPECT_FALSE(port.poll(t));
  const Device device(link_);
  EXPECT_TRUE(port.poll(5.0));
}

TEST_F(SerialPortTest, APulledLineIsNoticedAndOpenedAgain) {
  auto device = std::make_unique<Device>(link_);
  SerialPort port(link_.string(), 115200);
  ASSERT_TRUE(port.poll(0.0));
  device->send("x");
  EXPECT_EQ(port.read(), "x");
  device.reset();
  EXPECT_EQ(port.read(), "");
  EXPECT_FALSE(port.is_open());
  EXPECT_FALSE(port.write("lost\n"));
  EXPECT_EQ(port.losses(), 1);
  EXPECT_FALSE(port.poll(0.02));  // tried
  EXPECT_FALSE(port.poll(0.04));
  device = std::make_unique<Device>(link_);
  EXPECT_FALSE(port.poll(0.06));  // not yet tried again
  EXPECT_TRUE(port.poll(0.2));
  EXPECT_TRUE(port.write("back\n"));
  EXPECT_EQ(device->receive(), "back\n");
}

TEST_F(SerialPortTest, APulledLineIsNoticedWhenWritingToo) {
  auto device = std::make_unique<Device>(link_);
  SerialPort port(link_.string(), 115200);
  ASSERT_TRUE(port.poll(0.0));
  device.reset();
  EXPECT_FALSE(port.write("lost\n"));
  EXPECT_FALSE(port.is_open());
}

TEST_F(SerialPortTest, BeforeADeviceThatDoesNotListenLinesAreDroppedWhole) {
  Device device(link_);
  SerialPort port(link_.string(), 115200);
  ASSERT_TRUE(port.poll(0.0));
  int sent = 0;
  int dropped = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string line = "line " + std::to_string(i) + " of some length\n";
    const bool taken = port.write(line);
    (taken ? sent : dropped) += 1;
  }
  EXPECT_GT(sent, 0);
  EXPECT_GT(dropped, 0);
  std::string received = device.receive();
  for (int i = 0; i < 10; ++i) {
    port.write("end\n");
    received += device.receive();
  }
  EXPECT_NE(received.find("\nend\n"), std::string::npos);
  std::size_t at = 0;
  for (std::size_t end = 0; (end = received.find('\n', at)) != std::string::npos; at = end + 1) {
    const std::string line = received.substr(at, end - at);
    const bool whole = line == "end" || (line.rfind("line ", 0) == 0 &&
                                         line.find(" of some length") == line.size() - 15);
    EXPECT_TRUE(whole) << line;
  }
}

}  // namespace
}  // namespace mocha
