#include "mpm/bed/bed_keys.hpp"

namespace mpm {

const KeyTable<BedDefinition>& bed_keys() {
  using Bed = BedDefinition;
  static const auto keys = KeyTable<Bed>("terrain").rows(
      {other<Bed>("follow", "rigid body or robot, or a list of them",
                  {kRequired, "what the ground is there for; of a robot, all its links", "[front_left, front_right]"}),
       number("within", &Bed::within, kLength, kPositive,
              {kRequired, "distance from the origins of these, along x and y, in which there is ground that can move",
               "2 m"})});
  return keys;
}

}  // namespace mpm
