// Points on the faces of a body in space; surface_samples.hpp says how and where they are weak.
#pragma once

#include "sampler.hpp"

namespace mpm {

/// Points on the drawn faces, patch by patch.
Samples sample_patches(const Sampler& sampler, const Faces& faces);

}  // namespace mpm
