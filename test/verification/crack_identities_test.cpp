// Identities of explicit cracks, to round-off: what a crack must not change (crack reference 7.13).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "scene_run.hpp"

namespace verification {
namespace crack_identities_test {

using Changes = std::vector<std::string>;

// A soft plate that starts to bend and stretch; a wave crosses it in 0.13 s. Lengths that binary numbers hold exactly.
const std::string kPlate = R"yaml(
geometry: plane_strain
grid: {cell: 0.125, min: [-0.75, -0.75], max: [2.25, 2.25]}
time: {end: 1, sync: 5 ms, cfl: 0.4}
method: {shape: ugimp, update: usl, transfer: flip}
materials: [{name: rubber, density: 1000, law: linear_elastic, young: 100 kPa, poisson: 0.3}]
bodies: [{name: plate, material: rubber, shape: {box: {min: [0, 0], max: [1.5, 1.5]}}, initial: {velocity: ["0.2*z*x", "-0.3*(z-0.8)*x"]}}]
)yaml";

// From the left edge to the middle, between rows of particles.
const std::string kNotch = R"yaml(
cracks:
  list: [{name: notch, line: {from: [0.04, 0.8125], to: [0.77, 0.8125]}, start: exterior, end: tip}]
)yaml";

// Through the plate, across each other, between rows of particles.
const std::string kCross = R"yaml(
cracks:
  list:
    - {name: flat, line: {from: [0.04, 0.8125], to: [1.46, 0.8125]}, start: exterior, end: exterior}
    - {name: upright, line: {from: [0.8125, 0.04], to: [0.8125, 1.46]}, start: exterior, end: exterior}
)yaml";

mpm::Simulation simulation_of(const std::string& scene, const Changes& changes, int threads = 1) {
  return mpm::Simulation(mpm::parse_scene(scene, "crack.yaml", changes), {threads});
}

void advance(mpm::Simulation& simulation, int periods) {
  for (int k = 0; k < periods; ++k) simulation.advance();
}

/// The largest difference of a field between two runs.
double difference(const mpm::Simulation& one, const mpm::Simulation& other, const std::string& name) {
  const std::vector<double> a = field(one, name), b = field(other, name);
  EXPECT_EQ(a.size(), b.size());
  double most = 0.0;
  for (std::size_t p = 0; p < std::min(a.size(), b.size()); ++p) most = std::max(most, std::abs(a[p] - b[p]));
  return most;
}

struct Method {
  std::string name;
  Changes changes;
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all = [] {
    std::vector<Method> list;
    for (const char* shape : {"ugimp", "bspline2", "bspline3", "cpdi", "qcpdi", "dirac", "ugimp_stretch"}) {
      list.push_back({shape, {fmt::format("method.shape={}", shape)}});
    }
    for (const char* update : {"usf", "usavg"}) list.push_back({update, {fmt::format("method.update={}", update)}});
    for (const char* transfer : {"apic", "{xpic: 2}", "{fmpm: 2}", "{flip: 0.95}"}) {
      list.push_back({transfer, {fmt::format("method.transfer={}", transfer)}});
    }
    list.push_back({"single", {"method.precision=single"}});
    list.push_back({"average_dilatation", {"method.average_dilatation=true"}});
    return list;
  }();
  return all;
}

bool single(const Method& method) { return method.name == "single"; }

// One field: no crack. The plate moves by 0.01 m, its stresses are up to 1e4 Pa.
TEST(CrackIdentities, OneFieldIsNoCrack) {
  for (const Method& method : methods()) {
    Changes with = method.changes;
    with.push_back("cracks.list.notch.faces={law: one_field}");
    mpm::Simulation cracked = simulation_of(kPlate + kNotch, with), whole = simulation_of(kPlate, method.changes);
    advance(cracked, 6), advance(whole, 6);
    // Sums in another order: 1e3 times the spacing of numbers, of 1 m, 0.3 m/s and the modulus.
    const double scale = single(method) ? 1e9 : 1.0;
    EXPECT_LT(difference(cracked, whole, "x"), 2e-13 * (single(method) ? 1e7 : 1.0)) << method.name;
    EXPECT_LT(difference(cracked, whole, "vx"), 1e-12 * scale) << method.name;
    EXPECT_LT(difference(cracked, whole, "sxx"), 1e-8 * scale) << method.name;
  }
}

