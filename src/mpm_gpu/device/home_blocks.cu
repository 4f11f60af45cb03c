// The kernels and launches of home_blocks.cpp, for a card.
#include "mpm_gpu/device/host_headers.hpp"

#include "../home_blocks.cpp"
