# For find_package(mocha_ugv): the target mocha_ugv::core, and mocha_ugv_CONFIG_DIRECTORY with parameters and robots. CMake finds this file
# before what catkin makes for the package (messages), which catkin projects get as well.
include(CMakeFindDependencyMacro)
foreach(dependency Eigen3 octomap TBB yaml-cpp)
  find_dependency(${dependency} CONFIG)
endforeach()
find_dependency(PNG)
if(NOT TARGET mocha_ugv::core)  # in a workspace, catkin_make may be building it
  include(${CMAKE_CURRENT_LIST_DIR}/mocha_ugvTargets.cmake)
endif()
get_filename_component(mocha_ugv_PREFIX ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set(mocha_ugv_CONFIG_DIRECTORY ${mocha_ugv_PREFIX}/share/mocha_ugv/config)
if(catkin_FOUND_CATKIN_PROJECT)
  set(mocha_ugv_DIR ${mocha_ugv_PREFIX}/share/mocha_ugv/cmake)
  include(${mocha_ugv_DIR}/mocha_ugvConfig.cmake)
endif()
