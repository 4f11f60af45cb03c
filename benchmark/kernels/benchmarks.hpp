// Benchmarks whose names are put together when the program starts.
#pragma once

namespace bench {

/// kernel/KERNEL/GEOMETRY/PRECISION/ISA/POSITIONS and strain_with_law/LAW/GEOMETRY/PRECISION/ISA, of the instruction
/// sets that this machine has.
void register_kernels();
/// sort/GEOMETRY/PRECISION/threads:N.
void register_sort();

}  // namespace bench
