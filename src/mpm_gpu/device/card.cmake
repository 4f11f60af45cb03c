# Makes the library mpm_gpu_cuda, of steps on a card: files of kernels and launches by clang, CUB's scan and sort and conditions of graphs by nvcc, the
# rest by the compiler of all else.

find_package(CUDAToolkit 12.0 QUIET)
if(NOT CUDAToolkit_FOUND OR NOT CUDAToolkit_NVCC_EXECUTABLE)
  message(FATAL_ERROR "MPM_GPU needs a CUDA toolkit of 12.0 or later: install one, and set CUDA_HOME or put its nvcc on PATH")
endif()
find_program(MPM_CLANG NAMES clang++ clang++-16 clang++-15 clang++-14 DOC "Compiler of device code")
if(NOT MPM_CLANG)
  message(FATAL_ERROR "MPM_GPU needs clang 14 or later: install the package clang")
endif()
get_filename_component(cuda_folder ${CUDAToolkit_BIN_DIR} DIRECTORY)

# mpm_compile_for_card(OBJECTS SOURCE OPTION...): adds to the list the object of a file of kernels and launches.
set(compile_for_card ${PROJECT_SOURCE_DIR}/scripts/lib/compile_for_card)
function(mpm_compile_for_card objects source)
  get_filename_component(name ${source} NAME_WE)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/card/${name}.o)
  file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/card)
  add_custom_command(OUTPUT ${object}
    COMMAND ${compile_for_card} ${MPM_CLANG} ${cuda_folder} ${object} ${PROJECT_SOURCE_DIR}/${source}
      -I${PROJECT_SOURCE_DIR}/include "-isystem$<JOIN:$<TARGET_PROPERTY:Eigen3::Eigen,INTERFACE_INCLUDE_DIRECTORIES>,;-isystem>"
      -DFMT_SHARED -Wall -Wextra -O2 ${ARGN}
    DEPENDS ${source} ${compile_for_card} DEPFILE ${object}.d COMMENT "Building ${source} for cards" VERBATIM
    COMMAND_EXPAND_LISTS)
  set(${objects} ${${objects}} ${object} PARENT_SCOPE)
endfunction()

set(card_objects)
foreach(name cells replayed_steps holds home_blocks near_copies put_around solver solver_sums totals)
  mpm_compile_for_card(card_objects src/mpm_gpu/device/${name}.cu -ffp-contract=off)
endforeach()
foreach(name passes laws soil)
  mpm_compile_for_card(card_objects src/mpm_gpu/device/${name}.cu -DMPM_ONE_LANE -Dmpm=mpm_lane -ffp-contract=fast)
endforeach()
# Those that need CUDA's own compiler.
foreach(name sort_and_scan condition)
  set(object ${CMAKE_CURRENT_BINARY_DIR}/card/${name}.o)
  add_custom_command(OUTPUT ${object}
    COMMAND ${CUDAToolkit_NVCC_EXECUTABLE} -ccbin ${CMAKE_CXX_COMPILER} -std=c++17 -O2 -DMPM_CUDA -I${PROJECT_SOURCE_DIR}/include
      -gencode arch=compute_80,code=[sm_80,compute_80] -gencode arch=compute_90,code=sm_90
      -MD -MF ${object}.d -c -o ${object} ${PROJECT_SOURCE_DIR}/src/mpm_gpu/device/${name}.cu
    DEPENDS src/mpm_gpu/device/${name}.cu DEPFILE ${object}.d COMMENT "Building ${name} for cards" VERBATIM)
  list(APPEND card_objects ${object})
endforeach()

add_library(mpm_gpu_cuda STATIC EXCLUDE_FROM_ALL src/mpm_gpu/device.cpp src/mpm_gpu/exchange.cpp src/mpm_gpu/held_nodes.cpp
  src/mpm_gpu/implicit_soil.cpp src/mpm_gpu/leaving.cpp src/mpm_gpu/loads.cpp src/mpm_gpu/near_bodies.cpp src/mpm_gpu/near_rest.cpp src/mpm_gpu/near_tools.cpp
  src/mpm_gpu/prescribed.cpp src/mpm_gpu/soil_map.cpp src/mpm_gpu/soil_rows.cpp src/mpm_gpu/stages.cpp
  src/mpm_gpu/tractions.cpp src/mpm_gpu/device/card.cpp src/mpm_gpu/device/recordings.cpp ${card_objects})
set_source_files_properties(${card_objects} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
target_compile_definitions(mpm_gpu_cuda PUBLIC MPM_CUDA)
target_include_directories(mpm_gpu_cuda SYSTEM PRIVATE ${CUDAToolkit_INCLUDE_DIRS})
target_link_libraries(mpm_gpu_cuda PUBLIC mpm CUDA::cudart_static PRIVATE mpm_options OpenMP::OpenMP_CXX fmt::fmt)
