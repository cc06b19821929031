#include "python/config_directory.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace mocha {

std::string config_directory() {
  Dl_info self;
  if (dladdr(reinterpret_cast<const void*>(&config_directory), &self) == 0)
    throw std::runtime_error("the module mocha_planner does not find its own file");
  const auto module = std::filesystem::absolute(self.dli_fname);
  return (module.parent_path() / MOCHA_CONFIG_FROM_MODULE).lexically_normal();
}

}  // namespace mocha
