# Compiles the kernels, each file of wide/ once for every instruction set that MPM_KERNELS asks for; programs choose one of
# them when they start. The namespace mpm has another name in each set, so that no inline function of one is linked into
# another. Gives ${kernel_sets}, ${kernel_objects}, ${kernel_definitions} and mpm_compile_for().

file(GLOB kernel_sources CONFIGURE_DEPENDS src/mpm/kernel/wide/*.cpp)
set(kernel_sets plain)
set(kernel_options -fno-math-errno -fno-trapping-math)
# GCC 12 forgets, across calls, that functions write vectors wider than a register through memory: CPDI with APIC on a line
# gave the grid nothing at -O1 and -O2.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 11)
  list(APPEND kernel_options -fno-ipa-modref)
endif()
# Plain kernels need -O3 as the others do. At -O2 the same still happens, by ipa-pure-const (unit.kernel_shapes shows it),
# and without that pass they execute 1.8 times the instructions of -O3.
set(kernel_flags_plain -Wno-psabi)
set(kernel_flags_avx2 -march=x86-64-v3 -mtune=haswell)
set(kernel_flags_avx512 -march=x86-64-v4 -mtune=skylake-avx512 -mprefer-vector-width=512)
# Plain kernels stand alone in a build without optimisation, where small functions of the standard library would stay
# functions, and be shared between sets.
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND (NOT CMAKE_BUILD_TYPE STREQUAL "Debug" OR MPM_SANITIZE))
  if(MPM_KERNELS STREQUAL "all")
    list(APPEND kernel_sets avx2 avx512)
  elseif(MPM_KERNELS MATCHES "^(machine|widest)$")
    if(NOT DEFINED MPM_WIDEST)
      try_run(widest compiled ${CMAKE_BINARY_DIR} ${PROJECT_SOURCE_DIR}/scripts/lib/widest_kernels.cpp
        RUN_OUTPUT_VARIABLE printed)
      set(MPM_WIDEST "${printed}" CACHE INTERNAL "The widest instruction set of kernels that this machine has")
    endif()
    if(MPM_WIDEST AND MPM_KERNELS STREQUAL "widest")
      set(kernel_sets)
    endif()
    list(APPEND kernel_sets ${MPM_WIDEST})
  endif()
endif()

# mpm_compile_for(TARGET ISA): compiles an object library as kernels of that instruction set are.
function(mpm_compile_for target isa)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON MPM_KERNEL ON)
  target_include_directories(${target} PRIVATE include)
  target_compile_definitions(${target} PRIVATE mpm=mpm_${isa})
  target_link_libraries(${target} PRIVATE mpm_options)
  target_compile_options(${target} PRIVATE ${kernel_flags_${isa}} ${kernel_options})
endfunction()

set(kernel_objects)
foreach(isa IN LISTS kernel_sets)
  add_library(mpm_kernel_${isa} OBJECT ${kernel_sources})
  mpm_compile_for(mpm_kernel_${isa} ${isa})
  list(APPEND kernel_objects $<TARGET_OBJECTS:mpm_kernel_${isa}>)
endforeach()

# Definitions tell isa.cpp, select.cpp and tests which sets this build has.
set(kernel_definitions ${kernel_sets})
list(TRANSFORM kernel_definitions TOUPPER)
list(TRANSFORM kernel_definitions REPLACE "(.+)" "MPM_\\1_KERNELS")
set_source_files_properties(src/mpm/kernel/isa.cpp src/mpm/kernel/select.cpp PROPERTIES
  COMPILE_DEFINITIONS "${kernel_definitions}")
