// Ground that is there around the bodies that it follows: what comes and goes is counted to round-off, comes back as it
// was where nothing has moved it, and its number of particles is that of the window however far the drive. Cost: 6 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "checkpoint_run.hpp"
#include "mpm/bed/kept_ground.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/particles/append.hpp"
#include "mpm/simulation/state_set.hpp"
#include "sleep_run.hpp"

namespace mpm::test {
namespace following_bed_test {

// Columns are four cells, so 0.2 m, and have 4 x 2 particles along x, 16 of them along z.
const char* const kDrive = R"yaml(
geometry: plane_strain
thickness: 0.1
grid: {cell: 0.05, min: [0, 0], max: [12, 1.2]}
time: {end: 5, sync: 10 ms, cfl: 0.5}
method: {update: usavg}
gravity: [0, -9.81]
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [12, 0.4]}}, initial: geostatic, cut_out: [blade]}]
rigid_bodies:
  - {name: blade, shape: {box: {size: [0.15, 0.3]}}, pose: {position: [2, 0.62]}, friction: 0.3,
     motion: {velocity: ["2*min(1, t/0.1)", 0]}}
boundaries: {x_min: slip, x_max: slip, z_min: {friction: 0.6}}
sleep: {from_start: true, speed: 5 mm/s}
terrain: {follow: blade, within: 1 m}
)yaml";
const std::string kDeep = "rigid_bodies.blade.pose.position=[2, 0.5]";
const std::string kThereAndBack = "rigid_bodies.blade.motion.velocity=[\"4*cos(3.141592653589793*t/2)\", 0]";

double mass_of(const Simulation& run) {
  double sum = 0.0;
  for (const double mass : field(run, "mass")) sum += mass;
  return sum;
}

/// Places of all particles, in order.
std::vector<std::pair<double, double>> places_of(const Simulation& run) {
  const std::vector<double> x = field(run, "x"), z = field(run, "z");
  std::vector<std::pair<double, double>> places;
  for (std::size_t p = 0; p < x.size(); ++p) places.emplace_back(x[p], z[p]);
  std::sort(places.begin(), places.end());
  return places;
}

std::set<std::uint32_t> ids_of(const Simulation& run) {
  ParticleColumns columns;
  run.read_particles({"x"}, {}, columns);
  EXPECT_TRUE(std::is_sorted(columns.ids.begin(), columns.ids.end()));
  EXPECT_EQ(columns.ids.size(), run.particles());
  return {columns.ids.begin(), columns.ids.end()};
}

/// Ground on the lattice of a grid of 1 m, two particles a cell, from 0 to 4 m.
struct LatticeGround final : GroundSource {
  void add(const Box&, GroundParticles&) const override {}
  bool cuts() const override { return false; }
  Vec3 origin() const override { return Vec3::Zero(); }
  Vec3 spacing() const override { return Vec3::Constant(0.5); }
  double bottom() const override { return 0.0; }
  double top() const override { return 4.0; }
};
const GridLayout kLayout(3, Vec3(1, 1, 1), Vec3::Zero(), Vec3(16, 16, 8));

// 41 particles of 2 kg, less a tenth of one, over the four columns of a node's area: ten layers, and the one that is
// nearly whole on top; what is too much stays, as does what is less than half a particle.
TEST(KeptGround, IsStackedLevelAndLosesNothing) {
  const LatticeGround source;
  const BedColumns columns(kLayout);
  KeptGround kept(columns, source, 7.5);
  const Vec3 place(5.1, 6.2, 1.0);
  const int column = columns.of_point(place);
  EXPECT_EQ(column, 1 * 5 + 1);
  kept.keep(column, place, 81.8);
  kept.keep(column, place + Vec3(1, 0, 0), 0.9);
  GroundParticles ground;
  kept.stack(column, 2.0, 0, ground);
  ASSERT_EQ(ground.positions.size(), 41U);
  std::vector<int> layers(11, 0);
  for (const Vec3& at : ground.positions) {
    EXPECT_EQ(columns.of_point(at), column);
    EXPECT_EQ(columns.node_of(at), columns.node_of(place));
    ++layers.at(static_cast<std::size_t>(std::floor(2.0 * at.z())));
    EXPECT_DOUBLE_EQ(2.0 * at.z() - std::floor(2.0 * at.z()), 0.5);
  }
  for (int layer = 0; layer < 10; ++layer) EXPECT_EQ(layers[layer], 4);
  EXPECT_EQ(layers[10], 1);
  EXPECT_NEAR(kept.mass(), 81.8 + 0.9 - 82.0, 1e-12);
  // On what is there already: places 0 to 3 of one of the four columns are taken.
  kept.keep(column, place, 2.2);
  ground = {};
  for (int k = 0; k < 4; ++k) ground.positions.emplace_back(4.75, 5.75, 0.5 * k + 0.25);
  kept.stack(column, 2.0, 0, ground);
  ASSERT_EQ(ground.positions.size(), 5U);
  EXPECT_EQ(ground.positions.back(), Vec3(4.75, 6.25, 0.25));
}

