# Headers of the LCM types in lcm/, below MOCHA_LCM_INCLUDE_DIR; a target that needs them depends on mocha_lcm_types.
find_path(LCM_INCLUDE_DIR lcm/lcm_coretypes.h REQUIRED)
find_library(LCM_LIBRARY lcm REQUIRED)
find_program(LCM_GEN lcm-gen REQUIRED)
set(MOCHA_LCM_INCLUDE_DIR ${CMAKE_BINARY_DIR}/lcm)
file(GLOB lcm_types CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lcm/*.lcm)
foreach(type ${lcm_types})
  get_filename_component(name ${type} NAME_WE)
  set(header ${MOCHA_LCM_INCLUDE_DIR}/mocha_lcm/${name}.hpp)
  add_custom_command(OUTPUT ${header} DEPENDS ${type} VERBATIM
    COMMAND ${LCM_GEN} --cpp --cpp-std=c++11 --cpp-hpath ${MOCHA_LCM_INCLUDE_DIR} ${type})
  list(APPEND lcm_headers ${header})
endforeach()
add_custom_target(mocha_lcm_types DEPENDS ${lcm_headers})
