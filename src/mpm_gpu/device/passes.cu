// The kernels and launches of lane/passes.cpp, for a card.
#include "mpm_gpu/device/host_headers.hpp"

#pragma clang force_cuda_host_device begin
#include "mpm/shape/bspline.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/ugimp_stretch.hpp"
#include "mpm_gpu/leaving_passes.hpp"
#include "mpm_gpu/liquid_passes.hpp"
#include "mpm_gpu/load_passes.hpp"
#include "mpm_gpu/node_passes.hpp"
#include "mpm_gpu/particle_passes.hpp"
#include "mpm_gpu/prescribed_passes.hpp"
#pragma clang force_cuda_host_device end

#include "../lane/passes.cpp"
