# Finds what the package is built upon: ROS, the libraries of others and, with MPM_MPI, also MPI, PETSc and an HDF5 that is
# parallel.

# ROS belongs to the system's Python, whatever stands first on PATH.
if(EXISTS /usr/bin/python3)
  set(PYTHON_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that ROS was installed for")
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python that ROS was installed for")
endif()

find_package(catkin REQUIRED COMPONENTS
  diagnostic_updater geometry_msgs message_generation rosbag roscpp rosgraph_msgs roslib sensor_msgs std_msgs std_srvs
  tf2_eigen tf2_geometry_msgs tf2_ros trajectory_msgs visualization_msgs)

find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED)
if(MPM_MPI)
  find_package(MPI REQUIRED COMPONENTS C)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(PETSC REQUIRED PETSc)
  set(HDF5_PREFER_PARALLEL ON)
endif()
# Version 1.10.5 is the first that says where the chunks of an array lie.
find_package(HDF5 1.10.5 REQUIRED COMPONENTS C)
if(MPM_MPI AND NOT HDF5_IS_PARALLEL)
  message(FATAL_ERROR "the parallel HDF5 is not here: install libhdf5-openmpi-dev (scripts/install_packages mpi does), then \
configure in an empty folder")
endif()
if(MPM_MPI)
  # Headers of the parallel HDF5 include those of MPI, of which the C interface is used alone.
  target_link_libraries(hdf5::hdf5 INTERFACE MPI::MPI_C)
  target_compile_definitions(MPI::MPI_C INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
endif()
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(assimp REQUIRED)
find_package(fmt REQUIRED)
find_package(muparser REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(urdfdom REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(PNG QUIET)
find_package(TIFF QUIET)
if(NOT PNG_FOUND OR NOT TIFF_FOUND)
  message(FATAL_ERROR "libpng and libtiff, which read height maps, are not both here: install libpng-dev and libtiff-dev \
(scripts/install_packages build does), then configure again")
endif()
