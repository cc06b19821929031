# The layering, what stands around the nodes, one gtest binary a folder (test/NAME/*_test.cpp), every rostest below test/rostest, and every test on separate hosts
# below test/netns.
foreach(name architecture install_robot launch_files robot_description)
  add_test(NAME ${name} COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/${name}_test.py)
endforeach()

add_test(NAME install_space COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/install_space_test.py ${CMAKE_BINARY_DIR})

set(core_folders config trajectory world camouflage safety perception fleet control base simulation topology
    optimization planning ros)
foreach(folder ${core_folders})
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/${folder}/*_test.cpp)
  if(MOCHA_LEFT_OUT)
    list(FILTER sources EXCLUDE REGEX "/${MOCHA_LEFT_OUT}(_test)?\\.cpp$")
  endif()
  if(sources)
    catkin_add_gtest(test_${folder} ${sources} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
    target_link_libraries(test_${folder} mocha_${folder} gtest gtest_main)
    target_include_directories(test_${folder} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  endif()
endforeach()

# The scenes and the judge of scripts/bench replan, and the fleet of scripts/bench table3, fleet_delay and fleet_scale.
target_sources(test_planning PRIVATE test/benchmarks/replan_scene.cpp test/benchmarks/space_time_solver.cpp
  test/benchmarks/fleet_run.cpp test/benchmarks/fleet_robot.cpp test/benchmarks/fleet_scene.cpp test/benchmarks/one_phase.cpp
  test/benchmarks/benchmark_world.cpp)

# Simulated drives for the localiser.
target_link_libraries(test_perception mocha_simulation)

file(GLOB rostests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/rostest/*.test)
foreach(test ${rostests})
  add_rostest(${test})
endforeach()

# 77: the machine cannot play several hosts; the test says why.
file(GLOB netns_tests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/netns/*_test.py)
foreach(test ${netns_tests})
  get_filename_component(name ${test} NAME_WE)
  string(REGEX REPLACE "_test$" "" name ${name})
  add_test(NAME netns_${name} COMMAND ${PYTHON_EXECUTABLE} ${test})
  set_tests_properties(netns_${name} PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
# A million broken datagrams, under the sanitizers. Of the core it is built from the sources, as the libraries are not.
file(GLOB fuzzed_sources CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/src/fleet/*.cpp ${PROJECT_SOURCE_DIR}/src/trajectory/*.cpp ${PROJECT_SOURCE_DIR}/src/world/obstacle.cpp)
add_executable(fuzz_datagrams EXCLUDE_FROM_ALL test/fuzz/datagrams.cpp ${fuzzed_sources})
target_include_directories(fuzz_datagrams PRIVATE src test)
target_include_directories(fuzz_datagrams SYSTEM PRIVATE ${MOCHA_LCM_INCLUDE_DIR})
target_compile_options(fuzz_datagrams PRIVATE -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all)
target_link_libraries(fuzz_datagrams Eigen3::Eigen sodium -fsanitize=address,undefined)
add_dependencies(fuzz_datagrams mocha_lcm_types)
add_dependencies(tests fuzz_datagrams)
add_test(NAME fuzz_datagrams COMMAND fuzz_datagrams 1000000 1)

# Two robots as they are on the floor: through serial lines, finding out where they are for themselves.
add_test(NAME drive_corridor_rovers COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/drive_test.py corridor_rovers
  --emulated-bases --map ${PROJECT_SOURCE_DIR}/config/maps/corridor.bt)
# Fleets that have to agree on who goes first, through the whole stack.
foreach(world two_swap five four_corners narrow_corridor passing_place ten_through_a_door)
  add_test(NAME drive_${world} COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/drive_test.py ${world})
endforeach()
