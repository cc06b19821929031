# The core for others: find_package(mocha_ugv) gives mocha_ugv::core, which is all folders of the core with their headers. In the devel space
# as in the install space, with ROS or without it.
add_library(mocha_core INTERFACE)
add_library(mocha_ugv::core ALIAS mocha_core)
set(devel ${CATKIN_DEVEL_PREFIX})
foreach(folder ${MOCHA_FOLDERS})
  # A shared library may be made of it.
  set_target_properties(mocha_${folder} PROPERTIES EXPORT_NAME ${folder} POSITION_INDEPENDENT_CODE ON)
  target_compile_options(mocha_${folder} PRIVATE -fno-semantic-interposition)
  target_link_libraries(mocha_core INTERFACE mocha_${folder})
  install(DIRECTORY src/${folder} DESTINATION ${CATKIN_PACKAGE_INCLUDE_DESTINATION} FILES_MATCHING PATTERN "*.h")
  install(TARGETS mocha_${folder} EXPORT mocha_ugv ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION})
endforeach()

# Headers are named <mocha_ugv/world/goal.h>, and name each other "world/goal.h". The link is not in devel/include, which catkin installs.
set(headers ${CMAKE_CURRENT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers} ${devel}/${CATKIN_PACKAGE_SHARE_DESTINATION})
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src ${headers}/${PROJECT_NAME} SYMBOLIC)
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/config ${devel}/${CATKIN_PACKAGE_SHARE_DESTINATION}/config SYMBOLIC)
target_include_directories(mocha_core INTERFACE $<BUILD_INTERFACE:${headers}>
  $<INSTALL_INTERFACE:${CATKIN_GLOBAL_INCLUDE_DESTINATION}> $<INSTALL_INTERFACE:${CATKIN_PACKAGE_INCLUDE_DESTINATION}>)
# What of the headers is compiled elsewhere computes the same numbers.
target_compile_options(mocha_core INTERFACE ${MOCHA_ARITHMETIC})
target_compile_features(mocha_core INTERFACE cxx_std_17)
set_target_properties(mocha_core PROPERTIES EXPORT_NAME core)
install(TARGETS mocha_core EXPORT mocha_ugv)

include(CMakePackageConfigHelpers)
set(package ${CATKIN_GLOBAL_LIB_DESTINATION}/cmake/${PROJECT_NAME})
set(share ${CATKIN_PACKAGE_SHARE_DESTINATION})
configure_package_config_file(cmake/mocha_ugvConfig.cmake.in ${devel}/${package}/mocha_ugvConfig.cmake INSTALL_DESTINATION ${package} INSTALL_PREFIX ${devel}
  PATH_VARS share)
write_basic_package_version_file(${devel}/${package}/mocha_ugvConfigVersion.cmake VERSION ${${PROJECT_NAME}_VERSION} COMPATIBILITY SameMinorVersion)
export(EXPORT mocha_ugv NAMESPACE mocha_ugv:: FILE ${devel}/${package}/mocha_ugvTargets.cmake)
install(EXPORT mocha_ugv NAMESPACE mocha_ugv:: FILE mocha_ugvTargets.cmake DESTINATION ${package})
install(FILES ${devel}/${package}/mocha_ugvConfig.cmake ${devel}/${package}/mocha_ugvConfigVersion.cmake DESTINATION ${package})
