# The layering, what stands around the nodes, the tests of the core and of the bridge to ROS, every rostest below test/rostest, and every test on separate hosts
# below test/netns.
foreach(name architecture architecture_page cell_optimum door_capacity clear_mot crossing_worlds docs debian_packages docs_commands fleet_view install_robot launch_files plots referee robot_description)
  add_test(NAME ${name} COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/${name}_test.py)
endforeach()

add_test(NAME install_space COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/install_space_test.py ${CMAKE_BINARY_DIR})

if(TARGET mocha_planner)
  add_test(NAME python_module COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/python/mocha_planner_test.py $<TARGET_FILE_DIR:mocha_planner>)
  add_test(NAME python_space COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/python/space_planner_test.py $<TARGET_FILE_DIR:mocha_planner>)
endif()

include(cmake/core_tests.cmake)
mocha_gtest(ros_bridge)

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

# Two robots as they are on the floor: through serial lines, finding out where they are for themselves.
add_test(NAME drive_corridor_rovers COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/drive_test.py corridor_rovers
  --emulated-bases --map ${PROJECT_SOURCE_DIR}/config/maps/corridor.bt)
# A robot whose world file gives it a larger footprint than its model has.
add_test(NAME drive_own_footprint COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/drive_test.py own_footprint)
# Fleets that have to agree on who goes first, through the whole stack.
foreach(world two_swap five four_corners narrow_corridor passing_place ten_through_a_door)
  add_test(NAME drive_${world} COMMAND ${PYTHON_EXECUTABLE} ${PROJECT_SOURCE_DIR}/test/drive_test.py ${world})
endforeach()
