#include "fleet/storage/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace mocha {
namespace {

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

/// What a folder holds; where the file system cannot do that, it need not.
void flush_folder(const std::string& path) {
  const int folder = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

}  // namespace

void write_durably(const std::string& path, const std::string& text) {
  std::error_code error;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, error);
  if (error) throw std::runtime_error("its folder cannot be made (" + error.message() + ")");
  const std::string fresh = path + ".new";
  if (!write_through(fresh, text)) {
    throw std::runtime_error(std::string("cannot be written (") + std::strerror(errno) + ")");
  }
  std::filesystem::rename(fresh, path, error);
  if (error) throw std::runtime_error("cannot be replaced (" + error.message() + ")");
  flush_folder(folder.empty() ? "." : folder.string());
}

}  // namespace mocha
