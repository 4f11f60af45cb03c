#include "mpm/rules/section_keys.hpp"

#include "mpm/rules/implicit_rules.hpp"

namespace mpm {

constexpr double kShortestEnd = 100e-9;  ///< a hundred sync points of the shortest period [s]
constexpr double kLongestEnd = 1e9;      ///< [s], 32 years; 64 bits of nanoseconds last 292 years
constexpr double kMostTerms = 12;        ///< |A|^13 / 13! is below the last digit for the |A| < 0.3 of a step

const KeyTable<TimeDefinition>& time_keys() {
  using Time = TimeDefinition;
  static const auto keys =
      KeyTable<Time>("time")
          .advise({{"start", "a run starts at 0"}})
          .rows({number("end", &Time::end, kTime, or_unset(0.0, from_to(kShortestEnd, kLongestEnd)),
                        {"none: until stopped",
                         "end of the run; `run_scene` needs one, here or by `--end`. A run ends at the first sync "
                         "point there or later, and one between two sync points is warned of",
                         "2.0"}),
                 number("cfl", &Time::cfl, kPlain, between(0.0, 1.0),
                        {"", "part of a cell that the fastest wave may travel in a step", "0.4"}),
                 number("step", &Time::step, kTime, kPositive, {"", "upper limit of the time step", "0.1 ms"}),
                 other<Time>(
                     "sync", "time, whole nanoseconds",
                     {"largest that divides `output.period` (and `output.first`) and is at most 0.01 s and `end`/100",
                      "period of the sync points, at which output is made, commands take effect and services answer; a "
                      "whole number of steps lies between two of them",
                      "0.01"}),
                 number("budget", &Time::budget, kTime, kPositive,
                        {"",
                         "wall time of a sync period, at which implicit steps end their sweeps "
                         "([loop.md](../loop.md#a-budget-of-wall-time)); runs depend on the clock then; refused with "
                         "explicit steps",
                         "7 ms"})});
  return keys;
}

/// Names of shape functions, by their kind, and other names of some.
struct ShapeWords {
  std::vector<std::string> words;
  std::vector<std::pair<std::string, std::size_t>> aliases;
};
ShapeWords shape_words() {
  ShapeWords shapes;
  for (std::size_t kind = 0; kind < kShapeTraits.size(); ++kind) {
    const ShapeTraits& traits = traits_of(static_cast<ShapeKind>(kind));
    shapes.words.emplace_back(traits.name);
    if (traits.other_name != nullptr) shapes.aliases.emplace_back(traits.other_name, kind);
  }
  return shapes;
}

const KeyTable<MethodDefinition>& method_keys() {
  using Method = MethodDefinition;
  const ShapeWords shapes = shape_words();
  const auto index = [](auto kind) { return static_cast<std::size_t>(kind); };
  static const auto keys = KeyTable<Method>("method").rows(
      {other<Method>("auto", "map, below",
                     {"none",
                      "shape, update and transfer that the scene does not name are chosen from measurements; without "
                      "`auto` they have the defaults of this table",
                      "{error: 3 %}"}),
       word("shape", &Method::shape, shapes.words, {"", "shape functions, below", "bspline2"}, shapes.aliases),
       word("update", &Method::update, words_of(kUpdateNames), {"", "when strains are updated in a step, below", "usf"},
            {{"musl", index(UpdateScheme::usl)}}),
       plain("sweeps", &Method::sweeps,
             {"as many as the pressure on tools asks for",
              "sweeps of an implicit step ([implicit.md](implicit.md)); refused without `update: implicit`", "20"},
             from_to(1.0, kMostImplicitSweeps)),
       other<Method>("transfer", "word or map, below",
                     {"`flip`; `{flip: 0.6, xpic: 2, every: 5}` with a law of soil; `{flip: 0.95}` with implicit "
                      "steps; `{xpic: 2}` where cracks may grow",
                      "how particles take over the grid's motion", "{flip: 0.99}"}),
       plain("average_dilatation", &Method::average_dilatation,
             {"",
              "volume changes are averaged over the grid before the law sees them: against locking near "
              "incompressibility; not in a line or in plane stress, where nothing locks",
              "true"}),
       plain("average_stress", &Method::average_stress,
             {"`true`, unless `average_dilatation` is on",
              "particles of a body of `drucker_prager`, `mohr_coulomb`, `mu_i` or `j2_plasticity` that flow in a cell "
              "share their mean stress: against locking of slip bands and ringing pressure, see "
              "[below](#average_stress); not in a line or in plane stress",
              "false"}),
       other<Method>("damping", "rate, or map, below", {"none", "takes momentum out of the motion", "20 1/s"}),
       plain("gradient_terms", &Method::gradient_terms, {"", "terms of the exponential of the velocity gradient", "2"},
             from_to(1.0, kMostTerms)),
       other<Method>("particles_per_cell",
                     "line 1, 2, 3, 4, 5; planar and axisymmetric 1, 4, 9, 16, 25; solid 1, 8, 27",
                     {"2, 4, 8: two along each edge", "particles that fill a cell of a body", "8"}),
       other<Method>(
           "axis", "map",
           {"see there",
            "axisymmetric scenes: what happens beside the axis, in [axisymmetric.md](axisymmetric.md#the-axis)",
            "{motion: mean}"}),
       word("precision", &Method::precision, {"single", "double"},
            {"",
             "precision of the kernels, and of the velocity, deformation, stress and history that particles keep; "
             "positions and the grid are always double. `single` takes two thirds of the memory and of the time; "
             "momentum is kept to 1e-8 to 7e-8 (worse in many small steps of a body that moves as one), and a stress "
             "to 1e-7 of the modulus: suited to large strains, not to small ones",
             "single"})});
  return keys;
}

const KeyTable<AxisRules>& axis_keys() {
  using Axis = AxisRules;
  static const auto keys =
      KeyTable<Axis>("method.axis")
          .rows({word("domains", &Axis::domains, words_of(kAxisDomainNames),
                      {"",
                       "`fitted`: a box that reaches across r = 0 is cut off there (`ugimp`), and a domain that "
                       "deforms is shrunk until it touches the axis; `whole`: it is left as it is",
                       "whole"}),
                 word("functions", &Axis::functions, words_of(kAxisFunctionNames),
                      {"", "shape functions with the weight r; or those of a plane, with S / r for the hoop direction",
                       "planar"}),
                 word("ghosts", &Axis::ghosts, words_of(kAxisGhostNames),
                      {"", "radial velocity of the nodes beyond the axis; these get mass only with `planar` or `whole`",
                       "mirror"}),
                 word("motion", &Axis::motion, words_of(kAxisMotionNames),
                      {"",
                       "velocity that moves a particle along r: that of the grid at its place; or the mean in its "
                       "domain, which is also the particle's own velocity",
                       "mean"})});
  return keys;
}

const KeyTable<ContactLaw>& contact_law_keys() {
  using Law = ContactLaw;
  static const char* const kSide = "pressure over length, or `perfect`";
  static const auto keys =
      KeyTable<Law>("contact.law")
          .rows(
              {other<Law>(
                   "law", "`coulomb`, `stick`, `interface`, `one_field`",
                   {"`coulomb`", "if given in `contact`: of every pair of bodies that `pairs` does not name", "stick"}),
               other<Law>(
                   "friction", "number or function of t ≥ 0, or `stick`",
                   {"0", "Coulomb's coefficient of sliding friction; for all tools that do not have their own", "0.3"}),
               other<Law>("static_friction", "as `friction`, and not less",
                          {"`friction`", "coefficient that has to be overcome before sliding begins", "0.4"}),
               other<Law>("adhesion", "pressure or function of t ≥ 0",
                          {"0", "tension that the surfaces bear, and shear in addition to friction", "2 kPa"}),
               other<Law>(
                   "normal", kSide,
                   {"`opened` and `closed` say it", "stiffness of an `interface` across the surface", "2 MPa/mm"}),
               other<Law>(
                   "opened", kSide,
                   {"`normal`; without it required", "stiffness across the surface where it has opened", "2 MPa/mm"}),
               other<Law>(
                   "closed", kSide,
                   {"`normal`; without it `perfect`", "stiffness across the surface where it is pressed", "perfect"}),
               other<Law>("tangential", kSide,
                          {"required with `interface`", "stiffness of an `interface` along the surface", "1 MPa/mm"})});
  return keys;
}

const KeyTable<ContactDefinition>& contact_keys() {
  using Contact = ContactDefinition;
  static const auto normals = KeyTable<NormalRule>("contact").rows(
      {word("normals", &NormalRule::method, words_of(kNormalNames), {"", "normals between deformable bodies", "own"},
            {{"0", 0}, {"1", 1}, {"2", 2}, {"3", 3}}),
       number("rigid_bias", &NormalRule::rigid_bias, kPlain, kNotNegative,
              {"", "how much they favour a rigid body made of particles", "2"})});
  static const auto detection = KeyTable<DetectionRule>("contact").rows(
      {word("detection", &DetectionRule::kind, words_of(kDetectionNames),
            {"", "when deformable bodies touch, and when material touches a rigid body made of particles",
             "displacements"}),
       number("position", &DetectionRule::position, kPlain, kNotNegative,
              {"", "distance of mean places for `detection: positions`, in cells", "0.9"}),
       number("minimum_volume", &DetectionRule::minimum_volume, kPlain, kNotNegative,
              {"", "nodes with less than this part of a cell's volume have no contact", "0.5"})});
  static const auto keys = KeyTable<Contact>("contact")
                               .rows({word("method", &Contact::method, {"points", "nodes"},
                                           {"",
                                            "where contact with rigid bodies acts: at points of the material's "
                                            "surface, or at the grid's nodes in the body",
                                            "nodes"}),
                                      word("edges", &Contact::sharp_edges, {"blunt", "sharp"},
                                           {"",
                                            "whether points near the edge of a tool's face see of the nodes that they "
                                            "share with material beyond it only the part before the face "
                                            "([contact.md](../contact.md#with-rigid-bodies)); not with `method: nodes`",
                                            "blunt"})})
                               .part(&Contact::normals, normals)
                               .part(&Contact::detection, detection)
                               .rows({other<Contact>("pairs", "list of maps: `between`, two bodies, and a law's keys",
                                                     {"none", "laws of single pairs of bodies, one of them deformable",
                                                      "[{between: [soil, stone], friction: 0.5}]"})});
  return keys;
}

const KeyTable<GeostaticDefinition>& geostatic_keys() {
  using Geostatic = GeostaticDefinition;
  static const auto keys =
      KeyTable<Geostatic>("bodies.initial.geostatic")
          .rows({number("k0", &Geostatic::k0, kPlain, kNotNegative,
                        {"that of the material", "horizontal over vertical stress", "0.5"}),
                 number("residual", &Geostatic::residual, kPlain, kPositive,
                        {"", "unbalanced force over weight at which the ground has settled", "0.01"})})
          .advise({{"surface", "the weight above each particle is summed over the particles"}});
  return keys;
}

}  // namespace mpm
