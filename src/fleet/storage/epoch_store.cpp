#include "fleet/storage/epoch_store.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "fleet/storage/durable_file.h"

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

void write_epoch(const std::string& path, std::uint32_t epoch) {
  try {
    write_durably(path, std::to_string(epoch) + "\n");
  } catch (const std::runtime_error& error) {
    fail(path, error.what());
  }
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
