# Gives mpm_add_gtests(), which makes a folder of tests a program, and says which of its files are compiled.

# Unit tests that scripts/test runs with sanitizers are those that read what users and files give, and those that together
# go through every folder of the library. The others compute for long, or depend on the instruction set.
set(sanitized_unit_tests "/(checkpoint_file|contact_report|contact_threads|crack_chain|crack_crossing|crack_field_jumps|\
crack_growth|function|global_quantity|grid|material_driver|mechanics|memory|mesh_file|near_triangles|node_choice|pace|\
particle_loads|path_driver|ranks|rigid_rules|run_safety|scalar_transfer|scene_bad_input|scene_build|scene_crack_bad_input|\
scene_fuzz|scene_reader|scene_terrain|sleep|sorter|step_threads|sweep_plan|target_scene|thin_tool|traction|transport|units|\
urdf)_test[.]cpp$")

# Files that are long as a whole have a row in test/full.md.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS test/full.md)
file(STRINGS test/full.md long_rows REGEX "^\\| `test/")
set(long_test_files)
foreach(row IN LISTS long_rows)
  string(REGEX REPLACE "^\\| `([^`]+)`.*" "${PROJECT_SOURCE_DIR}/\\1" row "${row}")
  list(APPEND long_test_files ${row})
endforeach()

# mpm_add_gtests(LABEL LIBRARY...): makes test/LABEL/*_test.cpp the program LABEL_tests, and each file a test of CTest. Cases
# that are long by test/full.md are left out unless MPM_FULL is in the environment. A file that takes more than a second says
# "Cost: N s" near its head, so that the long ones begin first.
function(mpm_add_gtests label)
  file(GLOB sources CONFIGURE_DEPENDS test/${label}/*_test.cpp)
  if(label STREQUAL "unit" AND MPM_UNIT_TESTS STREQUAL "sanitized")
    list(FILTER sources INCLUDE REGEX "${sanitized_unit_tests}")
  elseif(label STREQUAL "unit" AND MPM_UNIT_TESTS STREQUAL "others")
    list(FILTER sources EXCLUDE REGEX "${sanitized_unit_tests}")
    list(APPEND sources ${PROJECT_SOURCE_DIR}/test/unit/mechanics_test.cpp
      ${PROJECT_SOURCE_DIR}/test/unit/step_threads_test.cpp)  # in the release build, too
  endif()
  if(NOT MPM_LONG_TESTS)
    list(REMOVE_ITEM sources ${long_test_files})
  endif()
  set(target ${label}_tests)
  add_executable(${target} EXCLUDE_FROM_ALL ${sources})
  # Each file has a namespace of its own, so any of them can be compiled together.
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${MPM_TEST_FILES})
  add_dependencies(tests ${target})
  target_link_libraries(${target} PRIVATE ${ARGN} mpm_test_options test_main yaml-cpp)
  set(results ${PROJECT_BINARY_DIR}/test_results)
  set(most_seconds 600)
  if(MPM_LONG_TESTS)
    set(most_seconds 3600)
  endif()
  foreach(source IN LISTS sources)
    get_filename_component(file ${source} NAME)
    string(REGEX REPLACE "_test\\.cpp$" "" file ${file})
    file(STRINGS ${source} cost LIMIT_COUNT 1 LIMIT_INPUT 3000 REGEX "Cost: [0-9.]+ s")
    string(REGEX REPLACE ".*Cost: ([0-9.]+) s.*" "\\1" cost "${cost}")
    set(run_changed ${PROJECT_SOURCE_DIR}/scripts/lib/run_changed ${label}.${file})
    if(file STREQUAL "layers")
      set(run_changed)  # its input are the sources
    endif()
    add_test(NAME ${label}.${file} COMMAND ${run_changed} $<TARGET_FILE:${target}> --file=${file} --gtest_brief=1
      --gtest_output=xml:${results}/${label}.${file}.xml)
    # Waiting threads sleep, since several tests share the cores.
    set_tests_properties(${label}.${file} PROPERTIES LABELS ${label} TIMEOUT ${most_seconds} SKIP_RETURN_CODE 77
      ENVIRONMENT "OMP_WAIT_POLICY=passive" COST "0${cost}")
  endforeach()
endfunction()
