#include "mpm/crack/crack_keys.hpp"

namespace mpm {
namespace {

/// Words of an enumeration, for which its numbers in NairnMPM's manual stand too.
std::vector<std::pair<std::string, std::size_t>> numbers(std::size_t count) {
  std::vector<std::pair<std::string, std::size_t>> aliases;
  for (std::size_t i = 0; i < count; ++i) aliases.emplace_back(std::to_string(i), i);
  return aliases;
}

}  // namespace

const KeyTable<ContourDefinition>& contour_keys() {
  using Contour = ContourDefinition;
  static const auto keys =
      KeyTable<Contour>("cracks.contour")
          .rows({plain("size", &Contour::size,
                       {"", "cells from the node next to the tip to the path, which is a square along the grid", "4"},
                       at_least(2.0)),
                 plain("terms", &Contour::terms,
                       {"", "with 2 the term of the area counts, which waves need; about an axis always 2", "1"},
                       from_to(1.0, 2.0)),
                 other<Contour>("form", "`broberg`, `bergkvist_huong`",
                                {"`broberg`", "of J about an axis", "bergkvist_huong"}),
                 word("energy", &Contour::energy, {"particles", "grid"},
                      {"",
                       "energy densities on the path are those of particles, or follow from stress and strain there, "
                       "in linear elastic material",
                       "grid"})});
  return keys;
}

const KeyTable<CracksDefinition>& cracks_keys() {
  using Cracks = CracksDefinition;
  static const auto keys = KeyTable<Cracks>("cracks").rows(
      {other<Cracks>("list", "list of maps, below", {kRequired, "the cracks"}),
       other<Cracks>("traction_laws", "map from names to laws, below",
                     {"none", "tractions between faces that have opened, such as of glue or fibres",
                      "{glue: {kind: triangular, normal: {strength: 10 MPa, opening: 0.1 mm}}}"}),
       other<Cracks>("contour", "map, below", {"none", "the path around a tip on which J is taken", "{size: 4}"}),
       word("move", &Cracks::move, {"average", "centre_of_mass"},
            {"", "the line moves with the mean of its two faces, or with the material around it", "centre_of_mass"}),
       plain("prevent", &Cracks::prevent, {"", "faces that have crossed the line are put back", "false"}),
       word("split", &Cracks::split, {"interaction", "openings"},
            {"`interaction`; about an axis `openings`",
             "how J is split into K_I and K_II: by the interaction integral, or by the openings behind the tip",
             "openings"}),
       other<Cracks>("growth", "rule, below",
                     {"none", "when a tip grows, where to, and the law of the new faces", "{criterion: hoop_stress}"}),
       other<Cracks>("alternate", "rule, below",
                     {"none", "a second rule, looked at where the first does not let the tip grow, until it has once",
                      "{criterion: release_rate, direction: initial}"}),
       number("length", &Cracks::length, kPlain, kPositive,
              {"", "cells by which a tip grows at a time; at least `time_factor`", "0.3"}),
       number("time_factor", &Cracks::time_factor, kPlain, kPositive,
              {"", "time between two looks at growth, over that in which a wave crosses a cell", "0.2"}),
       number("heating", &Cracks::heating, kPlain, kPart,
              {"",
               "part of the energy released at a growing tip that becomes heat there; needs `transport: {temperature: "
               "{}}`",
               "0.9"}),
       other<Cracks>("ignored_by", "list of bodies", {"none", "bodies that no crack divides", "[cover]"})});
  return keys;
}

const KeyTable<CrackFaces>& face_keys() {
  using Faces = CrackFaces;
  static const auto keys =
      KeyTable<Faces>("cracks.list.faces")
          .rows({word("detection", &Faces::detection, {"displacements", "positions"},
                      {"",
                       "when faces meet: by how far each side has moved, right for cracks that start closed, or by the "
                       "distance of the sides' mean places",
                       "positions"}),
                 number("position", &Faces::position, kPlain, kNotNegative,
                        {"", "distance of mean places for `detection: positions`, in cells", "0.9"})});
  return keys;
}

const KeyTable<CrackDefinition>& crack_keys() {
  using Crack = CrackDefinition;
  static const char* const kEnd = "`none`, `tip`, `exterior`, `{tip: MATERIAL}`";
  static const auto keys =
      KeyTable<Crack>("cracks.list")
          .rows({other<Crack>("name", "name", {kRequired, "of this crack", "notch"}),
                 other<Crack>("body", "a body's name",
                              {"all but `ignored_by`", "the body whose material the crack divides", "plate"}),
                 other<Crack>("points", "list of points",
                              {"one of five", "corners, joined by straight lines", "[[0, 0.5], [0.2, 0.5]]"}),
                 other<Crack>("line", "`{from, to}`",
                              {"one of five", "a straight line", "{from: [0, 0.5], to: [0.2, 0.5]}"}),
                 other<Crack>("arc", "`{centre, radius, from, to}`",
                              {"one of five", "part of a circle; angles from x, positive from x to z",
                               "{centre: [1, 0.8], radius: 0.3, from: 0 deg, to: 90 deg}"}),
                 other<Crack>("file", "path, from the scene's folder",
                              {"one of five",
                               "corners as lines of x and z in the scene's units, as text of [heights](terrain.md) is "
                               "written; a crack has 10,000 segments at most",
                               "path.csv"}),
                 other<Crack>("parts", "list",
                              {"one of five", "of the four above, joined in their order", "[{line: {…}}, {arc: {…}}]"}),
                 other<Crack>("segment", "number from 0.1 to 2",
                              {"0.5", "the longest segments of the chain, into which lines are cut, in cells", "0.25"}),
                 other<Crack>("start", kEnd, {"`none`", "as `end`", "exterior"}),
                 other<Crack>("end", kEnd,
                              {"`tip`",
                               "an end with neither J nor growth; one with both; or the place, best a quarter to half "
                               "a cell inside the surface, where the crack leaves the body. The material of a tip is "
                               "that in which it lies; one that is named holds until the tip has grown",
                               "exterior"}),
                 plain("fixed", &Crack::fixed,
                       {"", "the crack does not move, and its faces are not followed: no openings, no tractions",
                        "true"}),
                 number("thickness", &Crack::thickness, kLength, or_unset(0.0, kPositive),
                        {"the scene's", "for tractions and heat, in planar scenes", "2 mm"}),
                 other<Crack>("faces", "keys of a law as in [contact](contact.md), and below; or `ignored`",
                              {"smooth",
                               "how faces that meet act on each other; `ignored`: they pass through each other; `law: "
                               "one_field`: as if there were no crack",
                               "{friction: 0.3}"}),
                 other<Crack>("traction", "law",
                              {"none", "tractions of its faces from the start; the faces have to be smooth", "glue"}),
                 other<Crack>("traction_of_growth", "law",
                              {"that of the rule", "the same of those that growth adds", "glue"}),
                 number("longest", &Crack::longest, kLength, or_unset(0.0, kPositive),
                        {"", "at which growth stops, of the crack", "0.4"}),
                 number("longest_open", &Crack::longest_open, kLength, or_unset(0.0, kPositive),
                        {"", "the same, of its part without tractions", "0.4"})});
  return keys;
}

const KeyTable<GrowthRule>& growth_keys() {
  using Rule = GrowthRule;
  static const auto keys =
      KeyTable<Rule>("cracks.growth")
          .rows({word("criterion", &Rule::criterion, words_of(kFractureCriterionNames),
                      {kRequired, "when a tip grows, below", "hoop_stress"}, numbers(kFractureCriterionNames.size())),
                 word("direction", &Rule::direction, words_of(kGrowthDirectionNames),
                      {"", "where to, below", "self_similar"}, numbers(kGrowthDirectionNames.size())),
                 other<Rule>("traction", "law", {"none", "tractions between the faces that growth makes", "glue"})});
  return keys;
}

const KeyTable<FractureConstants>& fracture_keys() {
  using Fracture = FractureConstants;
  constexpr Dimension kSpeedGain{1, -1, 1, 0};  // speed over energy of a surface
  constexpr Range kKnown = or_unset(0.0, kPositive);
  static const auto keys =
      KeyTable<Fracture>("materials.fracture")
          .rows(
              {number("k_ic", &Fracture::k_ic, kToughness, kKnown,
                      {"", "K at which a tip grows in mode I", "0.7 MPa m^0.5"}),
               number("k_iic", &Fracture::k_iic, kToughness, kKnown, {"", "the same in mode II", "1 MPa m^0.5"}),
               other<Fracture>("exponents", "two numbers > 0",
                               {"`[2, 2]`", "of K_I and K_II with `elliptical`", "[1, 2]"}),
               number("j_ic", &Fracture::j_ic, kSurfaceEnergy, kKnown, {"", "J at which a tip grows", "8 J/m^2"}),
               number("opening_ic", &Fracture::opening_ic, kLength, kKnown,
                      {"", "opening behind the tip at which it grows, across the faces", "1 mm"}),
               number("opening_iic", &Fracture::opening_iic, kLength, kKnown, {"", "the same along the faces", "1 mm"}),
               other<Fracture>("speed", "velocity > 0; with `energy_balance` a part of that of waves",
                               {"none", "of steady growth, and at the start of `energy_balance`", "20 m/s"}),
               number("start_time", &Fracture::start_time, kTime, or_unset(-1.0, kNotNegative),
                      {"by `j_ic`", "at which steady growth begins", "1 ms"}),
               number("longest", &Fracture::longest, kLength, kKnown,
                      {"", "of the crack, at which steady growth ends", "0.3"}),
               other<Fracture>("way", "two numbers", {"self-similar", "direction of steady growth", "[1, 0.5]"}),
               number("surface_energy", &Fracture::surface_energy, kSurfaceEnergy, kKnown,
                      {"`j_ic`/2", "of `energy_balance`", "4 J/m^2"}),
               number("plastic_part", &Fracture::plastic_part, kPlain, kNotNegative,
                      {"", "of `energy_balance`", "0.5"}),
               number("gain", &Fracture::gain, kSpeedGain, kPositive, {"", "of the speed of `energy_balance`", "0.2"}),
               other<Fracture>("growth", "rule",
                               {"that of `cracks`", "in place of the scene's, where the tip lies in this material"}),
               other<Fracture>("alternate", "rule", {"that of `cracks`", "the same of the alternate rule"}),
               plain("keeps_tips", &Fracture::keeps_tips,
                     {"", "a tip of this material stays one of it wherever it goes", "true"})});
  return keys;
}

const KeyTable<TractionLawDefinition>& traction_law_keys() {
  using Law = TractionLawDefinition;
  static const auto keys =
      KeyTable<Law>("cracks.traction_laws")
          .rows({word("kind", &Law::kind, words_of(kTractionKindNames), {kRequired, "below", "cubic"}),
                 other<Law>("normal", "map, below",
                            {"required but by `pressure`", "numbers of the opening", "{stiffness: 1 GPa/m}"}),
                 other<Law>("shear", "map, below", {"`normal`", "numbers along the faces"}),
                 other<Law>("curve", "`triangular`, `cubic`, `trilinear`, `exponential`",
                            {"`triangular`", "of `mixed`", "cubic"}),
                 number("mix", &Law::mix, kPlain, kNotNegative,
                        {"",
                         "exponent n of (G_I/G_Ic)^n + (G_II/G_IIc)^n = 1, at which the first four kinds fail; 0: when "
                         "one direction has failed",
                         "2"}),
                 number("pressure", &Law::pressure, kPressure, kAny,
                        {"required by `pressure`", "on the faces, of `t` alone; negative opens", "-2 MPa*t"}),
                 number("least_opening", &Law::least_opening, kLength, or_unset(-1.0, kNotNegative),
                        {"", "below which the pressure does not act", "1 mm"})});
  return keys;
}

}  // namespace mpm
