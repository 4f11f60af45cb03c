# Makes the library mpm_gpu, of steps as kernels of an index (doc/gpu.md): here for the processor, by tests alone. Files of
# lane/ are compiled as the solver's kernels are, as a set of one lane.

file(GLOB lane_sources CONFIGURE_DEPENDS src/mpm_gpu/lane/*.cpp)
file(GLOB gpu_sources CONFIGURE_DEPENDS src/mpm_gpu/*.cpp src/mpm_gpu/loops/*.cpp)
set(kernel_flags_lane -DMPM_ONE_LANE $<$<CONFIG:Release,RelWithDebInfo>:-O2>)
add_library(mpm_gpu_lane OBJECT EXCLUDE_FROM_ALL ${lane_sources})
mpm_compile_for(mpm_gpu_lane lane)
target_link_libraries(mpm_gpu_lane PRIVATE Eigen3::Eigen)
add_library(mpm_gpu STATIC EXCLUDE_FROM_ALL ${gpu_sources} $<TARGET_OBJECTS:mpm_gpu_lane>)
target_link_libraries(mpm_gpu PUBLIC mpm PRIVATE mpm_options fmt::fmt OpenMP::OpenMP_CXX)

# Option MPM_GPU: tests of the same for a card (cmake/devices.cmake).
if(MPM_GPU)
  include(src/mpm_gpu/device/card_tests.cmake)
endif()

# What a device would run is compiled for one, by clang alone, where there is any.
find_program(MPM_CLANG NAMES clang++ clang++-16 clang++-15 clang++-14 DOC "Compiler of device code, for a test")
if(MPM_CLANG)
  add_test(NAME gpu.device_code COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/check_device_code ${MPM_CLANG} ${PROJECT_SOURCE_DIR}
    $<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>)
  set_tests_properties(gpu.device_code PROPERTIES LABELS gpu TIMEOUT 120 COST 8)
endif()
