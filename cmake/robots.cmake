# Makes the library mpm_robots, which knows the engine of articulated bodies: DART or, in a build without it, none. Sources
# that are compiled are all the difference.

if(MPM_ROBOTS)
  find_package(DART 6.12 QUIET COMPONENTS dart)
endif()
if(MPM_ROBOTS AND NOT DART_FOUND AND NOT MPM_ROBOTS STREQUAL "auto")
  message(FATAL_ERROR "DART, which robots need, is not here: install libdart-dev (scripts/install_packages robots does), then \
configure again, or leave out MPM_ROBOTS")
endif()
if(MPM_ROBOTS AND DART_FOUND)
  add_library(mpm_robots src/mpm_robots/dart_engine.cpp)
  target_include_directories(mpm_robots SYSTEM PRIVATE $<TARGET_PROPERTY:dart,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(mpm_robots PRIVATE dart)
  message(STATUS "robots: by DART ${DART_VERSION}")
else()
  add_library(mpm_robots src/mpm_robots/no_engine.cpp)
  message(STATUS "robots: none; scripts/install_packages robots installs what they need")
endif()
target_link_libraries(mpm_robots PUBLIC mpm PRIVATE mpm_options fmt::fmt)
