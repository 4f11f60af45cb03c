// method: every word and form that is read, valid combinations, and each refusal with its place. Expected texts are
// written by hand from the rule "file:line: key.path: what; what to write instead".
#include <gtest/gtest.h>

#include "mpm/advice/explain.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_method_test {

using Of = FeedbackDefinition::Of;

const char* const kPlanar =
    "geometry: plane_strain\n"
    "grid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
    "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.3}]\n"
    "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2], max: [0.6, 0.6]}}}]\n";
const char* const kSolid =
    "geometry: solid\n"
    "grid: {cell: 0.1, min: [0, 0, 0], max: [1, 1, 1]}\n"
    "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.3}]\n"
    "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2, 0.2], max: [0.6, 0.6, 0.6]}}}]\n";

MethodDefinition method_of(const std::string& keys, const char* scene = kPlanar) {
  return parse_scene(scene + ("method: {" + keys + "}\n"), "test.yaml").definition.method;
}

void expect_refused(const std::string& keys, const std::string& expected, const char* scene = kPlanar) {
  std::string found = "no error";
  try {
    parse_scene(scene + ("method: {" + keys + "}\n"), "bad.yaml");
  } catch (const SceneError& error) {
    found = error.what();
  }
  EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  const std::string start = "bad.yaml:5: method." + expected;
  EXPECT_EQ(found.substr(0, start.size()), start) << "whole text: " << found;
}

void expect_said(const std::string& keys, const std::string& part, const char* scene = kPlanar) {
  try {
    parse_scene(scene + ("method: {" + keys + "}\n"), "bad.yaml");
    ADD_FAILURE() << keys << " is not refused";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << "\nnot in: " << error.what();
  }
}

// Plain FLIP leaves noise in soil that flows. What a scene names stays, and a part of PIC in the damping is the same.
TEST(SceneMethod, SoilThatFlowsHasALittleXpic) {
  const std::string sand =
      "geometry: plane_strain\n"
      "grid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
      "materials: [{name: soft, density: 1600, law: drucker_prager, young: 1e6, poisson: 0.3, friction_angle: 30 "
      "deg}]\n"
      "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2], max: [0.6, 0.6]}}}]\n";
  const auto transfer_of = [&](const std::string& section) {
    const Transfer transfer = parse_scene(sand + section, "test.yaml").definition.method.transfer;
    EXPECT_EQ(transfer.kind, TransferKind::flip) << section;
    return transfer_text(transfer);
  };
  for (const char* section : {"", "method: auto\n", "method: {update: usf}\n", "method: {auto: {error: 10 %}}\n"}) {
    EXPECT_EQ(transfer_of(section), "flip 0.6 and xpic 2 in one of 5 steps") << section;
  }
  EXPECT_EQ(transfer_of("method: {transfer: flip}\n"), "flip");
  EXPECT_EQ(transfer_of("method: {transfer: {flip: 0.99}}\n"), "flip 0.99");
  EXPECT_EQ(transfer_of("method: {damping: {pic: \"0.01*t\"}}\n"), "flip");
  EXPECT_EQ(method_of("update: usf").transfer.flip, 1.0);
}

TEST(SceneMethod, FlipIsMixedWithXpic) {
  const Transfer transfer = method_of("transfer: {flip: 0.7, xpic: 3, every: 4}").transfer;
  EXPECT_EQ(transfer.kind, TransferKind::flip);
  EXPECT_EQ(transfer.flip, 0.7);
  EXPECT_EQ(transfer.mixed, 3);
  EXPECT_EQ(transfer.every, 4);
  EXPECT_EQ(transfer_text(method_of("transfer: {flip: 0, every: 10}").transfer), "flip 0 in one of 10 steps");
  expect_refused("transfer: {flip: 0.7, xpic: 0}", "transfer.xpic: order 0 is not possible;");
  expect_refused("transfer: {flip: 0.7, every: 0}", "transfer.every: 0 is not possible;");
  expect_refused("transfer: {flip: 0.7, fmpm: 2}", "transfer.fmpm: unknown key 'fmpm'");
  expect_refused("transfer: {flip: 1, every: 2}, damping: {pic: 0.1}", "damping.pic: transfer says another part");
}

