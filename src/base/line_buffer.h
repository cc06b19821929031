#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mocha {

/// Cuts a stream of bytes into lines. However long a line gets, it takes no more memory than the
/// limit: it is dropped up to its end, and counted.
class LineBuffer {
 public:
  explicit LineBuffer(std::size_t max_length) : max_length_(max_length) {}

  /// The lines that these bytes complete, without their ends (\n or \r\n); empty ones are left out.
  std::vector<std::string> add(std::string_view bytes);

  /// Drops what has come of a line: its rest will not come. Whether there was any.
  bool drop_partial();

  long overlong() const { return overlong_; }

 private:
  std::size_t max_length_;
  std::string partial_;
  bool dropping_ = false;  // an overlong line, up to its end
  long overlong_ = 0;
};

}  // namespace mocha
