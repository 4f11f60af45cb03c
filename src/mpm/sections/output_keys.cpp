// Keys of what a run writes.
#include "mpm/sections/section_tables.hpp"

namespace mpm {

const KeyTable<OutputDefinition>& output_keys() {
  using Output = OutputDefinition;
  static const char* const kPeriod = "time, a whole number of sync periods";
  static const auto keys =
      KeyTable<Output>("output")
          .rows(
              {other<Output>("period", kPeriod,
                             {"`end`/50 rounded down to 1, 2 or 5 times a power of ten; 0.02 s without an end",
                              "time between particle snapshots", "0.02"}),
               other<Output>("first", kPeriod,
                             {"one period", "time of the first snapshot after that of the start; periods count from it",
                              "0.5 s"}),
               other<Output>("particle_fields", "list of fields",
                             {"`[vx, vy, vz, p, j]`, of the scene's axes", "scalars beside x, y, z, id", "[vx, szz]"}),
               plain("particle_stride", &Output::particle_stride, {"", "write every n-th particle", "4"},
                     at_least(1.0)),
               other<Output>("particle_region", "`{min, max}`, vectors of lengths",
                             {"everywhere", "only particles whose centres lie in it are written",
                              "{min: [0, 0, 0.1], max: [0.5, 0.2, 0.3]}"}),
               other<Output>("global", "list of names, or of `{quantity, body}`",
                             {"none", "numbers over time: means over a body, energies, contact forces",
                              "[Kinetic Energy, {quantity: sxx, body: soil}]"}),
               other<Output>("global_period", kPeriod, {"each sync point", "between two values of `global`", "0.01"})})
          .advise({{"folder", "name it on the command line: --out DIR, --csv DIR, --bag FILE"},
                   {"crack_fields", "bodies are whole"}});
  return keys;
}

}  // namespace mpm
