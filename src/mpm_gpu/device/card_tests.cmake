# Makes the tests and the benchmarks over the library mpm_gpu_cuda. Target gpu_folder puts all, with the libraries and the shipped
# scenes that they need, into the folder gpu/ of the build, for a machine with a card (scripts/test_gpu).

# The tests of the executor have kernels of their own.
set(card_test_objects)
foreach(name cells recording)
  mpm_compile_for_card(card_test_objects test/gpu/device/${name}_test.cu -ffp-contract=off)
endforeach()
file(GLOB card_tests CONFIGURE_DEPENDS test/gpu/*_test.cpp)
list(FILTER card_tests EXCLUDE REGEX "gpu_(cells|recording)_test")
add_executable(gpu_tests_cuda EXCLUDE_FROM_ALL ${card_tests} ${card_test_objects})
set_source_files_properties(${card_test_objects} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
target_link_libraries(gpu_tests_cuda PRIVATE mpm_gpu_cuda test_pages test_main mpm_options)

# The benchmarks, and the same over loops on the processor, which shows that they work.
foreach(name gpu_benchmark gpu_scenes)
  add_executable(${name} EXCLUDE_FROM_ALL benchmark/gpu/${name}.cpp)
  target_link_libraries(${name} PRIVATE mpm_gpu test_pages mpm_options fmt::fmt)
  add_executable(${name}_cuda EXCLUDE_FROM_ALL benchmark/gpu/${name}.cpp)
  target_link_libraries(${name}_cuda PRIVATE mpm_gpu_cuda test_pages mpm_options fmt::fmt)
endforeach()

add_custom_target(gpu_folder
  COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/collect_programs ${CMAKE_CURRENT_BINARY_DIR}/gpu $<TARGET_FILE:gpu_tests_cuda>
    $<TARGET_FILE:gpu_benchmark_cuda> $<TARGET_FILE:gpu_scenes_cuda>
  COMMAND ${CMAKE_COMMAND} -E copy_directory ${PROJECT_SOURCE_DIR}/config ${CMAKE_CURRENT_BINARY_DIR}/gpu/config
  VERBATIM)
add_dependencies(gpu_folder gpu_tests_cuda gpu_benchmark_cuda gpu_scenes_cuda)