TEST(KeptGround, KeepsWhatWouldLieAboveTheGrid) {
  const LatticeGround source;
  const BedColumns columns(kLayout);
  KeptGround kept(columns, source, 7.5);
  kept.keep(0, Vec3(0.1, 0.1, 0), 1000.0);
  GroundParticles ground;
  kept.stack(0, 2.0, 0, ground);
  EXPECT_EQ(ground.positions.size(), 15U);  // the area of a corner's node has one column, whose centres go to 7.25 m
  EXPECT_DOUBLE_EQ(kept.mass(), 970.0);
}

ParticleSet numbered(std::uint32_t first, int count, int asleep) {
  ParticleSet set;
  set.mass = 1.0;
  set.id.resize(count);
  set.x.resize(2);
  for (auto& x : set.x) x.resize(count);
  set.v = {ParticleScalar(Precision::float32, count), ParticleScalar(Precision::float32, count)};
  for (int p = 0; p < count; ++p) {
    set.id[p] = first + p;
    for (int k = 0; k < 2; ++k) set.x[k][p] = first + p + 0.5 * k;
    set.v[0].set(p, first + p);
  }
  set.next_x = set.x;
  set.asleep = asleep;
  return set;
}

/// Ids of those awake, then of those asleep; each has what is its own.
std::vector<std::set<std::uint32_t>> own_ids(const ParticleSet& set) {
  std::vector<std::set<std::uint32_t>> ids(2);
  for (int p = 0; p < set.size(); ++p) {
    ids[p < set.awake() ? 0 : 1].insert(set.id[p]);
    for (int k = 0; k < 2; ++k) EXPECT_EQ(set.x[k][p], set.id[p] + 0.5 * k);
    EXPECT_EQ(set.v[0][p], set.id[p]);
    if (p >= set.awake()) {
      EXPECT_EQ(set.next_x[0][p], set.id[p]);
    }
  }
  return ids;
}

TEST(AppendedParticles, KeepWhatIsTheirs) {
  ParticleSet set = numbered(0, 10, 4);
  append_awake(set, numbered(20, 7, 0));
  EXPECT_EQ(set.size(), 17);
  EXPECT_EQ(own_ids(set)[0], (std::set<std::uint32_t>{0, 1, 2, 3, 4, 5, 20, 21, 22, 23, 24, 25, 26}));
  EXPECT_EQ(own_ids(set)[1], (std::set<std::uint32_t>{6, 7, 8, 9}));
  remove_awake(set, {0, 3, 11, 12});  // two of them lie where the others move from
  EXPECT_EQ(set.size(), 13);
  EXPECT_EQ(own_ids(set)[0], (std::set<std::uint32_t>{1, 2, 4, 5, 20, 21, 22, 23, 24}));
  EXPECT_EQ(own_ids(set)[1], (std::set<std::uint32_t>{6, 7, 8, 9}));
  append_awake(set, numbered(40, 2, 0));
  EXPECT_EQ(own_ids(set)[0], (std::set<std::uint32_t>{1, 2, 4, 5, 20, 21, 22, 23, 24, 40, 41}));
  EXPECT_EQ(own_ids(set)[1], (std::set<std::uint32_t>{6, 7, 8, 9}));
}

TEST(FollowingBed, IsThereWithinTheDistanceAndOneColumnMore) {
  const Simulation run = start(kDrive);
  const auto places = places_of(run);
  // Column i holds [0.2 i - 0.025, 0.2 i + 0.175). Within 1 m are those from 5 (0.975 to 1.175) to 15 (2.975 to 3.175).
  EXPECT_EQ(places.size(), 13U * 4 * 2 * 16);
  EXPECT_NEAR(places.front().first, 4 * 0.2 - 0.025 + 0.0125, 1e-12);
  EXPECT_NEAR(places.back().first, 16 * 0.2 + 0.175 - 0.0125, 1e-12);
  EXPECT_EQ(number(run, "ground_made"), 0.0);
}

// The blade hovers: nothing moves, and what is made again is what was there, particle by particle.
TEST(FollowingBed, ComesBackAsItWas) {
  Simulation run = start(kDrive, {kThereAndBack});
  const auto before = places_of(run);
  const std::vector<double> stress = field(run, "szz");
  const std::set<std::uint32_t> ids = ids_of(run);
  std::set<std::uint32_t> all = ids;
  advance_to(run, 1.0);  // 8/pi m on
  EXPECT_GT(number(run, "ground_made"), 0.0);
  for (const std::uint32_t id : ids_of(run)) all.insert(id);
  const double first_made = number(run, "ground_made");
  advance_to(run, 2.0);
  const auto after = places_of(run);
  const double spread =
      *std::max_element(stress.begin(), stress.end()) - *std::min_element(stress.begin(), stress.end());
  ASSERT_GE(after.size(), before.size());  // some columns ahead are still there
  for (std::size_t p = 0; p < before.size(); ++p) {
    EXPECT_NEAR(after[p].first, before[p].first, 1e-4);  // weight settles what wakes
    EXPECT_NEAR(after[p].second, before[p].second, 1e-4);
  }
  std::vector<double> stress_after = field(run, "szz");
  EXPECT_NEAR(*std::min_element(stress_after.begin(), stress_after.end()),
              *std::min_element(stress.begin(), stress.end()), 0.02 * spread);
  // Ground that was put away of the first window is made anew, by new numbers.
  EXPECT_GT(number(run, "ground_made"), first_made);
  std::size_t renewed = 0;
  for (const std::uint32_t id : ids_of(run)) renewed += all.count(id) == 0 ? 1 : 0;
  EXPECT_GT(renewed, 0U);
}

