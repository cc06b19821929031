#pragma once

#include <cstdint>
#include <string>

namespace mocha {

/// The number of this start: one more than the file says (1 where there is none), written back
/// before it is returned, by an atomic replacement that survives a loss of power. Missing folders
/// are made. Throws std::runtime_error, naming the file, the trouble and the remedy, if the file
/// cannot be read or written or holds anything but a number: a robot that guessed an old number
/// would not be heard by its peers.
std::uint32_t next_epoch(const std::string& path);

/// Makes the file say at least `epoch`, so that the next start is a later one. Throws likewise.
void raise_epoch(const std::string& path, std::uint32_t epoch);

}  // namespace mocha
