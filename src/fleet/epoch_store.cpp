#include "fleet/epoch_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace mocha {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& trouble) {
  throw std::runtime_error("epoch file " + path + ": " + trouble +
                           ". It counts the starts of this robot; correct it, or write a number "
                           "above the last epoch that its peers have seen, or set epoch_file");
}

std::uint32_t read_epoch(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    if (error) fail(path, "cannot be read (" + error.message() + ")");
    return 0;
  }
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file || !text) fail(path, "cannot be read");
  long long epoch = -1;
  std::string rest;
  if (!(text >> epoch) || text >> rest || epoch < 0) fail(path, "does not hold just a number");
  if (epoch >= std::numeric_limits<std::uint32_t>::max()) fail(path, "the number is too large");
  return static_cast<std::uint32_t>(epoch);
}

/// Writes and flushes to the disk; false with errno set where that fails.
bool write_through(const std::string& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) return false;
  const bool written =
      ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fsync(file) == 0;
  const int trouble = errno;
  ::close(file);
  errno = trouble;
  return written;
}

void write_epoch(const std::string& path, std::uint32_t epoch) {
  std::error_code error;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) fail(path, "its folder cannot be made (" + error.message() + ")");
  const std::string fresh = path + ".new";
  if (!write_through(fresh, std::to_string(epoch) + "\n")) {
    fail(path, std::string("cannot be written (") + std::strerror(errno) + ")");
  }
  std::filesystem::rename(fresh, path, error);
  if (error) fail(path, "cannot be replaced (" + error.message() + ")");
}

}  // namespace

std::uint32_t next_epoch(const std::string& path) {
  const std::uint32_t epoch = read_epoch(path) + 1;
  write_epoch(path, epoch);
  return epoch;
}

void raise_epoch(const std::string& path, std::uint32_t epoch) {
  if (read_epoch(path) < epoch) write_epoch(path, epoch);
}

}  // namespace mocha
