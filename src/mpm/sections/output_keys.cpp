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
               other<Output>("global_period", kPeriod, {"each sync point", "between two values of `global`", "0.01"}),
               other<Output>("terrain", "map, below",
                             {"none", "maps of the ground's height over time", "{period: 0.1, change: 1 mm}"})})
          .advise({{"folder", "name it on the command line: --out DIR, --csv DIR, --bag FILE"},
                   {"crack_fields",
                    "cracks are written without it: to the topic cracks, to bags, and with run_scene --csv DIR"}});
  return keys;
}

const KeyTable<GroundOutput>& ground_keys() {
  using Ground = GroundOutput;
  static const auto keys =
      KeyTable<Ground>("output.terrain")
          .rows({other<Ground>("period", "time, a whole number of sync periods",
                               {"`output.period`", "time between two maps", "0.1"}),
                 number("resolution", &Ground::resolution, kLength, kPositive,
                        {"`grid.cell` along x", "distance between points; the domain is a whole number of it", "2 cm"}),
                 number("change", &Ground::change, kLength, kNotNegative,
                        {"every map is given out",
                         "a map is given out if a height has changed by more than this since the "
                         "last one, or the window has moved",
                         "1 mm"}),
                 other<Ground>("of", "deformable body", {"all bodies", "the body that is the ground", "soil"}),
                 other<Ground>("window", "`{of, size}`, a rigid body and lengths along x and y",
                               {"the whole domain",
                                "a part of the map around a rigid body, which it follows from "
                                "point to point within the domain",
                                "{of: blade, size: [1, 1]}"})});
  return keys;
}

}  // namespace mpm
