# The model checker of the commitment protocol, for tests and benchmarks: all below test/fleet/model but its test.
file(GLOB protocol_model CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/fleet/model/*.cpp)
list(FILTER protocol_model EXCLUDE REGEX "_test\\.cpp$")
add_library(mocha_protocol_model STATIC EXCLUDE_FROM_ALL ${protocol_model})
target_include_directories(mocha_protocol_model PUBLIC ${PROJECT_SOURCE_DIR}/test)
target_link_libraries(mocha_protocol_model PUBLIC mocha_fleet)