TEST(FollowingBed, CountsMassMomentumAndEnergy) {
  Simulation run = start(kDrive, {kDeep});
  const double first = mass_of(run);
  const double balance = run.state().energy.balance();
  double most = 0.0;
  double apart = 0.0;
  while (run.time() < 3'000'000'000) {
    run.advance();
    most = std::max(most, number(run, "ground_put_away"));
    apart = std::max(apart, std::abs(run.state().energy.balance() - balance));
  }
  EXPECT_GT(most, first);  // the whole window has been put away once
  EXPECT_NEAR(mass_of(run), first + number(run, "ground_made") - number(run, "ground_put_away"), 1e-10 * first);
  EXPECT_LT(run.state().audit.residual, 1e-10);
  // Less than the weight's energy of one column, 0.2 x 0.4 x 0.1 m, of all that came and went.
  EXPECT_LT(apart, 0.2 * 0.4 * 0.1 * 1600.0 * 9.81 * 0.2);
  EXPECT_EQ(field(run, "mass").size(), run.particles());
}

// Four metres away there was no ground. It is made before it is asked whether the blade can be there.
TEST(FollowingBed, ComesWhereABodyIsSet) {
  Simulation run = start(kDrive, {});
  advance_to(run, 0.1);
  StateSet set;
  set.name = "blade";
  set.pose = Pose{{8.0, 0.0, 0.3}, Quat::Identity()};
  EXPECT_THROW(run.set_state(set), RigidError);  // in the ground
  EXPECT_LT(run.bodies()[0].pose.position.x(), 3.0);
  set.pose->position.z() = 0.62;
  run.set_state(set);
  EXPECT_GE(places_of(run).back().first, 9.0);
  advance_to(run, 0.3);
  EXPECT_GT(run.bodies()[0].pose.position.x(), 8.0);
}

// The window: columns nearer than 1 m + 0.4 m, which are at most 2 x 1.4 / 0.2 + 1, and one beyond on both sides.
TEST(FollowingBed, HasAsManyParticlesAsItsWindow) {
  const std::vector<std::string> far = {"grid.max=[210, 1.2]", "bodies.bed.shape.box.max=[210, 0.4]", "time.end=20.1",
                                        "rigid_bodies.blade.motion.velocity=[\"10*min(1, t/0.1)\", 0]"};
  Simulation run = start(kDrive, far);
  std::uint64_t most = 0;
  while (run.time() < 20'100'000'000) {
    run.advance();
    most = std::max(most, run.particles());
  }
  EXPECT_GT(run.bodies()[0].pose.position.x(), 200.0);
  EXPECT_LE(most, (15U + 2U) * 4 * 2 * 16);
  EXPECT_GT(number(run, "ground_made"), 10.0 * number(run, "ground_kept") / 11.0);
}

TEST(FollowingBed, HasTheSameBitsOnAnyNumberOfThreads) {
  Simulation one = start(kDrive, {kDeep}), two = start(kDrive, {kDeep}, 2);
  advance_to(one, 1.0);
  advance_to(two, 1.0);
  EXPECT_GT(number(one, "ground_put_away"), 0.0);
  EXPECT_EQ(one.state_hash(), two.state_hash());
  EXPECT_EQ(one.memory_hash(), two.memory_hash());
}

TEST(FollowingBed, GoesOnFromACheckpoint) {
  const Folder folder;
  Simulation whole = start(kDrive, {kDeep});
  advance_to(whole, 0.8);
  save_checkpoint(folder.file("half"), whole, {}, {});
  Simulation resumed = start(kDrive, {kDeep});
  load_checkpoint(folder.file("half"), resumed, "", {}, {});
  EXPECT_EQ(resumed.particles(), whole.particles());
  EXPECT_EQ(resumed.memory_hash(), whole.memory_hash());
  advance_to(whole, 1.2);
  advance_to(resumed, 1.2);
  EXPECT_GT(number(whole, "ground_put_away"), 0.0);
  EXPECT_EQ(resumed.memory_hash(), whole.memory_hash());
}

}  // namespace following_bed_test
}  // namespace mpm::test
