#include "simulation/pseudo_terminal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <system_error>

namespace mocha {
namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

void make_link(const std::string& path, const std::string& link) {
  struct stat status {};
  if (::lstat(link.c_str(), &status) == 0) {
    if (!S_ISLNK(status.st_mode)) {
      errno = EEXIST;
      fail(link);
    }
    ::unlink(link.c_str());  // of a former one
  }
  if (::symlink(path.c_str(), link.c_str()) != 0) fail(link);
}

}  // namespace

PseudoTerminal::PseudoTerminal(const std::string& link) {
  device_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (device_ < 0 || ::grantpt(device_) != 0 || ::unlockpt(device_) != 0) fail("pseudo-terminal");
  std::array<char, 128> name{};
  if (::ptsname_r(device_, name.data(), name.size()) != 0) fail("pseudo-terminal");
  path_ = name.data();
  computer_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (computer_ < 0) fail(path_);
  termios options{};
  ::tcgetattr(computer_, &options);
  ::cfmakeraw(&options);  // bytes as they are, before the other end is opened
  ::tcsetattr(computer_, TCSANOW, &options);
  if (link.empty()) return;
  make_link(path_, link);
  link_ = link;
}

PseudoTerminal::~PseudoTerminal() {
  if (!link_.empty()) ::unlink(link_.c_str());
  ::close(computer_);
  ::close(device_);
}

std::string PseudoTerminal::read() {
  std::string text;
  std::array<char, 4096> bytes;
  for (ssize_t count = 0; (count = ::read(device_, bytes.data(), bytes.size())) > 0;)
    text.append(bytes.data(), static_cast<std::size_t>(count));
  return text;
}

void PseudoTerminal::write(const std::string& text) {
  std::size_t sent = 0;
  while (sent < text.size()) {
    const ssize_t count = ::write(device_, text.data() + sent, text.size() - sent);
    if (count <= 0) return;
    sent += static_cast<std::size_t>(count);
  }
}

}  // namespace mocha
