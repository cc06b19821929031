option(MOCHA_UNITY "Compile the sources of a room together: much quicker for all of them, slower for a change in one" ON)

# Has the sources of a target that lie in one folder compiled as one.
function(mocha_compile_by_room target)
  if(NOT MOCHA_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source ${ARGN})
    get_filename_component(room ${source} DIRECTORY)
    file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR}/src ${room})
    string(REPLACE "/" "_" room ${room})
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
endfunction()

# mocha_folder(NAME LIBRARIES...): the static library mocha_NAME from all sources below src/NAME.
# A folder without sources becomes an interface library, so that the layering can be stated in one place.
# MOCHA_FOLDERS names them all.
function(mocha_folder name)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${name}/*.cpp)
  if(MOCHA_LEFT_OUT)
    list(FILTER sources EXCLUDE REGEX "/${MOCHA_LEFT_OUT}(_test)?\\.cpp$")
  endif()
  if(sources)
    add_library(mocha_${name} STATIC ${sources})
    mocha_compile_by_room(mocha_${name} ${sources})
    # Its sources need no other library to be there when they are compiled.
    set_target_properties(mocha_${name} PROPERTIES OPTIMIZE_DEPENDENCIES ON)
    set(scope PUBLIC)
  else()
    add_library(mocha_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(mocha_${name} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>)
  target_link_libraries(mocha_${name} ${scope} ${ARGN})
  set(MOCHA_FOLDERS ${MOCHA_FOLDERS} ${name} PARENT_SCOPE)
endfunction()
