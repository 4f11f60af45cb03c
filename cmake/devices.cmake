# Makes the library mpm_devices, which finds the graphics processor that programs may use: a card in a build with MPM_GPU or,
# in one without, none. Sources that are compiled are all the difference.

if(MPM_GPU)
  include(src/mpm_gpu/device/card.cmake)
  add_library(mpm_devices STATIC src/mpm_devices/nvidia_card.cpp)
  target_link_libraries(mpm_devices PRIVATE mpm_gpu_cuda)
else()
  add_library(mpm_devices STATIC src/mpm_devices/no_card.cpp)
endif()
target_link_libraries(mpm_devices PUBLIC mpm PRIVATE mpm_options)
