// Mutated scene files: each is built and runs, or is refused in one line that states the fault and its place. 200 of
// them with fixed seeds, with MPM_FULL 20,000; the environment variable MPM_FUZZ_CASES sets another number.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "mpm/advice/memory.hpp"
#include "mpm/material/material_point.hpp"
#include "mpm/math/build_info.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/sections/sections.hpp"
#include "mpm/simulation/simulation.hpp"
#include "scene_mutator.hpp"

namespace mpm {
namespace scene_fuzz_test {

constexpr int kCases = 200;
constexpr int kFullCases = 20000;
constexpr int kHangSeconds = 120;     // a case takes milliseconds; the rest is for a loaded machine or a sanitizer
constexpr double kMostToBuild = 2e5;  // particles: larger scenes are valid, but not cheap
constexpr double kMostToRun = 5000;
constexpr double kCoarse = 600;  // particles of a scene before it is mutated
constexpr int kPeriods = 2;
constexpr double kStepsAPeriod = 4.0;
constexpr double kMostSteps = 1000.0;

/// Ends the program when a case does not return.
class HangGuard {
 public:
  HangGuard() : thread_([this] { watch(); }) {}
  ~HangGuard() {
    done_ = true;
    thread_.join();
  }
  void begin(int number, const std::string& text) {
    const std::lock_guard<std::mutex> lock(mutex_);
    number_ = number;
    text_ = text;
    start_ = std::chrono::steady_clock::now();
  }

 private:
  void watch() {
    while (!done_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      const std::lock_guard<std::mutex> lock(mutex_);
      if (std::chrono::steady_clock::now() - start_ > std::chrono::seconds(kHangSeconds)) {
        std::fprintf(stderr, "case %d does not end:\n%s\n", number_, text_.c_str());
        std::abort();
      }
    }
  }
  std::atomic<bool> done_{false};
  std::mutex mutex_;
  int number_ = 0;
  std::string text_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::thread thread_;
};

/// Lattice positions in the bodies' bounds: at least as many as the particles that build() makes.
double places(const Scene& scene) {
  double sum = 0.0;
  for (const BodyDefinition& body : scene.bodies) {
    const Box bounds = body.region.bounds();
    double product = 1.0;
    for (const int axis : axes_of(scene)) {
      product *= std::max(1.0, (bounds.max[axis] - bounds.min[axis]) / particle_spacing(scene, axis));
    }
    sum += product;
  }
  return sum;
}

/// A scene of the repository on a grid coarse enough to be cheap; empty when there is none.
std::string coarse(const std::string& path) {
  const Vec3 cell = load_scene(path).definition.grid.cell;
  for (const char* particles : {"", "1"}) {
    for (int factor = 1; factor <= 64; ++factor) {
      std::vector<std::string> overrides = {"grid.cell=[" + std::to_string(factor * cell.x()) + ", " +
                                            std::to_string(factor * cell.y()) + ", " +
                                            std::to_string(factor * cell.z()) + "]"};
      if (cell.x() == cell.z()) overrides = {"grid.cell=" + std::to_string(factor * cell.x())};
      if (*particles != '\0') overrides.push_back("method.particles_per_cell=1");
      try {
        const Scene scene = load_scene(path, overrides);
        if (places(scene) > kCoarse) continue;
        build(scene);
        return scene.text;
      } catch (const SceneError&) {  // the domain is not a whole number of such cells, or a body is thinner than one
      }
    }
  }
  return "";
}

std::vector<std::string> base_scenes() {
  std::vector<std::string> texts;
  for (const char* folder : {"/config/scenes", "/test/data", "/test/verification/scenes"}) {
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(mpm::source_folder() + folder)) {
      if (entry.path().extension() == ".yaml") paths.push_back(entry.path().string());
    }
    std::sort(paths.begin(), paths.end());
    for (const std::string& path : paths) {
      std::string text = coarse(path);
      if (!text.empty()) texts.push_back(std::move(text));
    }
  }
  return texts;
}

double norm_at_start(const std::array<Function, 3>& motion) {
  try {
    return Vec3(motion[0](0.0), motion[1](0.0), motion[2](0.0)).norm();
  } catch (const FunctionError&) {
    return 0.0;  // the simulation reports it
  }
}

/// Shortens the sync period to few steps, whatever the material's stiffness; the real period may be thousands of steps
/// long. Returns false when even a nanosecond has too many.
bool shorten_period(SimulationDefinition& definition) {
  const std::vector<int> axes = axes_of(definition.geometry);
  double cell = definition.grid.cell.x();
  for (const int axis : axes) cell = std::min(cell, definition.grid.cell[axis]);
  double rate = 1.0;  // cells crossed per second by the fastest wave
  for (const MaterialDefinition& material : definition.materials) {
    const MaterialPoint point(material);
    const double diffusivity = std::visit([](const auto& law) { return law.diffusivity(1.0); }, point.law());
    rate = std::max(rate, point.wave_speed() / cell + 6.0 * diffusivity / (cell * cell));
  }
  for (const DeformableBody& body : definition.bodies) {
    for (const Vec3& velocity : body.velocities) rate = std::max(rate, velocity.norm() / cell);
  }
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    const Box bounds = body.surface->bounds();
    const double size = bounds.max[axes.back()] - bounds.min[axes.back()] + bounds.max.x() - bounds.min.x();
    rate = std::max(rate, (norm_at_start(body.velocity) + norm_at_start(body.rotation_rate) * size) / cell);
  }
  double step = definition.time.cfl / rate;
  const double damping = definition.method.damping.grid(0.0);
  if (damping > 0.0) step = std::min(step, definition.time.cfl / damping);
  if (definition.time.step) step = std::min(step, *definition.time.step);
  const double period = std::max(1.0, kStepsAPeriod * step * 1e9);
  if (period < static_cast<double>(definition.time.sync)) definition.time.sync = static_cast<std::int64_t>(period);
  return step * 1e9 > 1.0 / kMostSteps;
}