TEST(SceneMethod, EveryShapeAndItsOtherName) {
  for (std::size_t i = 0; i < kShapeTraits.size(); ++i) {
    EXPECT_EQ(method_of(std::string("shape: ") + kShapeTraits[i].name).shape, static_cast<ShapeKind>(i))
        << kShapeTraits[i].name;
  }
  EXPECT_EQ(method_of("shape: classic").shape, ShapeKind::dirac);
  EXPECT_EQ(method_of("shape: lcpdi").shape, ShapeKind::cpdi);
  EXPECT_EQ(method_of("shape: gimp").shape, ShapeKind::ugimp);
  expect_refused("shape: gmp", "shape: 'gmp' is not known; did you mean 'gimp'?");
}

TEST(SceneMethod, EveryUpdateAndItsOtherName) {
  EXPECT_EQ(method_of("update: usf").update, UpdateScheme::usf);
  EXPECT_EQ(method_of("update: usl").update, UpdateScheme::usl);
  EXPECT_EQ(method_of("update: musl").update, UpdateScheme::usl);
  EXPECT_EQ(method_of("update: usavg").update, UpdateScheme::usavg);
}

TEST(SceneMethod, EveryTransfer) {
  EXPECT_EQ(method_of("transfer: flip").transfer.flip, 1.0);
  EXPECT_EQ(method_of("transfer: pic").transfer.kind, TransferKind::flip);
  EXPECT_EQ(method_of("transfer: pic").transfer.flip, 0.0);
  EXPECT_EQ(method_of("transfer: {flip: 0.99}").transfer.flip, 0.99);
  EXPECT_EQ(method_of("transfer: apic").transfer.kind, TransferKind::apic);
  EXPECT_EQ(method_of("transfer: {xpic: 3}").transfer.kind, TransferKind::xpic);
  EXPECT_EQ(method_of("transfer: {xpic: 3}").transfer.order, 3);
  EXPECT_EQ(method_of("transfer: {fmpm: 20}").transfer.kind, TransferKind::fmpm);
  EXPECT_EQ(method_of("transfer: {fmpm: 20}").transfer.order, 20);
  EXPECT_FALSE(method_of("transfer: apic").average_dilatation);
  EXPECT_TRUE(method_of("average_dilatation: true").average_dilatation);
  EXPECT_FALSE(method_of("average_dilatation: false").average_dilatation);
  EXPECT_FALSE(method_of("transfer: apic").average_stress.has_value());
  EXPECT_EQ(method_of("average_stress: true").average_stress, true);
  EXPECT_EQ(method_of("average_stress: false").average_stress, false);
}

TEST(SceneMethod, BadTransfersSayWhatToWrite) {
  expect_refused("transfer: xpic", "transfer: give its order, as in {xpic: 2}");
  expect_refused("transfer: fmpm", "transfer: give its order, as in {fmpm: 2}");
  expect_refused("transfer: {xpic: 0}", "transfer.xpic: order 0 is not possible; write 1 (which is PIC) to 20");
  expect_refused("transfer: {fmpm: 21}", "transfer.fmpm: order 21 is not possible;");
  expect_refused("transfer: {xpic: 2.5}", "transfer.xpic: '2.5' is not a whole number;");
  expect_refused("transfer: {flip: 1.01}", "transfer.flip: '1.01' is not a fraction; write one from 0 (PIC) to 1");
  expect_refused("transfer: {flip: -0.1}", "transfer.flip: '-0.1' is less than 0;");
  expect_refused("average_dilatation: yse", "average_dilatation: 'yse' is not known;");
  expect_refused("gradient_terms: 13", "gradient_terms: 13 is more than 12; write a whole number from 1 to 12");
}

