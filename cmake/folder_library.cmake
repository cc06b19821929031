# mocha_folder(NAME LIBRARIES...): the static library mocha_NAME from src/NAME/*.cpp.
# A folder without sources becomes an interface library, so that the layering can be stated in one place.
function(mocha_folder name)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  if(sources)
    add_library(mocha_${name} STATIC ${sources})
    set(scope PUBLIC)
  else()
    add_library(mocha_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(mocha_${name} ${scope} ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(mocha_${name} ${scope} ${ARGN})
endfunction()
