// Headers that clang is to read before those that the device shares with the host: parts of the standard library
// (threads, files) are for the host alone.
#pragma once

// Marks that CUDA's headers define and clang's wrappers of the standard library want.
#define __host__ __attribute__((host))
#define __device__ __attribute__((device))
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "mpm_gpu/device/device_functions.hpp"
#include "mpm_gpu/executor.hpp"
