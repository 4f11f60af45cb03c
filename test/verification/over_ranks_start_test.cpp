// Particles of a rank at its start: those that lie in its blocks, with the numbers and bits that one process gives
// them, whatever they are made from: regions, jitter, bodies that are cut out, functions of place, the weight of soil.
// And that a run goes on from there as from a definition of which every rank had all.
// Cost: 15 s.
#include <gtest/gtest.h>

#include <cmath>
#include <mutex>

#include "mpm/ranks/lists.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "rank_counts.hpp"
#include "scene_run.hpp"
#include "thread_communicator.hpp"

namespace verification {
namespace over_ranks_start_test {

const char* const kHead = R"(
gravity: [0, 0, -9.81]
time: {end: 1, sync: 1 ms}
materials:
  - {name: rubber, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}
  - {name: sand, density: 1500, law: drucker_prager, young: 1 MPa, poisson: 0.3, friction_angle: 35 deg}
)";

struct Start {
  const char* name;
  std::string scene;
};

std::ostream& operator<<(std::ostream& out, const Start& start) { return out << start.name; }

std::string text(const std::string& rest) { return kHead + rest; }

std::vector<Start> starts() {
  const std::string grid = "grid: {cell: 0.05, min: [-1, -1, -1], max: [1, 1, 1]}\n";
  const std::string coarse = "grid: {cell: 0.1, min: [-1, -1, -1], max: [1, 1, 1]}\n";
  const std::string wheel = source_file("config/meshes/rover_wheel.obj");
  return {
      {"Regions", text(grid + R"(
bodies:
  - {name: low, material: rubber, shape: {box: {min: [-0.8, -0.8, -1], max: [0.3, 0.8, -0.6]}}}
  - {name: ball, material: sand, shape: {sphere: {center: [0.2, 0.1, 0.2], radius: 0.5}}}
  - {name: rod, material: rubber, shape: {cylinder: {center: [-0.5, 0, 0], radius: 0.2, height: 1, axis: y}}}
)")},
      {"Functions", text(grid + R"(
bodies:
  - name: block
    material: rubber
    shape: {box: {min: [-0.6, -0.6, -0.6], max: [0.6, 0.6, 0.6]}}
    jitter: 0.2
    initial: {velocity: [sin(3 * x) * y, "0.1 * z", x], stress: {xx: -100 * x * y, zz: -50}}
loads:
  - {particle_force: {force: [1, 0, 0], body: block, region: {box: {min: [-0.6, -0.6, 0.3], max: [0.6, 0.6, 0.7]}}}}
  - {traction: {body: block, edge: x_max, traction: [10, 0, 0]}}
)")},
      {"CutOut", text(grid + R"(
bodies:
  - name: block
    material: rubber
    shape: {box: {min: [-0.6, -0.6, -0.6], max: [0.6, 0.6, 0.6]}}
    jitter: 0.1
    cut_out: [wheel]
rigid_bodies:
  - {name: wheel, shape: {mesh: {file: ")" +
                      wheel + R"("}}, pose: {position: [0.1, 0, 0.3]}, sides: one}
)")},
      {"Soil", text(coarse + R"(
bodies:
  - {name: bed, material: sand, shape: {box: {min: [-1, -1, -1], max: [1, 1, -0.5]}}, initial: geostatic}
  - name: pile
    material: rubber
    shape: {box: {min: [-0.5, -0.5, -0.5], max: [0.5, 0.5, -0.1]}}
    initial: {geostatic: {k0: 0.5, residual: 0.02}}
  - {name: block, material: rubber, shape: {box: {min: [-0.2, -0.2, 0.2], max: [0.2, 0.2, 0.6]}}}
loads:
  - pressure: {body: block, edge: z_max, value: 10, region: {box: {min: [-0.2, -0.2, 0.56], max: [0.2, 0.2, 0.6]}}}
boundaries: {x_min: slip, x_max: slip, y_min: slip, y_max: slip, z_min: {friction: 0.5}}
)")},
  };
}

/// Functions of a scene hold one evaluation at a time, so ranks that are threads have scenes of their own.
mpm::Scene scene_of(const Start& start) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  return mpm::parse_scene(start.scene, "start.yaml");
}

class OverRanksStart : public testing::TestWithParam<Start> {};

TEST_P(OverRanksStart, HasItsOwnParticlesOfThoseOfOneProcess) {
  const mpm::SimulationDefinition whole = mpm::build(scene_of(GetParam()));
  for (const int count : mpm::test::rank_counts({1, 2, 5}, 2)) {
    SCOPED_TRACE(count);
    mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
      const mpm::SimulationDefinition own = mpm::build(scene_of(GetParam()), &ranks);
      ASSERT_EQ(own.bodies.size(), whole.bodies.size());
      double here = 0.0, all = 0.0;
      for (std::size_t b = 0; b < whole.bodies.size(); ++b) {
        const mpm::DeformableBody &part = own.bodies[b], &body = whole.bodies[b];
        ASSERT_TRUE(part.part.has_value());
        const std::vector<std::uint32_t>& numbers = part.part->numbers;
        ASSERT_EQ(part.positions.size(), numbers.size());
        EXPECT_EQ(part.part->whole, body.positions.size());
        EXPECT_EQ(part.particle_volume, body.particle_volume);
        int other = 0;
        for (std::size_t p = 0; p < numbers.size(); ++p) {
          const std::uint32_t n = numbers[p];
          other += part.positions[p] != body.positions.at(n);
          if (!body.velocities.empty()) other += part.velocities.at(p) != body.velocities.at(n);
          if (!body.stresses.empty()) {
            const auto &a = part.stresses.at(p), &c = body.stresses.at(n);
            other += a.xx != c.xx || a.yy != c.yy || a.zz != c.zz || a.xy != c.xy || a.xz != c.xz || a.yz != c.yz;
          }
        }
        EXPECT_EQ(other, 0) << body.name;
        std::vector<std::uint32_t> of_all = mpm::gather_list(ranks, numbers);
        std::sort(of_all.begin(), of_all.end());
        ASSERT_EQ(of_all.size(), body.positions.size());
        for (std::uint32_t n = 0; n < of_all.size(); ++n) ASSERT_EQ(of_all[n], n);
        here += static_cast<double>(numbers.size());
        all += static_cast<double>(of_all.size());
      }
      ASSERT_EQ(own.particle_forces.size(), whole.particle_forces.size());
      for (std::size_t i = 0; i < whole.particle_forces.size(); ++i) {
        EXPECT_EQ(own.particle_forces[i].particles, whole.particle_forces[i].particles);
      }
      ASSERT_EQ(own.tractions.size(), whole.tractions.size());
      for (std::size_t i = 0; i < whole.tractions.size(); ++i) {
        EXPECT_EQ(own.tractions[i].particles, whole.tractions[i].particles);
      }
      EXPECT_LT(here, 1.5 * all / count) << "a rank has more than its part";
    });
  }
}

/// State that a run begins with.
struct Begun {
  std::uint64_t state_hash = 0, memory_hash = 0, later_hash = 0, particles = 0;
  std::vector<std::vector<double>> fields;  ///< by id
};

const std::vector<const char*> kFields = {"x", "y", "z", "vx", "vz", "sxx", "syy", "szz", "sxz", "j", "mass"};

Begun begin(mpm::Simulation& simulation) {
  Begun begun;
  begun.particles = simulation.particles();
  for (const char* name : kFields) begun.fields.push_back(field(simulation, name));
  begun.state_hash = simulation.state_hash();
  begun.memory_hash = simulation.memory_hash();
  for (int period = 0; period < 3; ++period) simulation.advance();
  begun.later_hash = simulation.state_hash();
  return begun;
}

/// `build_whole`: every rank is given all particles, and leaves its own.
Begun begin_over(const Start& start, int count, bool build_whole, bool settle) {
  Begun of_first;
  mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
    const mpm::Scene scene = scene_of(start);
    mpm::SimulationOptions options;
    options.threads = 1;
    options.settle = settle;
    options.ranks = {&ranks, [](mpm::Communicator*) {}};
    mpm::Simulation simulation(mpm::build(scene, build_whole ? nullptr : &ranks), options);
    Begun own = begin(simulation);
    if (ranks.first()) of_first = std::move(own);
  });
  return of_first;
}

