// The kernels and launches of totals.cpp, for a card.
#include "mpm_gpu/device/host_headers.hpp"

#include "../totals.cpp"