// Faces that stick and are pressed together, until waves from the free ends let go of them. With APIC particles take
// over the grid's velocity, which is that of one field: round-off. With FLIP they take over its change, which is that
// from the velocity of their own side: up to the 0.3 1/s of the start times the distance of the two sides' mean places.
TEST(CrackIdentities, FacesThatStickAreNoCrackUnderPressure) {
  for (const std::string update : {"usl", "usf", "usavg"}) {
    for (const std::string faces : {"{law: stick}", "{law: interface, normal: perfect, tangential: perfect}"}) {
      for (const std::string transfer : {"apic", "flip"}) {
        const Changes both = {"method.update=" + update, "method.transfer=" + transfer,
                              "bodies.plate.initial.velocity=[\"0.05*z\", \"-0.3*(z-0.8125)\"]"};
        Changes with = both;
        with.insert(with.end(), {"cracks.list.notch.faces=" + faces, "cracks.list.notch.end=none"});
        mpm::Simulation cracked = simulation_of(kPlate + kNotch, with), whole = simulation_of(kPlate, both);
        advance(cracked, 4), advance(whole, 4);
        const double limit = transfer == "apic" ? 1e-12 : 0.3 * 0.125;
        EXPECT_LT(difference(cracked, whole, "vx"), limit) << update << faces << transfer;
        EXPECT_LT(difference(cracked, whole, "vz"), limit) << update << faces << transfer;
      }
    }
  }
}

// The plate moves as one and falls. Nothing opens, J is 0, and the crack keeps its length.
TEST(CrackIdentities, RigidMotionOpensNothing) {
  for (const Method& method : methods()) {
    Changes changes = method.changes;
    changes.insert(changes.end(), {"bodies.plate.initial.velocity=[2, 1]", "gravity=[0, -9.81]"});
    mpm::Simulation simulation = simulation_of(kPlate + kNotch, changes);
    const double length = simulation.state().number("crack length 1");
    EXPECT_NEAR(length, 0.73, 1e-12);
    advance(simulation, 40);  // 3 cells along x
    const double round_off = single(method) ? 1e-6 : 1e-12;
    EXPECT_NEAR(simulation.state().number("crack length 1"), length, round_off) << method.name;
    EXPECT_NEAR(simulation.state().number("crack 1 end opening"), 0.0, round_off) << method.name;
    // Bound by J's scale, 100 kPa times 1 m: squares of strains from round-off, and in single precision 1/2 rho v^2
    // (2.5 kPa) times the round-off of strains.
    EXPECT_NEAR(simulation.state().number("crack 1 end j"), 0.0, single(method) ? 1e-2 : 1e-7) << method.name;
    for (const double v : field(simulation, "vx")) ASSERT_NEAR(v, 2.0, 10 * round_off) << method.name;
    for (const double v : field(simulation, "vz")) ASSERT_NEAR(v, 1.0 - 9.81 * 0.2, 10 * round_off) << method.name;
  }
}

/// The largest change of a particle's velocity since the start.
double change_of_velocity(const mpm::Simulation& simulation, const std::vector<double>& vx,
                          const std::vector<double>& vz) {
  const std::vector<double> x = field(simulation, "vx"), z = field(simulation, "vz");
  double most = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) most = std::max({most, std::abs(x[p] - vx[p]), std::abs(z[p] - vz[p])});
  return most;
}

double quarters_pull(const Changes& changes, int periods, double cross, double drift) {
  Changes all = {fmt::format(
      "bodies.plate.initial.velocity=[\"{0}+(x<{1} ? -0.5 : 0.5)\", \"{0}+(z<{1} ? -0.5 : 0.5)\"]", drift, cross)};
  all.insert(all.end(), changes.begin(), changes.end());
  mpm::Simulation simulation = simulation_of(kPlate + kCross, all);
  const std::vector<double> vx = field(simulation, "vx"), vz = field(simulation, "vz");
  double most = 0.0;
  for (int k = 0; k < periods; ++k) {
    simulation.advance();
    most = std::max(most, change_of_velocity(simulation, vx, vz));
  }
  return most;
}

// Four quarters that fly apart do not feel each other (fields 0 to 3), from the first step until they are 1.6 cells
// apart, also while all of them travel over the grid.
TEST(CrackIdentities, CrossingCracksLetFourQuartersGo) {
  for (const Method& method : methods()) {
    for (const double drift : {0.0, 1.5}) {
      EXPECT_LT(quarters_pull(method.changes, 40, 0.8125, drift), single(method) ? 1e-5 : 1e-11)
          << method.name << " " << drift;
    }
  }
}

