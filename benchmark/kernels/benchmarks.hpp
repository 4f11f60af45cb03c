// Benchmarks that are registered when the program starts, because their names depend on the machine.
#pragma once

namespace bench {

/// Registers kernel/KERNEL/GEOMETRY/PRECISION/ISA/POSITIONS and strain_with_law/LAW/GEOMETRY/PRECISION/ISA for each
/// instruction set that this machine has.
void register_kernels();
/// Registers sort/GEOMETRY/PRECISION/threads:N.
void register_sort();

}  // namespace bench
