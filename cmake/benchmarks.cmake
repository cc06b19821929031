# The programs behind scripts/bench and scripts/plots: test/benchmarks/NAME.cpp becomes benchmark_NAME. Built only when asked for.
foreach(name evaluation table1 table1_curves)
  add_executable(benchmark_${name} EXCLUDE_FROM_ALL test/benchmarks/${name}.cpp test/benchmarks/benchmark_world.cpp)
  target_include_directories(benchmark_${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_link_libraries(benchmark_${name} mocha_planning)
endforeach()
