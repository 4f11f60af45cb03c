# Makes the tests that start several ranks of MPI.

file(GLOB mpi_test_sources CONFIGURE_DEPENDS test/mpi/*.cpp)
add_executable(mpi_tests EXCLUDE_FROM_ALL ${mpi_test_sources})
add_dependencies(tests mpi_tests)
target_link_libraries(mpi_tests PRIVATE test_ranks mpm_ranks)
# Open MPI refuses more ranks than processors, and root, as in a container, unless it is told.
set(mpi_environment
  "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMPI_MCA_rmaps_base_oversubscribe=1")
foreach(ranks 1 2 3 5)
  add_test(NAME mpi.ranks_${ranks} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ranks}
    $<TARGET_FILE:mpi_tests>)
  set_tests_properties(mpi.ranks_${ranks} PROPERTIES LABELS mpi TIMEOUT 300 ENVIRONMENT "${mpi_environment}")
endforeach()
foreach(way end_all end_alike)
  add_test(NAME mpi.${way} COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/check_end 3 "fails on purpose"
    ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} 3 $<TARGET_FILE:mpi_tests> ${way})
  set_tests_properties(mpi.${way} PROPERTIES LABELS mpi TIMEOUT 60 ENVIRONMENT "${mpi_environment}")
endforeach()
# The load is not a number where one of the ranks has material.
add_test(NAME mpi.step_of_one_fails COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/check_end 3 "body force on 'strip'"
  ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} 2 $<TARGET_FILE:run_scene>
  ${PROJECT_SOURCE_DIR}/test/data/press.yaml --threads 1 --set
  "loads=[{body_force: {acceleration: [\"x > 0.14 && t > 0.01 ? log(0 - 1) : 0\", 0]}}]")
set_tests_properties(mpi.step_of_one_fails PROPERTIES LABELS mpi TIMEOUT 60 ENVIRONMENT "${mpi_environment}")
# The checkpoint is in another folder on the second rank.
set(saved_run $<TARGET_FILE:run_scene> ${PROJECT_SOURCE_DIR}/test/data/press.yaml --threads 1 --checkpoint not_shared.h5)
add_test(NAME mpi.folder_of_one COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/check_end 2 "not the same file on all"
  ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} 1 -wdir ${PROJECT_BINARY_DIR} ${saved_run}
  : ${MPIEXEC_NUMPROC_FLAG} 1 -wdir ${PROJECT_BINARY_DIR}/CMakeFiles ${saved_run})
set_tests_properties(mpi.folder_of_one PROPERTIES LABELS mpi TIMEOUT 60 ENVIRONMENT "${mpi_environment}")
# The node over two ranks. It starts the masters that it needs.
add_test(NAME mpi.node COMMAND ${PROJECT_SOURCE_DIR}/scripts/lib/run_python_test ${CATKIN_DEVEL_PREFIX}
  ${PROJECT_SOURCE_DIR}/test/mpi/node_test.py)
set_tests_properties(mpi.node PROPERTIES LABELS mpi TIMEOUT 300 ENVIRONMENT "${mpi_environment}")