/// Builds and runs a scene; returns the outcome.
std::string outcome(const std::string& text) {
  const Scene scene = parse_scene(text, "fuzz.yaml");
  const double count = places(scene);
  if (count > kMostToBuild && count * 160.0 < 2.0 * usable_memory()) return "large";  // build() may make it
  SimulationDefinition definition = build(scene);
  if (count > kMostToRun || !shorten_period(definition)) return "built";
  Simulation simulation(definition, {1});
  simulation.keep_start();  // for the fields that use it
  for (int n = 0; n < kPeriods; ++n) simulation.advance();
  for (std::size_t b = 0; b < definition.rigid_bodies.size(); ++b) simulation.take_contact(static_cast<int>(b));
  std::vector<double> values;
  for (const auto& [name, unit] : Simulation::particle_fields()) simulation.particle_field(name, values);
  simulation.metrics();
  simulation.state();
  simulation.state_hash();
  return "ran";
}

/// The fault of an error's text, or "".
std::string fault_of(const std::string& what) {
  if (what.empty()) return "no text";
  if (what.size() > 1000) return "more than a line of text";
  for (const char c : what) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "a control character";
  }
  return "";
}

TEST(SceneFuzz, SpoiltScenesRunOrAreRefusedInOneLine) {
  const std::vector<std::string> bases = base_scenes();
  ASSERT_GE(bases.size(), 10U);
  int cases = std::getenv("MPM_FULL") == nullptr ? kCases : kFullCases;
  if (const char* number = std::getenv("MPM_FUZZ_CASES")) cases = std::atoi(number);
  std::map<std::string, int> seen;
  HangGuard guard;
  for (int number = 0; number < cases; ++number) {
    SceneMutator mutator(static_cast<unsigned>(number));
    const std::string text = mutator.mutate(bases[static_cast<std::size_t>(number) % bases.size()]);
    guard.begin(number, text);
    std::string what, fault;
    try {
      ++seen[outcome(text)];
    } catch (const PhysicsError& error) {
      ++seen["failed"];
      fault = fault_of(what = error.what());
    } catch (const SceneError& error) {
      ++seen["refused"];
      fault = fault_of(what = error.what());
      if (fault.empty() && what.rfind("fuzz.yaml:", 0) != 0) fault = "no place";
    } catch (const Error& error) {
      ++seen["refused by the simulation"];
      fault = fault_of(what = error.what());
    } catch (const std::exception& error) {
      what = error.what();
      fault = "not an error of the library";
    }
    EXPECT_EQ(fault, "") << "case " << number << ": " << what << "\n" << text;
  }
  for (const auto& [kind, count] : seen) std::printf("%5d %s\n", count, kind.c_str());
  // The mutations are neither so mild that nothing is refused nor so wild that nothing runs.
  EXPECT_GT(seen["refused"], cases / 3);
  EXPECT_GT(seen["ran"], cases / 20);
}

std::string refusal_of_block(double cell) {
  const std::string text = fmt::format(
      "grid: {{cell: {:.17g}, min: [0, 0, 0], max: [{:.17g}, {:.17g}, {:.17g}]}}\n"
      "method: {{particles_per_cell: 1}}\n"
      "materials: [{{name: m, density: 1, law: neo_hookean, young: 1, poisson: 0}}]\n"
      "bodies:\n"
      "  - {{name: block, material: m, shape: {{box: {{min: [0, 0, 0], max: [1, 1, 1]}}}}}}\n",
      cell, 1.0, 1.0, 1.0);
  try {
    build(parse_scene(text, "block.yaml"));
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

// A particle takes at least 240 bytes in three dimensions: 9 + 9 + 6 numbers of state, and 6 in its definition.
TEST(SceneFuzz, RefusesWhatNoMachineHolds) {
  const double edge = std::ceil(std::cbrt(1.2 * usable_memory() / 240.0));  // cells along it
  const std::string memory = refusal_of_block(1.0 / edge);
  EXPECT_EQ(memory.find("block.yaml:5: bodies.block.shape: with body 'block' there would be about "), 0U) << memory;
  EXPECT_NE(memory.find(edge * edge * edge < 2147483647.0 ? " GB can be had here: " : " particles, more than "),
            std::string::npos)
      << memory;
  const std::string number = refusal_of_block(1e-5);
  EXPECT_NE(number.find("about 1e+15 particles, more than 2147483647; make grid.cell larger"), std::string::npos)
      << number;
}

}  // namespace scene_fuzz_test
}  // namespace mpm
