#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "full_disk.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/scene/scene.hpp"
#include "rank_counts.hpp"
#include "ranks_promises.hpp"
#include "thread_communicator.hpp"

namespace mpm {
namespace {

namespace fs = std::filesystem;

// 10,000 particles, whose arrays are several chunks on two ranks and more.
const char* const kBlock = R"yaml(
geometry: plane_strain
grid: {cell: 0.02, min: [0, 0], max: [1.6, 1.6]}
time: {end: 1, sync: 2 ms, cfl: 0.4}
gravity: [0, -9.81]
materials: [{name: rubber, density: 1000, law: neo_hookean, young: 100 kPa, poisson: 0.3}]
bodies: [{name: block, material: rubber, shape: {box: {min: [0.2, 0.02], max: [1.2, 1.02]}}, initial: {velocity: ["1+z", "-2*x"]}}]
boundaries: {z_min: {friction: 0.4}}
)yaml";

Scene block() {
  static std::mutex one_at_a_time;  // ranks that are threads read in turn
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  return parse_scene(kBlock, "block.yaml", {});
}

Simulation block_on(Communicator* ranks) {
  SimulationOptions options;
  options.threads = 1;
  if (ranks != nullptr) options.ranks = {ranks, [](Communicator*) {}};
  return Simulation(build(block(), ranks), options);
}

void save(const std::string& path, Simulation& simulation) {
  save_checkpoint(path, simulation, {"block.yaml", kBlock, {}});
}

/// On the first rank: of all particles, by their ids.
std::vector<std::vector<double>> content_of(const Simulation& simulation) {
  std::vector<std::vector<double>> fields;
  for (const char* name : {"x", "z", "vx", "vz", "sxx", "szz", "sxz", "j"}) {
    simulation.particle_field(name, fields.emplace_back());
  }
  return fields;
}

/// A folder of the first rank, which all have.
class Folder {
 public:
  explicit Folder(Communicator& ranks) : ranks_(ranks) {
    std::string name;
    if (ranks.first()) {
      name = (fs::temp_directory_path() / ("mpm_checkpoint_promises_" + std::to_string(getpid()))).string();
      fs::create_directory(name);
    }
    path_ = first_text(ranks, name);
  }
  ~Folder() {
    if (ranks_.first()) fs::remove_all(path_);
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  Communicator& ranks_;
  fs::path path_;
};

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return "no refusal";
}

void checkpoints_are_read_by_any_number_of_ranks(Communicator& ranks) {
  const Folder folder(ranks);
  const std::string path = folder.file("block.h5");
  Simulation simulation = block_on(&ranks);
  for (int period = 0; period < 3; ++period) simulation.advance();
  save(path, simulation);
  const std::vector<std::vector<double>> content = content_of(simulation);

  Simulation same = block_on(&ranks);
  load_checkpoint(path, same, kBlock);
  EXPECT_EQ(same.memory_hash(), simulation.memory_hash());
  EXPECT_EQ(same.state_hash(), simulation.state_hash());
  if (ranks.first()) {
    if (ranks.size() > 1) {  // a program that is one rank has no ranks
      Simulation alone = block_on(nullptr);
      load_checkpoint(path, alone, kBlock);
      EXPECT_TRUE(content_of(alone) == content) << "on one process";
    }
    for (const int count : test::rank_counts({1, 2, 3, 5, 8}, 2)) {
      run_ranks(count, [&](Communicator& threads) {
        Simulation other = block_on(&threads);
        load_checkpoint(path, other, kBlock);
        const std::vector<std::vector<double>> there = content_of(other);
        EXPECT_TRUE(!threads.first() || there == content) << "on " << count << " ranks";
      });
    }
    EXPECT_FALSE(fs::exists(path + ".part"));
  }
  ranks.sum(1.0);  // all wait for the first
}

// The limit is that of a process: of threads all have it.
void a_full_disk_under_one_rank_is_told_on_all(Communicator& ranks) {
  const Folder folder(ranks);
  const std::string path = folder.file("block.h5");
  Simulation simulation = block_on(&ranks);
  save(path, simulation);
  const std::uint64_t before = simulation.state_hash();
  simulation.advance();
  const bool limited = ranks.rank() == ranks.size() - 1;
  for (const rlim_t room : {4'000, 300'000}) {
    std::string told;
    {
      ranks.sum(1.0);
      std::unique_ptr<mpm_ros::test::FullDisk> full;
      if (limited) full = std::make_unique<mpm_ros::test::FullDisk>(room);
      ranks.sum(1.0);
      told = refusal([&] { save(path, simulation); });
      ranks.sum(1.0);
    }
    EXPECT_NE(told.find(path + ".part: cannot be written whole (File too large)"), std::string::npos) << told;
  }
  ranks.sum(1.0);
  EXPECT_EQ(read_checkpoint(path).state_hash, before);
  EXPECT_FALSE(fs::exists(path + ".part"));
  ranks.sum(1.0);
  save(path, simulation);
  EXPECT_EQ(read_checkpoint(path).state_hash, simulation.state_hash());
  ranks.sum(1.0);
}

void a_folder_that_is_not_shared_is_refused(Communicator& ranks) {
  if (ranks.size() == 1) return;
  const Folder folder(ranks);
  const std::string path = folder.file("block.h5"), other = folder.file("other.h5");
  Simulation simulation = block_on(&ranks);
  const auto told = [&] { return refusal([&] { save(ranks.first() ? path : other, simulation); }); };
  const std::string none = told();
  EXPECT_NE(none.find("cannot be written by all ranks: No such file or directory"), std::string::npos) << none;
  if (ranks.first()) std::ofstream(other + ".part") << "another";
  ranks.sum(1.0);
  const std::string another = told();
  EXPECT_NE(another.find("it is another file than on the first rank"), std::string::npos) << another;
  if (ranks.first()) {
    EXPECT_EQ(fs::file_size(other + ".part"), 7U);
    EXPECT_FALSE(fs::exists(path));
    EXPECT_FALSE(fs::exists(path + ".part"));
  }
  ranks.sum(1.0);
}

}  // namespace

std::vector<RanksPromise> checkpoint_promises() {
  return {{"checkpoints_are_read_by_any_number_of_ranks", checkpoints_are_read_by_any_number_of_ranks},
          {"a_full_disk_under_one_rank_is_told_on_all", a_full_disk_under_one_rank_is_told_on_all},
          {"a_folder_that_is_not_shared_is_refused", a_folder_that_is_not_shared_is_refused}};
}

}  // namespace mpm
