#pragma once

#include <ros/datatypes.h>

#include <string>

namespace mocha {

/// What ros::init() makes of a program's arguments such as `__name:=scout`.
ros::M_string remappings_of(int argc, const char* const* argv);

/// The full name that a node has with these remappings: `/ugv1/perception`.
std::string full_name(const ros::M_string& remappings, const std::string& program);

/// Where the node of that name is that lives, as its URI; empty where there is none: one that has
/// died without a word is still known to the master, but does not answer. A node that registered
/// under its name would end it. Asks the master of these remappings; needs no ros::init().
std::string name_holder(const ros::M_string& remappings, const std::string& name);

}  // namespace mocha