// Impossible combinations are refused with an alternative, and in the same words for a definition made in code.
TEST(SceneMethod, CombinationsThatCannotWork) {
  EXPECT_NO_THROW(method_of("shape: qcpdi"));
  expect_refused("shape: qcpdi", "shape: qcpdi has the nine points of a parallelogram and is planar; use cpdi", kSolid);
  for (const char* shape : {"ugimp", "ugimp_stretch", "cpdi", "qcpdi", "bspline2", "bspline3"}) {
    EXPECT_NO_THROW(method_of(std::string("transfer: apic, shape: ") + shape)) << shape;
  }
  expect_refused("shape: dirac, transfer: apic", "transfer: apic and particles that are points");
  expect_said("shape: dirac, transfer: apic", "use another shape, such as ugimp, or transfer {xpic: 2}");
  // 9 particles per cell are 3 along an edge in a planar scene; in a solid one they are not possible.
  EXPECT_EQ(method_of("particles_per_cell: 9").particles_per_direction, 3);
  expect_refused("particles_per_cell: 9", "particles_per_cell: 9 is not possible; a solid scene has 1, 8 or 27",
                 kSolid);

  MethodDefinition method;
  method.average_dilatation = true;
  EXPECT_EQ(method_fault(method, GeometryKind::line)->key, "average_dilatation");
  EXPECT_EQ(method_fault(method, GeometryKind::plane_stress)->key, "average_dilatation");
  EXPECT_FALSE(method_fault(method, GeometryKind::plane_strain));
  EXPECT_FALSE(method_fault(method, GeometryKind::solid));
  method = {};
  method.average_stress = true;
  EXPECT_EQ(method_fault(method, GeometryKind::line)->key, "average_stress");
  EXPECT_EQ(method_fault(method, GeometryKind::plane_stress)->key, "average_stress");
  EXPECT_FALSE(method_fault(method, GeometryKind::axisymmetric));
  // By itself where soil can lock, and nothing else is done against it.
  method = {};
  EXPECT_TRUE(averages_stress(method, GeometryKind::solid));
  EXPECT_FALSE(averages_stress(method, GeometryKind::line));
  EXPECT_FALSE(averages_stress(method, GeometryKind::plane_stress));
  method.average_dilatation = true;
  EXPECT_FALSE(averages_stress(method, GeometryKind::solid));
  method.average_stress = true;
  EXPECT_TRUE(averages_stress(method, GeometryKind::solid));
  method = {};
  method.shape = ShapeKind::qcpdi;
  EXPECT_EQ(method_fault(method, GeometryKind::line)->key, "shape");
  EXPECT_FALSE(method_fault(method, GeometryKind::plane_stress));

  SimulationDefinition by_hand = build(parse_scene(kSolid, "hand.yaml"));
  by_hand.method.shape = ShapeKind::qcpdi;
  try {
    Simulation simulation(by_hand);
    FAIL() << "qcpdi was built in three dimensions";
  } catch (const DefinitionError& error) {
    EXPECT_EQ(std::string(error.what()),
              "method.shape: qcpdi has the nine points of a parallelogram and is planar; use cpdi");
  }
}