// The same where cracks lie on grid lines, their corners on nodes, and their crossing is such a node.
TEST(CrackIdentities, CracksOnNodesLetFourQuartersGo) {
  const Changes on_nodes = {"cracks.list.flat.line={from: [0.0625, 0.75], to: [1.4375, 0.75]}",
                            "cracks.list.upright.line={from: [0.75, 0.0625], to: [0.75, 1.4375]}",
                            // Cubic B-splines reach farther than 4 segments of half a cell.
                            "cracks.list.flat.segment=1", "cracks.list.upright.segment=1"};
  for (const Method& method : methods()) {
    Changes changes = on_nodes;
    changes.insert(changes.end(), method.changes.begin(), method.changes.end());
    for (const double drift : {0.0, 1.5}) {
      EXPECT_LT(quarters_pull(changes, 20, 0.75, drift), single(method) ? 1e-5 : 1e-11) << method.name << " " << drift;
    }
  }
}

// About the axis: a disk between two halves of a cylinder.
TEST(CrackIdentities, HalvesOfACylinderPart) {
  const Changes about_axis = {"geometry=axisymmetric", "grid={cell: 0.125, min: [0, -0.75], max: [2.25, 2.25]}",
                              "bodies.plate.initial.velocity=[0, \"1+(z<0.8125 ? -0.5 : 0.5)\"]",
                              "cracks.list.notch.line={from: [0.03125, 0.8125], to: [1.46, 0.8125]}",
                              "cracks.list.notch.end=exterior"};
  for (const char* shape : {"ugimp", "cpdi"}) {
    for (const char* update : {"usl", "usf", "usavg"}) {
      Changes changes = about_axis;
      changes.insert(changes.end(), {fmt::format("method.shape={}", shape), fmt::format("method.update={}", update)});
      mpm::Simulation simulation = simulation_of(kPlate + kNotch, changes);
      const std::vector<double> vx = field(simulation, "vx"), vz = field(simulation, "vz");
      advance(simulation, 40);
      EXPECT_LT(change_of_velocity(simulation, vx, vz), 1e-11) << shape << " " << update;
    }
  }
}

/// Laws between the faces, and tractions, that act on each other.
std::vector<Method> actions() {
  std::vector<Method> list;
  for (const char* faces :
       {"{friction: 0.3}", "{friction: 0.3, detection: positions}", "{law: stick}",
        "{friction: 0.3, static_friction: 0.5, adhesion: 200}", "{law: interface, normal: 1e6, tangential: 1e5}"}) {
    list.push_back({faces, {fmt::format("cracks.list.notch.faces={}", faces), "cracks.list.notch.end=none"}});
  }
  list.push_back({"glue",
                  {"cracks.traction_laws={glue: {kind: triangular, normal: {strength: 500, opening: 0.01}}}",
                   "cracks.list.notch.traction=glue"}});
  list.push_back(
      {"growth",
       {"cracks.growth={criterion: release_rate, direction: self_similar}", "materials.rubber.fracture={j_ic: 0.05}"}});
  return list;
}

// Action of faces on each other adds nothing to the momentum.
TEST(CrackIdentities, MomentumIsKept) {
  for (const Method& action : actions()) {
    for (const char* velocity : {"[\"0.3*z\", \"-0.3*(z-0.8)*(1+x)\"]", "[\"0.3*z\", \"0.3*(z-0.8)*(1+x)\"]"}) {
      Changes changes = action.changes;
      changes.push_back(fmt::format("bodies.plate.initial.velocity={}", velocity));
      mpm::Simulation simulation = simulation_of(kPlate + kNotch, changes);
      advance(simulation, 20);
      EXPECT_LT(simulation.state().audit.residual, 1e-12) << action.name;
    }
  }
}

struct AtTip {
  double j = 0.0, one = 0.0, two = 0.0;
};

AtTip at_tip(const mpm::Simulation& simulation, const std::string& end) {
  const mpm::SolverState state = simulation.state();
  const std::string tip = "crack 1 " + end;
  return {state.number(tip + " j"), state.number(tip + " k_one"), state.number(tip + " k_two")};
}

