# Sourced by the scripts: paths, and an environment that does not depend on the caller's.
# shellcheck shell=bash
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build="$root/build"
# shellcheck disable=SC2034 # of those who source this
build_mpi="$root/build_mpi"
export PATH="/usr/bin:$PATH" # ROS belongs to the system's Python
export PYTHONDONTWRITEBYTECODE=1 LC_ALL=C.UTF-8

# configure FOLDER [cmake options]: runs cmake, quiet unless it fails. A configured folder keeps its generator, and whether
# the files of a folder of sources are compiled as one.
configure() {
  local folder=$1 first=()
  shift
  mkdir -p "$folder"
  [ -f "$folder/CMakeCache.txt" ] || first=(-G Ninja -DMPM_UNITY=ON)
  if ! cmake -S "$root" -B "$folder" "${first[@]}" -DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3 \
    "$@" >"$folder/configure.log" 2>&1; then
    cat "$folder/configure.log" >&2
    return 1
  fi
}

# use_package: adds the built package to the environment, as `source build/devel/setup.bash` does.
use_package() {
  set +u # the generated file reads variables that may not be set
  # shellcheck source=/dev/null
  source "$build/devel/setup.bash"
  set -u
}

# free_port: prints a TCP port on which nothing listens.
free_port() {
  /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("localhost", 0)); print(s.getsockname()[1])'
}
