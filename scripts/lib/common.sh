# Sourced by the scripts: paths, and an environment that does not depend on the caller's.
# shellcheck shell=bash
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build="$root/build"
# shellcheck disable=SC2034 # of those who source this
build_mpi="$root/build_mpi"
# shellcheck disable=SC2034
build_gpu="$root/build_gpu"
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

# find_cuda: prints the folder of a CUDA toolkit of 12 or later, by CUDA_HOME, the nvcc on PATH, or where it is installed by default.
find_cuda() {
  local nvcc folder version
  nvcc=${CUDA_HOME:+$CUDA_HOME/bin/nvcc}
  [ -n "$nvcc" ] || nvcc=$(command -v nvcc) || nvcc=/usr/local/cuda/bin/nvcc
  version=$("$nvcc" --version 2>/dev/null | sed -n 's/.*release \([0-9]*\).*/\1/p') || true
  if [ -z "$version" ] || [ "$version" -lt 12 ]; then
    echo "build: --gpu needs a CUDA toolkit of 12 or later (looked for: $nvcc): install one, and set CUDA_HOME or put its nvcc on PATH" >&2
    return 2
  fi
  folder=$(dirname "$(dirname "$(readlink -f "$nvcc")")")
  echo "$folder"
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
