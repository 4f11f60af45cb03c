# Makes code of all messages and services (msg/, srv/) for each language. The Python package (python/mpm_ros) comes first,
# since its modules and those of messages lie in one package.

catkin_python_setup()
file(GLOB message_files RELATIVE ${PROJECT_SOURCE_DIR}/msg CONFIGURE_DEPENDS msg/*.msg)
file(GLOB service_files RELATIVE ${PROJECT_SOURCE_DIR}/srv CONFIGURE_DEPENDS srv/*.srv)
add_message_files(FILES ${message_files})
add_service_files(FILES ${service_files})
generate_messages(DEPENDENCIES geometry_msgs std_msgs)
