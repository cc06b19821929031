#pragma once

#include <string>

namespace mocha {

/// The device's end of a serial line made of software; the computer opens the other one by its
/// path. Nothing here waits.
class PseudoTerminal {
 public:
  /// Opens a line, and makes `link` (where it is not empty) a symbolic link to the computer's end:
  /// a name that stays the same. Throws std::system_error; also where `link` is no link but
  /// something else.
  explicit PseudoTerminal(const std::string& link);
  /// Pulls the line and removes the link.
  ~PseudoTerminal();
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  /// Of the computer's end: /dev/pts/N.
  const std::string& path() const { return path_; }

  /// What has come from the computer.
  std::string read();

  /// Text that does not fit into the line, as it is not read, is lost, as it is on a wire.
  void write(const std::string& text);

 private:
  int device_ = -1;
  int computer_ = -1;  // kept open, so that the line stands while no computer is there
  std::string path_;
  std::string link_;
};

}  // namespace mocha
