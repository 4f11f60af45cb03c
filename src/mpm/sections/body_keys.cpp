// Keys of deformable and of rigid bodies.
#include "mpm/sections/section_tables.hpp"

namespace mpm {

const KeyTable<BodyDefinition>& body_keys() {
  using Body = BodyDefinition;
  static const auto keys = KeyTable<Body>("bodies").rows(
      {other<Body>("name", "name", {kRequired, "", "soil"}),
       other<Body>("material", "name", {kRequired, "one of `materials`", "sand"}),
       other<Body>("shape", "one of the shapes below",
                   {kRequired, "what it fills", "{sphere: {center: [0, 0, 1], radius: 0.1}}"}),
       other<Body>("initial", "map, below, or `geostatic`",
                   {"rest, without stress", "state at the start", "geostatic"}),
       number(
           "jitter", &Body::jitter, kPlain, kPart,
           {"",
            "largest distance of each particle from its lattice place at the start, in cells along each axis, evenly "
            "at random (always the same) and within the shape: for measuring speed and noise",
            "0.6"}),
       other<Body>("seed", "whole number from 1 on",
                   {"the same in all scenes", "with `jitter`: other places at random", "2"}),
       other<Body>("cut_out", "list of rigid bodies, or `all`",
                   {"none", "particles whose centres lie in these bodies at the start are left out", "[blade]"})});
  return keys;
}

const KeyTable<RigidBodyDefinition>& rigid_body_keys() {
  using Body = RigidBodyDefinition;
  static const auto keys =
      KeyTable<Body>("rigid_bodies")
          .rows(
              {other<Body>("name", "name",
                           {kRequired, "also of its tf frame and its topics `bodies/<name>/…`", "blade"}),
               other<Body>("shape", "one of the below",
                           {kRequired, "about the body's origin", "{sphere: {radius: 0.1}}"}),
               other<Body>("pose", "map, below", {"origin", "where it is at the start", "{position: [0.3, 0, 0.2]}"}),
               other<Body>("motion", "map, below",
                           {"rest", "prescribed motion; holds until a command on a topic", "{velocity: [0.1, 0, 0]}"}),
               other<Body>("drive", "`tf`, or `{tf: FRAME}`",
                           {"commands on topics",
                            "the body follows a tf frame: with `tf` alone, the link of `shape: {urdf}`, else the frame "
                            "of the body's name; not together with `motion`",
                            "{tf: left/tool0}"}),
               other<Body>("limits", "map, below",
                           {"none", "limits on commanded motion: norms, of the body's origin and of its rotation",
                            "{speed: 0.2, acceleration: 2}"}),
               other<Body>("free", "map",
                           {"all directions are prescribed",
                            "directions in which contact, gravity and a wrench move the body: "
                            "[free_bodies.md](free_bodies.md); not together with `drive`",
                            "{density: 500, axes: [x, z]}"}),
               other<Body>("collide", "`true`, `false` or a map",
                           {"`false`",
                            "whether the body meets other rigid bodies that collide, and walls: "
                            "[collisions](free_bodies.md#collisions)",
                            "true"}),
               other<Body>("friction", "number ≥ 0, or `stick`",
                           {"`contact.friction`",
                            "Coulomb friction against the material; `stick`: no sliding, no parting", "0.5"}),
               word("normals", &Body::particles, {"surface", "particles"},
                    {"", "where contact normals come from: the exact surface, or particles that fill it", "particles"}),
               word("sides", &Body::sides, {"auto", "one", "two"},
                    {"",
                     "whether the material on the tool's two sides has a velocity field each: `auto`, if the tool is "
                     "thinner than three cells; `one`: never, and of thin tools a note says so",
                     "one"}),
               other<Body>("divides", "list of deformable bodies",
                           {"all",
                            "where the tool is thin (`sides`): the bodies whose material has two sides at it; the "
                            "others keep one velocity field. A body that one thin tool names has two sides at every "
                            "thin tool, one that cracks divide at those alone that name it",
                            "[soil]"}),
               number("reach", &Body::reach, kPlain, kPart,
                      {"",
                       "nodes this many cells outside the surface are held too; 1 holds those that rigid particles "
                       "would reach. Material meets the body that much early; of contact at nodes",
                       "1"})})
          .advise({{"mass", "write free: {mass: ...}, or density, for a body that forces move"},
                   {"frame", "use commands on topics, which tf2 transforms"}});
  return keys;
}

const KeyTable<AutoMethod>& auto_keys() {
  static const auto keys =
      KeyTable<AutoMethod>("method.auto")
          .rows({number("strain", &AutoMethod::strain, kPlain, kNotNegative,
                        {"from the scene", "largest expected strain", "50 %"}),
                 number("turn", &AutoMethod::turn, kAngle, kNotNegative,
                        {"from the scene", "largest expected rotation of material; not in a line", "90 deg"}),
                 other<AutoMethod>("error", "number > 0", {"1 %", "choose the least cost for this error", "3 %"}),
                 other<AutoMethod>("cost", "number > 0",
                                   {"none",
                                    "instead of `error`: choose the least error for this many times the cost at which "
                                    "uGIMP/USF/FLIP reaches 1 %",
                                    "2"})});
  return keys;
}

}  // namespace mpm
