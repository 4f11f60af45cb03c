# Makes all tests, by GoogleTest and rostest, which ctest runs. Target tests builds them, so who only runs the package needs
# no GoogleTest.

find_package(rostest REQUIRED)
include(GoogleTest)
enable_testing()

# Tests are compiled with little optimisation, since it is the library that computes; kernels of tests are apart.
add_library(mpm_test_options INTERFACE)
target_link_libraries(mpm_test_options INTERFACE mpm_options GTest::gtest fmt::fmt nlohmann_json::nlohmann_json)
target_compile_options(mpm_test_options INTERFACE ${little_optimised})
target_include_directories(mpm_test_options INTERFACE test/support)

# Library test_choice says which cases run, and which are long (test/full.md); main() in test_main asks it.
add_library(test_choice STATIC EXCLUDE_FROM_ALL test/main/choose_tests.cpp test/main/long_tests.cpp)
target_include_directories(test_choice PUBLIC test/main include)
target_link_libraries(test_choice PUBLIC mpm_test_options)
add_library(test_main STATIC EXCLUDE_FROM_ALL test/main/gtest_main.cpp)
target_link_libraries(test_main PUBLIC test_choice)

# Library test_pages writes pages of doc/verification.md and doc/methods.md; headers that it precompiles serve every test
# without ROS.
file(GLOB page_sources CONFIGURE_DEPENDS test/pages/*.cpp)
add_library(test_pages STATIC EXCLUDE_FROM_ALL ${page_sources})
target_include_directories(test_pages PUBLIC test/pages include)
target_link_libraries(test_pages PUBLIC mpm_test_options OpenMP::OpenMP_CXX Eigen3::Eigen PRIVATE test_choice)
target_precompile_headers(test_pages PRIVATE ${common_headers} <gtest/gtest.h> <random>
  include/mpm/scene/scene.hpp include/mpm/simulation/simulation.hpp)

include(test/gtests.cmake)

# Promises of ranks are checked on threads by the unit tests and over MPI by those of test/mpi.
file(GLOB ranks_test_sources CONFIGURE_DEPENDS test/support/*.cpp)
add_library(test_ranks STATIC EXCLUDE_FROM_ALL ${ranks_test_sources})
target_link_libraries(test_ranks PUBLIC mpm mpm_test_options PRIVATE OpenMP::OpenMP_CXX)
if(MPM_MPI)
  include(test/mpi/mpi_tests.cmake)
endif()

mpm_add_gtests(unit mpm_study test_pages test_ranks hdf5::hdf5 PNG::PNG TIFF::TIFF)
target_precompile_headers(unit_tests REUSE_FROM test_pages)
# Tests of kernels compute everything a second time, in plain loops.
set_source_files_properties(test/unit/kernels_test.cpp test/unit/kernels_path_test.cpp
  test/unit/kernel_shapes_test.cpp PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release,RelWithDebInfo>:-O2>)
# Files of test/unit/wide are compiled as the kernels are: what a register does, kernels of another shape function.
file(GLOB wide_test_sources CONFIGURE_DEPENDS test/unit/wide/*.cpp)
foreach(isa IN LISTS kernel_sets)
  add_library(unit_wide_${isa} OBJECT EXCLUDE_FROM_ALL ${wide_test_sources})
  mpm_compile_for(unit_wide_${isa} ${isa})
  target_sources(unit_tests PRIVATE $<TARGET_OBJECTS:unit_wide_${isa}>)
endforeach()
target_compile_definitions(unit_tests PRIVATE ${kernel_definitions})
# Instruction sets share no inline function, except in builds without optimisation, where they share the standard library's.
if(CMAKE_BUILD_TYPE MATCHES "Release|RelWithDebInfo" AND NOT MPM_SANITIZE)
  foreach(isa IN LISTS kernel_sets)
    add_test(NAME kernel.symbols_${isa}
      COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/check_kernel_symbols ${isa} $<TARGET_OBJECTS:mpm_kernel_${isa}>
      COMMAND_EXPAND_LISTS)
    set_tests_properties(kernel.symbols_${isa} PROPERTIES LABELS kernel TIMEOUT 60)
  endforeach()
endif()

mpm_add_gtests(verification mpm_study test_pages test_ranks)
# Tests of allocation replace operator new.
set_source_files_properties(test/verification/allocation_test.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_precompile_headers(verification_tests REUSE_FROM test_pages)
# Robots need an engine, which not every build has.
if(MPM_ROBOTS AND DART_FOUND)
  mpm_add_gtests(robots mpm_robots mpm_gpu mpm_study test_pages)
  target_precompile_headers(robots_tests REUSE_FROM test_pages)
endif()
# Every two features that go together.
mpm_add_gtests(pairs mpm_gpu mpm_study test_pages test_ranks)
target_precompile_headers(pairs_tests REUSE_FROM test_pages)
mpm_add_gtests(stability mpm_study test_pages)
target_precompile_headers(stability_tests REUSE_FROM test_pages)
# Steps for a graphics processor run here in loops on this one.
include(src/mpm_gpu/gpu.cmake)
mpm_add_gtests(gpu mpm_gpu test_pages)
set_source_files_properties(test/gpu/gpu_allocation_test.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_precompile_headers(gpu_tests REUSE_FROM test_pages)
if(bridge_sources)
  mpm_add_gtests(bridge mpm_ros_bridge mpm_gpu test_ranks)
  target_sources(bridge_tests PRIVATE src/mpm_devices/no_card.cpp)  # what a build without cards says, whichever this one is
  target_precompile_headers(bridge_tests PRIVATE ${common_headers} ${ros_headers} <gtest/gtest.h>)
endif()

if(TARGET run_scene AND NOT MPM_MPI)
  add_test(NAME ranks.no_mpi COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/check_no_mpi
    $<TARGET_FILE:mpm> $<TARGET_FILE:mpm_ranks> $<TARGET_FILE:mpm_ros_bridge> $<TARGET_FILE:run_scene>)
  set_tests_properties(ranks.no_mpi PROPERTIES LABELS ranks TIMEOUT 60)
endif()

# Instructions that a particle-step of plain scenes takes are compared with recorded figures.
if(TARGET run_scene AND CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT MPM_SANITIZE)
  add_test(NAME work.instructions
    COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/check_work.py $<TARGET_FILE:run_scene>
      "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" ${PROJECT_SOURCE_DIR}/test/data/work/figures.yaml)
  set_tests_properties(work.instructions PROPERTIES LABELS work TIMEOUT 600 SKIP_RETURN_CODE 77)
endif()

include(test/launched_tests.cmake)