// Two halves, whole as rigid bodies in the first step, leave each other with 1 mm/s; a force of 1 m/s^2 turns them
// around in a step of 4 ms. With rows of particles 1/4 and 3/4 of a cell from the rows of nodes, and the crack half
// way, the two rows of nodes beside it have 1.75 rows of particles of their own side and 0.25 of the other, whose
// reduced mass is 1.75 x 0.25 / 2, and lose their speed of approach to each other.
TEST(CrackIdentities, FacesThatTurnAroundMeetInThatStep) {
  const double start = 1e-3, push = 1.0, dt = 4e-3;
  mpm::Simulation simulation = simulation_of(
      kPlate +
          "cracks: {list: [{name: seam, line: {from: [0.04, 0.8125], to: [1.46, 0.8125]}, start: exterior, end: "
          "exterior}]}\n",
      {"time.sync=4 ms", "time.step=4 ms", "method.update=usavg",
       fmt::format("bodies.plate.initial.velocity=[0, \"z < 0.8125 ? -{0} : {0}\"]", start),
       fmt::format("loads=[{{body_force: {{acceleration: [0, \"Z < 0.8125 ? {0} : -{0}\"]}}}}]", push)});
  const std::vector<double> z = field(simulation, "z");
  simulation.advance();
  EXPECT_EQ(simulation.state().step.steps, 1u);
  const std::vector<double> v = field(simulation, "vz");
  double above = 0.0, below = 0.0;
  int rows_above = 0, rows_below = 0;
  for (std::size_t p = 0; p < z.size(); ++p) {
    (z[p] > 0.8125 ? above : below) += v[p];
    ++(z[p] > 0.8125 ? rows_above : rows_below);
  }
  const double approach = 2.0 * (push * dt - start), row = 24.0;  // particles of a row
  const double impulse = 2.0 * (1.75 * 0.25 / 2.0) * row * approach;
  EXPECT_NEAR(above / rows_above, start - push * dt + impulse / rows_above, 1e-12);
  EXPECT_NEAR(below / rows_below, push * dt - start - impulse / rows_below, 1e-12);
}

// J and K of one crack, told from its other end, or in a mirror. Waves run through the plate, in both modes.
TEST(CrackIdentities, ReversedAndMirroredCracksHaveTheSameTip) {
  struct Case {
    std::string name, from, to, velocity;
    bool reversed;
    double two;  ///< sign of K_II beside that of the first
  };
  // In the tip's frame K_II > 0 where the left side slides ahead; it keeps its sign when the crack is told in reverse,
  // and changes it in a mirror.
  const std::vector<Case> cases = {
      {"as it is", "[0.04, 0.8125]", "[0.77, 0.8125]", "[\"0.1*(z-0.8)\", \"0.3*(z-0.75)*(1+x)\"]", false, 1.0},
      {"reversed", "[0.77, 0.8125]", "[0.04, 0.8125]", "[\"0.1*(z-0.8)\", \"0.3*(z-0.75)*(1+x)\"]", true, 1.0},
      {"mirrored in x", "[1.46, 0.8125]", "[0.73, 0.8125]", "[\"-0.1*(z-0.8)\", \"0.3*(z-0.75)*(1+1.5-x)\"]", false,
       -1.0},
      {"mirrored in z", "[0.04, 0.6875]", "[0.77, 0.6875]", "[\"0.1*(0.7-z)\", \"0.3*(z-0.75)*(1+x)\"]", false, -1.0}};
  for (const char* split : {"interaction", "openings"}) {
    std::vector<AtTip> first;
    for (const Case& one : cases) {
      Changes changes = {"bodies.plate.initial.velocity=" + one.velocity, fmt::format("cracks.split={}", split),
                         fmt::format("cracks.list.notch.line={{from: {}, to: {}}}", one.from, one.to)};
      if (one.reversed)
        changes.insert(changes.end(), {"cracks.list.notch.start=tip", "cracks.list.notch.end=exterior"});
      mpm::Simulation simulation = simulation_of(kPlate + kNotch, changes);
      for (int k = 0; k < 12; ++k) {
        simulation.advance();
        const AtTip tip = at_tip(simulation, one.reversed ? "start" : "end");
        if (one.name == "as it is") {
          first.push_back(tip);
          continue;
        }
        EXPECT_NEAR(tip.j, first[k].j, 1e-9) << split << " " << one.name << " " << k;
        EXPECT_NEAR(tip.one, first[k].one, 1e-6) << split << " " << one.name << " " << k;
        EXPECT_NEAR(tip.two, one.two * first[k].two, 1e-6) << split << " " << one.name << " " << k;
      }
    }
    // There is something to compare, in both modes.
    EXPECT_GT(first.back().j, 1.0) << split;
    EXPECT_GT(first.back().one, 100.0) << split;
    EXPECT_GT(std::abs(first.back().two), 10.0) << split;
  }
}

