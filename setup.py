"""For catkin (catkin_python_setup in cmake/messages.cmake): which Python packages there are. Not to be run by hand."""
from catkin_pkg.python_setup import generate_distutils_setup
from setuptools import setup

setup(**generate_distutils_setup(packages=["mpm_ros"], package_dir={"": "python"}))
