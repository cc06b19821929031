#pragma once

#include <ros/datatypes.h>
#include <ros/duration.h>

#include <cstdint>
#include <functional>
#include <string>

namespace mocha {

/// How a node begins, and what it does where it cannot: it says why, in one line. Started by hand
/// it then ends with exit status 1. roslaunch would start it again and again: there it stays
/// without doing anything until it is ended, and says the same as an error in /diagnostics.
///
/// A node takes its name only if no other node that lives has it, which would be ended by that.
/// One that stays for that reason ends, to be started anew, as soon as the name is free; one that
/// misses what may come later, after a while.
class NodeStart {
 public:
  enum class Fault { kStays, kEnds };  ///< where roslaunch has started it

  /// Takes the place of ros::init(). To be called before anything else of ROS.
  NodeStart(int argc, char** argv, const std::string& program, std::uint32_t options = 0,
            Fault fault = Fault::kStays);

  /// Makes the node, and has it work. Returns the exit status. What `make` throws cannot be mended
  /// by another start; after what `work` throws the node ends in any case. `is_ended` says whether
  /// a node that stays is to end.
  int run(
      const std::function<void()>& make, const std::function<void()>& work,
      const std::function<bool()>& is_ended = [] { return false; }) const;

 private:
  int refuse(const std::string& why, const std::function<bool()>& is_over) const;
  std::string holder() const;

  const std::string program_;
  const ros::M_string remappings_;
  const std::string name_;
  const std::string holder_;  // of the name, at the start
  const bool stays_;
};

}  // namespace mocha
