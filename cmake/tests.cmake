# The layering, one gtest binary a folder (test/NAME/*_test.cpp), and every rostest below test/rostest.
add_test(NAME architecture COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/architecture_test.py)

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

file(GLOB rostests CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/test/rostest/*.test)
foreach(test ${rostests})
  add_rostest(${test})
endforeach()
