# Says how everything of this package is compiled: mpm_options, which each target links, and ${little_optimised}.

add_library(mpm_options INTERFACE)
target_compile_features(mpm_options INTERFACE cxx_std_17)
target_compile_options(mpm_options INTERFACE -Wall -Wextra -Wpedantic)
# Products and sums are not contracted, so that bits are the same whatever is inlined where. Kernels are the exception: there
# the instruction set says how a product and a sum are rounded.
target_compile_options(mpm_options INTERFACE
  $<IF:$<BOOL:$<TARGET_PROPERTY:MPM_KERNEL>>,-ffp-contract=fast,-ffp-contract=off>)
# This option is for what runs once, or waits for others.
set(little_optimised $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
if(MPM_SANITIZE)
  # GCC 12 takes the instrumented std::regex for uninitialised.
  target_compile_options(mpm_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-omit-frame-pointer -Wno-maybe-uninitialized)
  if(MPM_NOT_SANITIZED)
    target_compile_options(mpm_options INTERFACE -fno-sanitize=${MPM_NOT_SANITIZED})
  endif()
  target_link_options(mpm_options INTERFACE -fsanitize=address,undefined)
endif()
