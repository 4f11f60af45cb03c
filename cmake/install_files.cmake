# Installs what is not compiled: scripts, headers, launch files, configuration and examples.

# Scripts that users call are installed beside the programs, with the modules that they import. In the devel space wrappers
# call them in scripts/, where those modules are.
catkin_install_python(PROGRAMS scripts/plot_report.py scripts/plot_sweep.py scripts/plot_work_precision.py
  scripts/remove_parameters.py scripts/replay.py DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(FILES scripts/plot_animation.py scripts/plot_compare.py scripts/plot_cracks.py scripts/plot_particles.py
  scripts/plot_render.py scripts/plot_robots.py scripts/plot_section.py scripts/plot_series.py scripts/plot_style.py
  scripts/plot_tables.py scripts/plot_view.py
  DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
install(DIRECTORY include/mpm include/mpm_ranks include/mpm_ros DESTINATION ${CATKIN_GLOBAL_INCLUDE_DESTINATION}
  FILES_MATCHING PATTERN "*.hpp" PATTERN "petsc_communicator.hpp" EXCLUDE)
install(DIRECTORY launch config DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION})
install(DIRECTORY examples DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION} USE_SOURCE_PERMISSIONS
  PATTERN "__pycache__" EXCLUDE)
