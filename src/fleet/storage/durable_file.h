#pragma once

#include <string>

namespace mocha {

/// Replaces the file by `text`, all of it or nothing, so that it survives a loss of power from the
/// return of this call on. Missing folders are made. Throws std::runtime_error, saying what is the
/// trouble, but not with which file.
void write_durably(const std::string& path, const std::string& text);

}  // namespace mocha
