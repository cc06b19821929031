# The programs behind scripts/bench and scripts/plots: test/benchmarks/NAME.cpp becomes benchmark_NAME. Built only when asked for.
function(mocha_benchmark name)
  add_executable(benchmark_${name} EXCLUDE_FROM_ALL test/benchmarks/${name}.cpp test/benchmarks/benchmark_world.cpp ${ARGN})
  target_include_directories(benchmark_${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(benchmark_${name} mocha_stack)
endfunction()

foreach(name evaluation table1_curves)
  mocha_benchmark(${name})
endforeach()
mocha_benchmark(table1 test/benchmarks/built_worlds.cpp)

mocha_benchmark(space)
target_link_libraries(benchmark_space octomap octomath)
find_package(dynamicEDT3D QUIET)
if(dynamicEDT3D_FOUND)  # as a peer
  target_compile_definitions(benchmark_space PRIVATE MOCHA_WITH_DYNAMIC_EDT)
  target_include_directories(benchmark_space SYSTEM PRIVATE ${DYNAMICEDT3D_INCLUDE_DIRS})
  target_link_libraries(benchmark_space ${DYNAMICEDT3D_LIBRARIES})
endif()

mocha_benchmark(classes)
target_link_libraries(benchmark_classes mocha_perception)

mocha_benchmark(localization)
target_link_libraries(benchmark_localization mocha_perception mocha_simulation)

foreach(name mapping map_merging localization_logs)
  mocha_benchmark(${name} test/benchmarks/carmen_log.cpp test/benchmarks/log_drive.cpp test/benchmarks/skid_odometry.cpp
    test/benchmarks/trajectory_error.cpp)
  target_link_libraries(benchmark_${name} mocha_perception mocha_simulation)
endforeach()

mocha_benchmark(tracks test/benchmarks/bag_perception.cpp)
target_link_libraries(benchmark_tracks mocha_ros_bridge)

# Planners of OMPL stand beside ours.
find_package(ompl QUIET)
if(ompl_FOUND)
  list(REMOVE_ITEM OMPL_LIBRARIES ode)  # for its physics, which nothing here uses
  foreach(name table2 table2_curves)
    mocha_benchmark(${name} test/benchmarks/table2_world.cpp test/benchmarks/table2_plan.cpp test/benchmarks/table2_mocha.cpp
      test/benchmarks/ompl_peers.cpp test/benchmarks/bitstar.cpp)
    target_include_directories(benchmark_${name} SYSTEM PRIVATE ${OMPL_INCLUDE_DIRS})
    target_link_libraries(benchmark_${name} ${OMPL_LIBRARIES})
  endforeach()
  mocha_benchmark(maps test/benchmarks/maps_building.cpp test/benchmarks/maps_log.cpp test/benchmarks/carmen_log.cpp test/benchmarks/bitstar.cpp)
  target_include_directories(benchmark_maps SYSTEM PRIVATE ${OMPL_INCLUDE_DIRS})
  target_link_libraries(benchmark_maps ${OMPL_LIBRARIES})
endif()

set(space_time_solver test/benchmarks/space_time_solver.cpp test/benchmarks/space_time_lattice.cpp test/benchmarks/static_clearance.cpp)
mocha_benchmark(replan test/benchmarks/replan_scene.cpp test/benchmarks/replan_problem.cpp test/benchmarks/replan_run.cpp ${space_time_solver})

mocha_benchmark(movers test/benchmarks/sighted_drive.cpp test/benchmarks/mover_sightings.cpp ${space_time_solver})
target_link_libraries(benchmark_movers mocha_simulation)

foreach(name table3 fleet_delay fleet_scale deadlock)
  mocha_benchmark(${name} test/benchmarks/fleet_run.cpp test/benchmarks/fleet_robot.cpp test/benchmarks/fleet_options.cpp test/benchmarks/fleet_scene.cpp
    test/benchmarks/one_phase.cpp)
endforeach()

mocha_benchmark(soak test/benchmarks/soak_run.cpp test/benchmarks/soak_faults.cpp test/benchmarks/robot_nodes.cpp
  test/benchmarks/broadcaster_node.cpp test/benchmarks/stray_sight.cpp test/benchmarks/patrols.cpp test/benchmarks/fleet_robot.cpp
  test/benchmarks/fleet_options.cpp test/benchmarks/fleet_scene.cpp test/benchmarks/one_phase.cpp)
target_link_libraries(benchmark_soak mocha_perception mocha_simulation)

mocha_benchmark(leaving test/benchmarks/leaving_scene.cpp test/benchmarks/leaving_oracle.cpp test/benchmarks/leaving_run.cpp
  test/benchmarks/lidar_robot.cpp test/benchmarks/lidar_perception.cpp)
target_link_libraries(benchmark_leaving mocha_perception mocha_simulation)

mocha_benchmark(mover_trace test/benchmarks/lidar_robot.cpp test/benchmarks/lidar_perception.cpp)
target_link_libraries(benchmark_mover_trace mocha_perception mocha_simulation)

mocha_benchmark(prediction test/benchmarks/lidar_perception.cpp)
target_link_libraries(benchmark_prediction mocha_perception mocha_simulation)

mocha_benchmark(protocol)
target_link_libraries(benchmark_protocol mocha_protocol_model)