TEST(SceneMethod, DampingIsANumberAFunctionOrAMap) {
  const DampingDefinition number = method_of("damping: 5").damping;
  EXPECT_EQ(number.grid(0.0), 5.0);
  EXPECT_TRUE(number.in_force && number.any() && !number.in_update());
  EXPECT_FALSE(method_of("damping: 0").damping.any());
  EXPECT_NO_THROW(method_of("damping: {grid: 0, placement: force}"));
  for (const char* keys : {"", "particle: 3, ", "pic: 0.1, "}) {
    expect_refused(
        "damping: {" + std::string(keys) + "placement: update}",
        "damping.placement: it says where grid and feedback act, and neither is there; write one of them, or "
        "leave it out");
  }
  const DampingDefinition of_time = method_of("damping: \"10*(t<1)\"").damping;
  EXPECT_EQ(of_time.grid(0.5), 10.0);
  EXPECT_EQ(of_time.grid(1.5), 0.0);
  EXPECT_TRUE(of_time.in_force);
  // A rate that depends on position is evaluated at the particles.
  const DampingDefinition of_place = method_of("damping: \"10*x\"").damping;
  EXPECT_FALSE(of_place.in_force);
  EXPECT_TRUE(of_place.in_update());

  const DampingDefinition all = method_of(
                                    "damping: {grid: 20 1/s, particle: \"t\", pic: 1 %, placement: update, "
                                    "feedback: {gain: 4 1/mm^2, target: \"2*t\", limit: 100, of: particle}}")
                                    .damping;
  EXPECT_EQ(all.grid(0.0), 20.0);
  EXPECT_EQ(all.particle(3.0), 3.0);
  EXPECT_EQ(all.pic(0.0), 0.01);
  EXPECT_FALSE(all.in_force);
  ASSERT_TRUE(all.feedback);
  EXPECT_NEAR(all.feedback->gain, 4e6, 1e-8);  // round-off of (1 mm)^-2
  EXPECT_EQ(all.feedback->target(3.0), 6.0);
  EXPECT_EQ(all.feedback->limit, 100.0);
  EXPECT_EQ(all.feedback->of, Of::particle);
  const DampingDefinition feedback = method_of("damping: {feedback: {gain: 7}}").damping;
  EXPECT_EQ(feedback.feedback->target(1.0), 0.0);
  EXPECT_EQ(feedback.feedback->limit, std::numeric_limits<double>::infinity());
  EXPECT_EQ(feedback.feedback->of, Of::grid);
  EXPECT_TRUE(feedback.any() && feedback.in_force && !feedback.in_update());
}

// mm-g-s: a rate is unchanged, a gain is per mm^2, an energy is g mm^2/s^2 = 1e-9 J.
TEST(SceneMethod, DampingIsInTheUnitsOfTheScene) {
  const DampingDefinition damping =
      parse_scene(std::string("units: mm-g-s\n") + kPlanar +
                      "method: {damping: {grid: 3, feedback: {gain: 2, target: \"5*t\", limit: 9}}}\n",
                  "test.yaml")
          .definition.method.damping;
  EXPECT_EQ(damping.grid(0.0), 3.0);
  EXPECT_NEAR(damping.feedback->gain, 2e6, 1e-8);
  EXPECT_NEAR(damping.feedback->target(2.0), 1e-8, 1e-22);
  EXPECT_EQ(damping.feedback->limit, 9.0);
}

TEST(SceneMethod, BadDampingSaysWhatToWrite) {
  expect_refused("damping: -1", "damping: '-1' is less than 0;");
  expect_refused("damping: 5 m", "damping: '5 m' is a length, but a rate is expected;");
  expect_refused("damping: {grd: 5}", "damping.grd: unknown key 'grd'; did you mean 'grid'?");
  expect_refused("damping: {particle: -2}", "damping.particle: '-2' is less than 0;");
  expect_refused("damping: {grid: \"5*X\"}", "damping.grid: expression '5*X': unknown name 'X'; write 'x'");
  expect_refused("damping: {pic: 1.5}", "damping.pic: '1.5' is more than 1; write a number from 0 to 1");
  expect_refused("damping: {grid: 5, placement: node}", "damping.placement: 'node' is not known; write one of update");
  expect_refused("damping: {grid: \"5*x\", placement: force}",
                 "damping.placement: a rate that is a function of place is read at the particles, not at the nodes; "
                 "use placement: update");
  expect_refused("damping: {feedback: {}}", "damping.feedback: the key 'gain' is missing; add it");
  expect_refused("damping: {feedback: {target: 1}}", "damping.feedback: the key 'gain' is missing; add it");
  expect_refused("damping: {feedback: {gain: 0}}", "damping.feedback.gain: '0' is not greater than 0;");
  expect_refused("damping: {feedback: {gain: 1, limit: 0}}", "damping.feedback.limit: '0' is not greater than 0;");
  expect_refused("damping: {feedback: {gain: 1, target: \"x\"}}",
                 "damping.feedback.target: the target is the energy of all bodies; write a function of t alone");
}

