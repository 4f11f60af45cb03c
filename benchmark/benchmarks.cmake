# Makes the programs that scripts/benchmark runs. Target benchmarks alone builds them.

add_custom_target(benchmarks)

# mpm_add_benchmark(NAME LIBRARY...): benchmark/NAME/*.cpp become the program NAME.
function(mpm_add_benchmark name)
  file(GLOB sources CONFIGURE_DEPENDS benchmark/${name}/*.cpp)
  add_executable(${name} EXCLUDE_FROM_ALL ${sources})
  add_dependencies(benchmarks ${name})
  target_link_libraries(${name} PRIVATE mpm mpm_options fmt::fmt ${ARGN})
endfunction()

mpm_add_benchmark(kernels benchmark::benchmark OpenMP::OpenMP_CXX)
mpm_add_benchmark(whole_scene CLI11::CLI11 nlohmann_json::nlohmann_json)
if(bridge_sources)
  mpm_add_benchmark(publishing mpm_ros_bridge CLI11::CLI11 nlohmann_json::nlohmann_json)
  mpm_add_benchmark(step_round_trip mpm_ros_bridge)
  mpm_add_benchmark(periods_in_time mpm_ros_bridge)
endif()
mpm_add_benchmark(roofline OpenMP::OpenMP_CXX CLI11::CLI11 nlohmann_json::nlohmann_json)
# Roofline measures multiply-adds, so they are fused wherever the instruction set can.
set_source_files_properties(benchmark/roofline/loops_avx2.cpp PROPERTIES
  COMPILE_OPTIONS "-O3;-mavx2;-mfma;-ffp-contract=fast")
set_source_files_properties(benchmark/roofline/loops_avx512.cpp PROPERTIES
  COMPILE_OPTIONS "-O3;-mavx512f;-mprefer-vector-width=512;-ffp-contract=fast")