// A plate that turns slowly, by 0.3 degrees, stays together. J is then the difference of two large terms: the kinetic
// energy on the contour, up to 0.7 J/m^3 on a path of 6 cells, 0.5 J/m^2, and its change inside.
TEST(CrackIdentities, SlowRotationOpensNothing) {
  mpm::Simulation simulation =
      simulation_of(kPlate + kNotch, {"bodies.plate.initial.velocity=[\"-0.05*(z-0.75)\", \"0.05*(x-0.75)\"]"});
  const double length = simulation.state().number("crack length 1");
  advance(simulation, 20);
  const mpm::SolverState state = simulation.state();
  EXPECT_NEAR(state.number("crack 1 end j"), 0.0, 0.02 * 0.5);
  EXPECT_NEAR(state.number("crack 1 end opening"), 0.0, 2e-3 * 0.005 * 0.75);  // part of the way of the plate's edges
  // A surface moves as its nodes do in the mean by mass, and that mean lies up to a quarter of a cell beside it.
  EXPECT_NEAR(state.number("crack length 1"), length, 0.25 * 0.125 * 0.3 * 0.0174533);
}

// The same bits for any number of threads, and after a checkpoint.
TEST(CrackIdentities, SameBitsForThreadsAndCheckpoints) {
  std::vector<Method> cases = actions();
  cases.insert(cases.end(), methods().begin(), methods().end());
  for (const Method& one : cases) {
    Changes changes = one.changes;
    changes.push_back("bodies.plate.initial.velocity=[\"1+0.3*z\", \"0.5*(z-0.8)*(1+x)\"]");
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 2, 3}) {
      mpm::Simulation simulation = simulation_of(kPlate + kNotch, changes, threads);
      advance(simulation, 16);
      hashes.push_back(simulation.state_hash());
      if (threads > 1) continue;
      const std::string file = fmt::format("{}/crack_identities.h5", testing::TempDir());
      mpm::Simulation stopped = simulation_of(kPlate + kNotch, changes);
      advance(stopped, 7);
      mpm::save_checkpoint(file, stopped, {"crack.yaml", "text", {}});
      mpm::Simulation resumed = simulation_of(kPlate + kNotch, changes, 2);
      advance(resumed, 3);  // so that there is something to forget
      mpm::load_checkpoint(file, resumed, "text");
      advance(resumed, 9);
      EXPECT_EQ(resumed.state_hash(), simulation.state_hash()) << one.name;
      EXPECT_EQ(resumed.memory_hash(), simulation.memory_hash()) << one.name;
      std::filesystem::remove(file);
    }
    EXPECT_EQ(hashes[0], hashes[1]) << one.name;
    EXPECT_EQ(hashes[0], hashes[2]) << one.name;
  }
}

// At some of these times particles have just been sorted, whatever the instruction set, and patches not made since.
// Cost: 0.2 s.
TEST(CrackIdentities, ACheckpointChangesNothingWheneverItIsWritten) {
  const Changes changes{"bodies.plate.initial.velocity=[\"1+0.3*z\", \"0.5*(z-0.8)*(1+x)\"]"};
  mpm::Simulation whole = simulation_of(kPlate + kNotch, changes);
  advance(whole, 16);
  const std::string file = fmt::format("{}/crack_identities_times.h5", testing::TempDir());
  for (int period = 1; period < 16; ++period) {
    SCOPED_TRACE(period);
    mpm::Simulation stopped = simulation_of(kPlate + kNotch, changes),
                    resumed = simulation_of(kPlate + kNotch, changes);
    advance(stopped, period);
    mpm::save_checkpoint(file, stopped, {"crack.yaml", "text", {}});
    mpm::load_checkpoint(file, resumed, "text");
    for (mpm::Simulation* one : {&stopped, &resumed}) {
      advance(*one, 16 - period);
      EXPECT_EQ(one->state_hash(), whole.state_hash());
      EXPECT_EQ(one->memory_hash(), whole.memory_hash());
    }
  }
  std::filesystem::remove(file);
}

}  // namespace crack_identities_test
}  // namespace verification
