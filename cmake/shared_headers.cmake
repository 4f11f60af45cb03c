# Spares the compiler most of its time, which goes into headers that many files share: mpm_unite() makes one file of several,
# and ${common_headers} and ${ros_headers} are precompiled.

# mpm_unite(TARGET SOURCE...): with MPM_UNITY the files of a folder are compiled as one, so no two of them give the same name
# to what is theirs alone. Files that are compiled in a way of their own stay apart.
function(mpm_unite target)
  foreach(source IN LISTS ARGN)
    get_filename_component(folder ${source} DIRECTORY)
    get_filename_component(group ${folder} NAME)
    if(NOT DEFINED files_${group})
      set(files_${group} 0)
    endif()
    set(part ${files_${group}})
    math(EXPR files_${group} "${part} + 1")
    math(EXPR part "${part} / ${MPM_UNITY_FILES}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group}_${part})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${MPM_UNITY} UNITY_BUILD_MODE GROUP)
endfunction()

# Headers of others took half of the time that most files need. Each file still includes what it uses.
set(common_headers <Eigen/Dense> <fmt/format.h> <algorithm> <array> <cmath> <filesystem> <fstream> <functional> <map>
  <memory> <optional> <sstream> <string> <vector>)
set(ros_headers <rosbag/bag.h> <rosbag/view.h> <ros/ros.h> <sensor_msgs/PointCloud2.h>)