// A part of PIC is possible with FLIP only, and may be given once.
TEST(SceneMethod, PartsOfPicGoWithFlipAlone) {
  EXPECT_NO_THROW(method_of("damping: {pic: \"0.1*(t<1)\"}"));
  EXPECT_NO_THROW(method_of("transfer: flip, damping: {pic: \"0.1*x\"}"));
  expect_refused("transfer: {flip: 0.9}, damping: {pic: 0.1}", "damping.pic: transfer says it too, with a FLIP");
  for (const char* transfer : {"{xpic: 2}", "{fmpm: 2}", "apic"}) {
    expect_refused(std::string("transfer: ") + transfer + ", damping: {pic: 0.1}",
                   "damping.pic: transfer " + std::string(transfer).substr(transfer[0] == '{' ? 1 : 0, 4));
  }
}

// Damping of the particles' velocity would not damp APIC's matrix, so rotation and shear would continue.
TEST(SceneMethod, ApicIsDampedOnTheNodes) {
  EXPECT_NO_THROW(method_of("transfer: apic, damping: 5"));
  EXPECT_NO_THROW(method_of("transfer: apic, damping: {feedback: {gain: 1}}"));
  for (const char* damping : {"{particle: 5}", "{grid: 5, placement: update}", "\"5*x\"",
                              "{feedback: {gain: 1, of: particle}}", "{feedback: {gain: 1}, placement: update}"}) {
    expect_refused(std::string("transfer: apic, damping: ") + damping,
                   "damping: damping of the particles' velocity and apic");
  }
}

// The largest stable steps of APIC and of FMPM(5) are smaller than a cell over the wave speed (doc/methods.md, the time
// step); steps at the limit, and FMPM(3), run without a warning.
TEST(SceneMethod, StepsThatATransferCannotTakeAreWarnedOf) {
  const auto warnings = [](const std::string& transfer, const std::string& cfl) {
    return Simulation(build(parse_scene(
                          kPlanar + ("method: {transfer: " + transfer + "}\ntime: {end: 0.1, cfl: " + cfl + "}\n"),
                          "test.yaml")))
        .warnings();
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(warnings("apic", "0.8"),
            Lines{"time.cfl is 0.8: with apic steps that long may be unstable; use at most 0.7"});
  EXPECT_EQ(warnings("{fmpm: 5}", "0.95"),
            Lines{"time.cfl is 0.95: with fmpm 5 steps that long may be unstable; use at most 0.9"});
  EXPECT_EQ(warnings("apic", "0.7"), Lines{});
  EXPECT_EQ(warnings("{fmpm: 5}", "0.9"), Lines{});
  EXPECT_EQ(warnings("{fmpm: 3}", "0.95"), Lines{});
  EXPECT_EQ(warnings("flip", "0.95"), Lines{});
}

TEST(SceneMethod, IsSaidAsScenesSpellIt) {
  EXPECT_EQ(method_text(MethodDefinition{}),
            "ugimp, usavg, flip, double precision, 2 terms of the deformation's exponential");
  EXPECT_EQ(method_text(method_of("shape: cpdi, update: usl, transfer: {fmpm: 3}, gradient_terms: 1, "
                                  "precision: single, average_dilatation: true, damping: 5")),
            "cpdi, usl, fmpm 3, single precision, 1 term of the deformation's exponential, averaged dilatation, "
            "damping: grid 5 1/s in the force");
  EXPECT_EQ(transfer_text(method_of("transfer: pic").transfer), "pic");
  EXPECT_EQ(transfer_text(method_of("transfer: {flip: 0.99}").transfer), "flip 0.99");
  EXPECT_EQ(transfer_text(method_of("transfer: apic").transfer), "apic");
  EXPECT_EQ(
      damping_text(method_of("damping: {grid: \"5*x\", particle: 2, pic: 0.1, feedback: {gain: 3, limit: 9}}").damping),
      "grid \"5*x\" in the update, particle 2 1/s, pic 0.1 a step, feedback of the grid, gain 3 1/m^2, target "
      "0 J, at most 9 1/s, in the update");
  const Scene scene = parse_scene(std::string(kPlanar) + "method: {transfer: {flip: 0.5}}\n", "test.yaml");
  EXPECT_NE(explain(scene, build(scene)).find("method: plane strain, 1 m thick, ugimp, usavg, flip 0.5,"),
            std::string::npos);
}

}  // namespace scene_method_test
}  // namespace mpm
