#include "mpm/volumes/volume_keys.hpp"

namespace mpm {

const KeyTable<VolumeDefinition>& volume_keys() {
  using Volume = VolumeDefinition;
  static const auto keys = KeyTable<Volume>("volumes").rows(
      {other<Volume>("name", "name", {kRequired, "", "bucket"}),
       other<Volume>("of", "rigid body", {"the world", "the body that it moves with", "digger"}),
       other<Volume>("shape", "a shape as of a rigid body",
                     {kRequired, "closed, about the volume's origin", "{box: {size: [0.3, 0.5, 0.2]}}"}),
       other<Volume>("pose", "map, as of a rigid body",
                     {"origin", "where it lies, in the body's frame or in the world", "{position: [0, 0, 0.1]}"})});
  return keys;
}

}  // namespace mpm