TEST_P(OverRanksStart, RunsAsFromADefinitionOfWhichEveryRankHasAll) {
  const Begun own = begin_over(GetParam(), 3, false, true), whole = begin_over(GetParam(), 3, true, true);
  EXPECT_EQ(own.state_hash, whole.state_hash);
  EXPECT_EQ(own.memory_hash, whole.memory_hash);
  EXPECT_EQ(own.later_hash, whole.later_hash);
}

TEST_P(OverRanksStart, HasTheFieldsOfOneProcessToTheBit) {
  mpm::SimulationOptions options;
  options.threads = 1;
  options.settle = false;
  mpm::Simulation simulation(mpm::build(scene_of(GetParam())), options);
  const Begun process = begin(simulation), over = begin_over(GetParam(), 3, false, false);
  EXPECT_EQ(over.particles, process.particles);
  for (std::size_t k = 0; k < kFields.size(); ++k) {
    ASSERT_EQ(over.fields[k].size(), process.fields[k].size());
    int other = 0;
    for (std::size_t id = 0; id < process.fields[k].size(); ++id) {
      other += over.fields[k][id] != process.fields[k][id];
    }
    EXPECT_EQ(other, 0) << kFields[k];
  }
}

// Settled on all ranks together: the same rest, found by sums in another order.
TEST(OverRanksSettling, EndsAsOnOneProcess) {
  const Start soil = starts().back();
  mpm::SimulationOptions options;
  options.threads = 1;
  mpm::Simulation simulation(mpm::build(scene_of(soil)), options);
  const Begun process = begin(simulation);
  ASSERT_FALSE(simulation.notes().empty());
  for (const int count : {1, 3}) {
    const Begun over = begin_over(soil, count, false, true);
    for (std::size_t k = 0; k < kFields.size(); ++k) {
      double largest = 0.0, off = 0.0;
      for (std::size_t id = 0; id < process.fields[k].size(); ++id) {
        largest = std::max(largest, std::abs(process.fields[k][id]));
        off = std::max(off, std::abs(process.fields[k][id] - over.fields[k][id]));
      }
      EXPECT_LE(off, 1e-10 * largest) << kFields[k] << " on " << count;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, OverRanksStart, testing::ValuesIn(starts()),
                         [](const auto& start) { return std::string(start.param.name); });

// A fault that one rank alone sees is told by all.
TEST(OverRanksStartFaults, AreThoseOfOneProcess) {
  const std::string grid = "grid: {cell: 0.05, min: [-1, -1, -1], max: [1, 1, 1]}\n";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {text(grid + "bodies: [{name: block, material: rubber, shape: {box: {min: [-0.6, -0.6, -0.6], max: [0.6, 0.6, "
                   "0.6]}}, initial: {velocity: [\"sqrt(x + 0.58)\", 0, 0]}}]\n"),
       "initial velocity of body 'block'"},
      {text(grid + "bodies: [{name: a, material: rubber, shape: {box: {min: [-0.6, -0.6, -0.6], max: [0.1, 0.6, "
                   "0.6]}}}, {name: b, material: rubber, shape: {box: {min: [0, -0.6, -0.6], max: [0.6, 0.6, 0.6]}}}]"),
       "overlap"}};
  for (const auto& [scene, part] : faults) {
    const auto reason = [&scene = scene](mpm::Communicator* ranks) {
      try {
        mpm::build(scene_of({"fault", scene}), ranks);
      } catch (const mpm::SceneError& error) {
        return std::string(error.what());
      }
      return std::string("none");
    };
    const std::string alone = reason(nullptr);
    EXPECT_NE(alone.find(part), std::string::npos) << alone;
    int told = 0;
    std::mutex one_at_a_time;
    mpm::run_ranks(3, [&](mpm::Communicator& ranks) {
      const bool same = reason(&ranks) == alone;
      const std::lock_guard<std::mutex> lock(one_at_a_time);
      told += same;
    });
    EXPECT_EQ(told, 3) << alone;
  }
}

}  // namespace over_ranks_start_test
}  // namespace verification
