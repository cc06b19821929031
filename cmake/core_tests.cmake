# The tests of the core: one gtest binary a folder (test/NAME/*_test.cpp), and the fuzzers.
function(mocha_gtest folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/${folder}/*_test.cpp)
  if(MOCHA_LEFT_OUT)
    list(FILTER sources EXCLUDE REGEX "/${MOCHA_LEFT_OUT}(_test)?\\.cpp$")
  endif()
  catkin_add_gtest(test_${folder} ${sources} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  target_link_libraries(test_${folder} mocha_${folder} gtest gtest_main)
  target_include_directories(test_${folder} PRIVATE ${PROJECT_SOURCE_DIR}/test)
endfunction()

foreach(folder config trajectory world camouflage safety perception fleet control base simulation topology optimization planning stack)
  mocha_gtest(${folder})
endforeach()

target_link_libraries(test_fleet mocha_protocol_model)

# The scenes and the judge of scripts/bench replan; the planners' closed loop is made of the stack.
target_sources(test_planning PRIVATE test/benchmarks/replan_scene.cpp test/benchmarks/replan_problem.cpp test/benchmarks/space_time_solver.cpp
  test/benchmarks/space_time_lattice.cpp test/benchmarks/static_clearance.cpp)
target_link_libraries(test_planning mocha_stack)

# The judge of scripts/bench dynabarn and crowds.
target_sources(test_simulation PRIVATE test/benchmarks/sighted_drive.cpp test/benchmarks/mover_sightings.cpp test/benchmarks/space_time_solver.cpp
  test/benchmarks/space_time_lattice.cpp test/benchmarks/static_clearance.cpp)

# The fleet of scripts/bench table3, fleet_delay and fleet_scale.
target_sources(test_stack PRIVATE test/benchmarks/fleet_run.cpp test/benchmarks/fleet_robot.cpp test/benchmarks/fleet_options.cpp
  test/benchmarks/fleet_scene.cpp test/benchmarks/one_phase.cpp test/benchmarks/benchmark_world.cpp)

# The robots of scripts/bench soak, whose nodes end and start anew.
target_sources(test_stack PRIVATE test/benchmarks/soak_run.cpp test/benchmarks/soak_faults.cpp test/benchmarks/robot_nodes.cpp
  test/benchmarks/broadcaster_node.cpp test/benchmarks/stray_sight.cpp test/benchmarks/patrols.cpp)

# The robots and the judge of scripts/bench leaving, which drive on what a simulated lidar sees.
target_sources(test_stack PRIVATE test/benchmarks/leaving_scene.cpp test/benchmarks/leaving_oracle.cpp test/benchmarks/leaving_run.cpp
  test/benchmarks/lidar_robot.cpp test/benchmarks/lidar_perception.cpp)
target_link_libraries(test_stack mocha_perception mocha_simulation)

# Simulated drives for the localiser and the mapper.
target_sources(test_perception PRIVATE test/benchmarks/skid_odometry.cpp test/benchmarks/trajectory_error.cpp)
target_link_libraries(test_perception mocha_simulation)

include(cmake/fuzzers.cmake)
