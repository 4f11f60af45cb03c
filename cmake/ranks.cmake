# Makes the library mpm_ranks, which knows the ranks that a program was started as: those of MPI or, in a build without MPI,
# none. Sources that are compiled are all the difference.

set(ranks_sources src/mpm_ranks/launcher.cpp src/mpm_ranks/refuse_ranks.cpp)
if(MPM_MPI)
  list(APPEND ranks_sources src/mpm_ranks/make_petsc_ranks.cpp src/mpm_ranks/petsc_call.cpp
    src/mpm_ranks/petsc_communicator.cpp)
else()
  list(APPEND ranks_sources src/mpm_ranks/no_ranks.cpp)
endif()
add_library(mpm_ranks ${ranks_sources})
target_link_libraries(mpm_ranks PUBLIC mpm PRIVATE mpm_options fmt::fmt)
if(MPM_MPI)
  target_include_directories(mpm_ranks SYSTEM PRIVATE ${PETSC_INCLUDE_DIRS})
  target_link_libraries(mpm_ranks PRIVATE ${PETSC_LINK_LIBRARIES} MPI::MPI_C)
endif()
