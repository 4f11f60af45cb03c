// Profile of a run: what parts within others take is taken off, the rows of a run name its passes and modules and add
// up to its wall time, and it changes no bit. 0.2 s.
#include "mpm/loop/profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "mpm/loop/loop.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace profile_test {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

const TimeProfile::Row* find(const TimeProfile& profile, const std::string& name) {
  const auto& rows = profile.rows();
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

TEST(Profile, TakesPartsWithinOffWhatIsAround) {
  TimeProfile profile;
  const auto start = Clock::now();
  {
    const TimeProfile::Use use(&profile);
    const TimeProfile::Part outer("outer");
    for (int i = 0; i < 2; ++i) {
      const TimeProfile::Part inner([] { return std::string("inner"); });
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  const double whole = seconds_since(start);
  ASSERT_EQ(profile.rows().size(), 2U);
  EXPECT_EQ(find(profile, "outer")->calls, 1U);
  EXPECT_EQ(find(profile, "inner")->calls, 2U);
  EXPECT_GE(find(profile, "inner")->seconds, 0.02);
  EXPECT_LT(find(profile, "outer")->seconds, whole - 0.02 + 1e-6);
  EXPECT_LE(profile.seconds(), whole);
  EXPECT_NE(profile.table(2.0 * whole).find("else"), std::string::npos);
}

TEST(Profile, CountsALoopWithThePartOfItsName) {
  TimeProfile profile;
  std::vector<int> visits(100, 0);
  {
    const TimeProfile::Use use(&profile);
    const TimeProfile::Part pass("pass");
    for_all("pass", 2, 100, [&](int i) { ++visits[i]; });
    for_unlike("loop", 2, 100, [&](int i) { ++visits[i]; });
  }
  for_all("unseen", 2, 100, [&](int i) { ++visits[i]; });
  EXPECT_EQ(visits, std::vector<int>(100, 3));
  ASSERT_EQ(profile.rows().size(), 2U);
  EXPECT_EQ(find(profile, "pass")->calls, 1U);
  EXPECT_EQ(find(profile, "loop")->calls, 1U);
}

TEST(Profile, AsksForNoNameWithoutAProfile) {
  const TimeProfile::Part part([]() -> std::string { throw std::logic_error("asked"); });
}

std::string scene(const std::string& update) {
  return "geometry: plane_strain\ngravity: [0, -9.81]\nmethod: {update: " + update +
         "}\ngrid: {cell: 0.05, min: [0, 0], max: [1, 0.6]}\ntime: {end: 0.2, sync: 0.01}\n"
         "materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 30 "
         "deg}]\nbodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1, 0.4]}}}]\n"
         "rigid_bodies: [{name: plate, shape: {box: {size: [0.3, 0.2]}}, pose: {position: [0.5, 0.52]}, motion: "
         "{velocity: [0, -0.2]}}]\nboundaries: {all: slip}\n";
}

TEST(Profile, NamesPassesAndModules) {
  for (const std::string update : {"usf", "usl", "usavg", "implicit"}) {
    const Scene parsed = parse_scene(scene(update), "scene", {});
    TimeProfile profile;
    SimulationOptions options;
    options.threads = 1;
    Simulation plain(build(parsed), options);
    options.profile = &profile;
    Simulation run(build(parsed), options);
    const auto start = Clock::now();
    while (run.time() < 200'000'000) run.advance();
    const double whole = seconds_since(start);
    while (plain.time() < 200'000'000) plain.advance();
    EXPECT_EQ(run.memory_hash(), plain.memory_hash()) << update;
    const std::uint64_t steps = run.state().step.steps;
    for (const char* name : {"particles: momentum to the grid", "grid: momentum"}) {
      const TimeProfile::Row* row = find(profile, name);
      ASSERT_NE(row, nullptr) << update << name;
      EXPECT_GE(row->calls, steps) << update;
      EXPECT_GT(row->seconds, 0.0) << update;
    }
    EXPECT_EQ(find(profile, "implicit: sweeps") != nullptr, update == "implicit");
    EXPECT_LE(profile.seconds(), whole) << update;
    EXPECT_GT(profile.seconds(), 0.5 * whole) << update << "\n" << profile.table(whole);
  }
}

}  // namespace profile_test
}  // namespace mpm
