// run_scene over several ranks, here threads: one set of files and lines, the forces of one process, and no rank that
// waits for ever when another one cannot go on.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "full_disk.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"
#include "thread_communicator.hpp"

namespace mpm_ros {
namespace run_scene_ranks_test {

namespace fs = std::filesystem;

/// Output of a rank, and its result.
struct Said {
  std::string out, err;
  RunSceneResult result = RunSceneResult::done;
};

std::size_t lines(const fs::path& path) {
  std::ifstream file(path);
  std::size_t count = 0;
  for (std::string line; std::getline(file, line);) ++count;
  return count;
}

class RunSceneOverRanks : public ::testing::Test {
 protected:
  RunSceneOverRanks() : folder_(fs::temp_directory_path() / ("mpm_run_scene_ranks_test_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    options_.scene = source_file("test/data/press.yaml");
    options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}"};
    options_.threads = 1;
    options_.end = "30 ms";
  }
  ~RunSceneOverRanks() override { fs::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }

  std::vector<Said> run(
      int count, const std::function<bool(int)>& stop = [](int) { return false; }) const {
    std::vector<Said> said(count);
    mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
      RunSceneOptions own = options_;
      own.ranks = {&ranks, [](mpm::Communicator*) {}};
      std::ostringstream out, err;
      Said& told = said[ranks.rank()];
      told.result = run_scene(own, out, err, false, [&] { return stop(ranks.rank()); });
      told.out = out.str();
      told.err = err.str();
    });
    return said;
  }
  /// Reason that ends all ranks. `code`: with which exit code.
  std::string reason(int count, int* code = nullptr) const {
    try {
      run(count);
    } catch (const mpm::RanksEnded& error) {
      if (code != nullptr) *code = error.code();
      return error.what();
    }
    return "nothing";
  }

  nlohmann::json summary() const {
    std::ifstream file(options_.summary);
    return nlohmann::json::parse(file);
  }

  fs::path folder_;
  RunSceneOptions options_;
};

TEST_F(RunSceneOverRanks, WritesOnceWhatOneProcessWrites) {
  options_.summary = file("alone.json");
  options_.csv = file("alone");
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  const nlohmann::json alone = summary();
  EXPECT_EQ(alone["ranks"], 1);
  EXPECT_FALSE(alone.contains("communication"));
  const double impulse = alone["contact_impulse"]["plate"][2];
  ASSERT_GT(impulse, 0.0);
  for (const int count : {2, 3}) {
    options_.summary = file(std::to_string(count) + ".json");
    options_.csv = file(std::to_string(count));
    options_.bag = file(std::to_string(count) + ".bag");
    const std::vector<Said> said = run(count);
    EXPECT_NE(said[0].out.find(std::to_string(count) + " ranks of 1 thread"), std::string::npos) << said[0].out;
    for (int rank = 0; rank < count; ++rank) {
      EXPECT_EQ(said[rank].result, RunSceneResult::done) << said[rank].err;
      if (rank > 0) {
        EXPECT_EQ(said[rank].out + said[rank].err, "");
      }
    }
    const nlohmann::json over = summary();
    EXPECT_EQ(over["ranks"], count);
    EXPECT_TRUE(over.contains("communication"));
    EXPECT_GE(over["sharing"]["divisions"], 1);
    EXPECT_EQ(over["particles"], alone["particles"]);
    EXPECT_EQ(over["steps"], alone["steps"]);
    // Sums in another order over eighty steps, the bound for a hundred.
    EXPECT_NEAR(over["contact_impulse"]["plate"][2], impulse, 1e-10 * impulse);
    EXPECT_NEAR(over["energy"]["end"]["elastic"], alone["energy"]["end"]["elastic"],
                1e-9 * alone["energy"]["end"]["elastic"].get<double>());
    EXPECT_LT(over["momentum_error"], 1e-10);
    EXPECT_TRUE(fs::exists(options_.bag));
    for (const auto& entry : fs::directory_iterator(file("alone"))) {
      const fs::path same = fs::path(options_.csv) / entry.path().filename();
      ASSERT_TRUE(fs::exists(same)) << same;
      EXPECT_EQ(lines(same), lines(entry.path())) << same;
    }
  }
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Texts between quotes after `before`, in the order of the text.
std::vector<std::string> quoted(const std::string& text, const std::string& before) {
  std::vector<std::string> found;
  for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
    at += before.size();
    found.push_back(text.substr(at, text.find('"', at) - at));
  }
  return found;
}

/// The array of that name in a .vtp file, as whole numbers or single precision.
template <class Value>
std::vector<Value> array_of(const std::string& file, const std::string& name) {
  const std::size_t appended = file.find("<AppendedData encoding=\"raw\">"), data = file.find('_', appended) + 1;
  const std::string entry = file.substr(file.find("Name=\"" + name + "\""), 200);
  const std::size_t at = data + std::stoul(quoted(entry, "offset=\"").at(0));
  std::uint64_t size = 0;
  std::memcpy(&size, file.data() + at, sizeof(size));
  std::vector<Value> values(size / sizeof(Value));
  std::memcpy(values.data(), file.data() + at + sizeof(size), size);
  return values;
}

// Each rank writes a piece; together they have what the file of one process has.
TEST_F(RunSceneOverRanks, WritesPiecesForParaView) {
  options_.end = "1 ms";
  options_.vtk = file("alone");
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  const std::vector<std::string> frames = quoted(content(file("alone/run.pvd")), "name=\"particles\" file=\"");
  ASSERT_GE(frames.size(), 2U);
  constexpr int kRanks = 3;
  options_.vtk = file("pieces");
  for (const Said& told : run(kRanks)) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
  const std::string list = content(file("pieces/run.pvd"));
  const std::vector<std::string> wholes = quoted(list, "name=\"particles\" file=\"");
  ASSERT_EQ(wholes.size(), frames.size());
  EXPECT_EQ(quoted(list, "timestep=\""), quoted(content(file("alone/run.pvd")), "timestep=\""));
  EXPECT_EQ(quoted(list, "name=\"body_plate\" file=\""),
            quoted(content(file("alone/run.pvd")), "name=\"body_plate\" file=\""));
  for (std::size_t frame = 0; frame < frames.size(); ++frame) {
    EXPECT_EQ(wholes[frame], fs::path(frames[frame]).stem().string() + ".pvtp");
    const std::string whole = content(file("pieces/" + wholes[frame])), one = content(file("alone/" + frames[frame]));
    const std::vector<std::string> pieces = quoted(whole, "<Piece Source=\"");
    ASSERT_EQ(pieces.size(), static_cast<std::size_t>(kRanks));
    // The arrays that the whole promises are those of every piece, and of one process.
    const std::string promised = whole.substr(0, whole.find("<Piece"));
    std::vector<std::string> names = quoted(one.substr(one.find("<PointData>")), "Name=\"");
    names.insert(names.begin(), "Points");
    EXPECT_EQ(quoted(promised, "Name=\""), names);
    std::vector<std::uint32_t> ids;
    std::vector<float> places(array_of<float>(one, "Points").size());
    int used = 0;
    for (const std::string& piece : pieces) {
      const std::string text = content(file("pieces/" + piece));
      std::vector<std::string> own = quoted(text.substr(text.find("<PointData>")), "Name=\"");
      own.insert(own.begin(), "Points");
      EXPECT_EQ(own, names);
      const std::vector<std::uint32_t> of_piece = array_of<std::uint32_t>(text, "id");
      const std::vector<float> points = array_of<float>(text, "Points");
      EXPECT_EQ(quoted(text, "NumberOfPoints=\"").at(0), std::to_string(of_piece.size()));
      ASSERT_EQ(points.size(), 3 * of_piece.size());
      used += !of_piece.empty();
      for (std::size_t p = 0; p < of_piece.size(); ++p) {
        ASSERT_LT(3 * of_piece[p], places.size());
        std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(3 * p), 3, places.begin() + 3 * of_piece[p]);
      }
      ids.insert(ids.end(), of_piece.begin(), of_piece.end());
    }
    EXPECT_EQ(used, kRanks);
    std::sort(ids.begin(), ids.end());
    ASSERT_EQ(ids.size(), places.size() / 3);
    for (std::uint32_t id = 0; id < ids.size(); ++id) EXPECT_EQ(ids[id], id);
    const std::vector<float> expected = array_of<float>(one, "Points");
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(places[i], expected[i], 1e-6F);
  }
}

// --out makes the folder on the first rank, and others have to know it.
TEST_F(RunSceneOverRanks, WritesPiecesToAFolderOfTheRun) {
  options_.end = "1 ms";
  options_.out = file("runs");
  for (const Said& told : run(2)) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
  int pieces = 0;
  for (const auto& entry : fs::recursive_directory_iterator(file("runs"))) {
    pieces += entry.path().filename() == "particles_0000_0.vtp" || entry.path().filename() == "particles_0000_1.vtp";
  }
  EXPECT_EQ(pieces, 2);
}

TEST_F(RunSceneOverRanks, EndsOnAllWithOneReasonWhenAPieceHasNoRoom) {
  options_.vtk = file("vtk");
  options_.summary = file("summary.json");
  fs::create_directories(file("vtk/particles_0000_1.vtp"));  // in the way of the second rank
  const std::vector<Said> said = run(2);
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::machine_failed);
  EXPECT_NE(said[0].err.find("particles_0000_1.vtp: cannot be written"), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].out + said[1].err, "");
}

TEST_F(RunSceneOverRanks, StopsOnAllWhenOneIsAskedTo) {
  std::atomic<int> asked{0};
  options_.summary = file("summary.json");
  const std::vector<Said> said = run(3, [&](int rank) { return rank == 2 && ++asked > 4; });
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::done);
  EXPECT_NE(said[0].err.find("stopped at"), std::string::npos) << said[0].err;
  EXPECT_FALSE(summary()["ended"]);
}

TEST_F(RunSceneOverRanks, EndsOnAllWhenTheFirstHasNoRoom) {
  options_.summary = file("summary.json");
  options_.bag = file("run.bag");
  const test::FullDisk full(20'000);
  const std::vector<Said> said = run(2);
  EXPECT_EQ(said[0].result, RunSceneResult::machine_failed);
  EXPECT_NE(said[0].err.find("run.bag"), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].out + said[1].err, "");
}

// As many ranks repeat a recording to the bit, others to the round-off of sums in another order, as a bound for a
// hundred steps has it. 2 s.
TEST_F(RunSceneOverRanks, RunsARecordingAgain) {
  const auto impulse = [&] { return summary()["contact_impulse"]["plate"][2].get<double>(); };
  options_.summary = file("summary.json");
  for (const int recorded : {1, 2}) {
    options_.from_bag.clear();
    options_.scene = source_file("test/data/press.yaml");
    options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}"};
    options_.end = "30 ms";
    options_.bag = file(std::to_string(recorded) + ".bag");
    if (recorded == 1) {
      std::ostringstream out, err;
      ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
    } else {
      run(2);
    }
    const double expected = impulse();
    ASSERT_GT(expected, 0.0);
    options_.from_bag = options_.bag;
    options_.bag.clear();
    options_.scene.clear();
    options_.set.clear();
    options_.end.clear();
    for (const int count : {1, 2}) {
      Said told;
      if (count == 1) {
        std::ostringstream out, err;
        told.result = run_scene(options_, out, err, false, [] { return false; });
        told.out = out.str();
        told.err = err.str();
      } else {
        told = run(2)[0];
      }
      EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
      EXPECT_NEAR(impulse(), expected, 1e-10 * expected);
      EXPECT_NE(told.out.find(count == recorded ? "equal to the recorded one" : "processes add up in another order"),
                std::string::npos)
          << told.out;
    }
  }
}

TEST_F(RunSceneOverRanks, TellsOnceThatARecordingIsNotThere) {
  options_.scene.clear();
  options_.set.clear();
  options_.from_bag = file("run.bag");
  int code = 0;
  EXPECT_NE(reason(2, &code).find("run.bag"), std::string::npos) << reason(2);
  EXPECT_EQ(code, static_cast<int>(RunSceneResult::bad_input));
}

// The first rank chooses, and all run what it has chosen: one process that is told the choice has the same forces. Sums
// of two ranks have other round-off, 1e-16, which yielding sand and sweeps of contact let grow; another choice is off
// by per cents. 1 s.
TEST_F(RunSceneOverRanks, AimsAtATargetTogether) {
  options_.scene = file("pushed.yaml");
  std::ofstream(options_.scene)
      << "geometry: plane_strain\ngravity: [0, -9.81]\ngrid: {cell: 0.05, min: [0, 0], max: [1.6, 0.8]}\n"
         "time: {end: 0.02, sync: 0.005}\n"
         "materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: "
         "30 deg, dilation_angle: 0 deg, cohesion: 0}]\n"
         "bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.6, 0.4]}}}]\n"
         "rigid_bodies: [{name: tool, shape: {polygon: {points: [[0, 0], [0.2, 0], [0.2, 0.3], [0, 0.3]]}}, "
         "pose: {position: [0.7, 0.41]}, motion: {velocity: [0, -1]}}]\nboundaries: {all: slip}\n";
  options_.set = {"target={force_error: 50 %}"};
  options_.end.clear();
  options_.summary = file("summary.json");
  options_.bag = file("run.bag");
  const std::vector<Said> said = run(2);
  EXPECT_EQ(said[0].result, RunSceneResult::done) << said[0].err;
  EXPECT_NE(said[0].err.find("of real time expected"), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].out + said[1].err, "");
  const double impulse = summary()["contact_impulse"]["tool"][2];
  ASSERT_GT(impulse, 0.0);
  options_.from_bag = options_.bag;  // its scene has the choice
  options_.bag.clear();
  options_.scene.clear();
  options_.set.clear();
  std::ostringstream out, err;
  ASSERT_EQ(run_scene(options_, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
  EXPECT_NEAR(summary()["contact_impulse"]["tool"][2], impulse, 1e-8 * impulse);
}

// To the bit on as many ranks, to round-off on others.
TEST_F(RunSceneOverRanks, GoesOnFromItsCheckpoint) {
  const auto hash_and_impulse = [&](int count) {
    options_.summary = file("summary.json");
    for (const Said& told : run(count)) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
    const nlohmann::json found = summary();
    return std::pair(found["state_hash"].dump(), found["contact_impulse"]["plate"][2].get<double>());
  };
  options_.checkpoint = file("end.h5");
  const auto [hash, impulse] = hash_and_impulse(3);
  EXPECT_TRUE(fs::exists(options_.checkpoint));
  options_.end = "15 ms";
  options_.checkpoint = file("half.h5");
  options_.checkpoint_every = "5 ms";
  const double first = hash_and_impulse(3).second;
  options_.resume = options_.checkpoint;
  options_.checkpoint.clear();
  options_.checkpoint_every.clear();
  options_.scene.clear();
  options_.set.clear();
  options_.end = "30 ms";
  for (const int count : {3, 2}) {
    const auto [of_rest, rest] = hash_and_impulse(count);
    EXPECT_EQ(of_rest == hash, count == 3) << count;
    EXPECT_NEAR(rest, impulse, 1e-10 * impulse) << first;
  }
}

TEST_F(RunSceneOverRanks, RefusesACheckpointThatCannotBeWritten) {
  options_.checkpoint = file("no/such/folder/run.h5");
  EXPECT_NE(reason(2).find("--checkpoint"), std::string::npos) << reason(2);
}

TEST_F(RunSceneOverRanks, EndsAllWithTheReasonOfOne) {
  options_.bag = file("no/such/folder/run.bag");  // the first alone opens it
  EXPECT_NE(reason(3).find("run.bag"), std::string::npos) << reason(3);
  options_.bag.clear();
  options_.set = {"rigid_bodies.plate.motion={velocity: [0, -0.5]}", "materials.foam.young=1e99"};
  EXPECT_NE(reason(3).find("run_scene: "), std::string::npos) << reason(3);
}

// A particle leaves the grid on one rank; all know, and the checkpoint from before it can be gone on with.
TEST_F(RunSceneOverRanks, FailsOnAllWithTheParticleOfOneAndLeavesACheckpoint) {
  options_.scene = source_file("test/data/leaves_domain.yaml");
  options_.set = {"time.sync=1 ms"};
  options_.end = "200 ms";
  options_.checkpoint = file("run.h5");
  options_.checkpoint_every = "40 ms";
  options_.csv = file("csv");
  const std::vector<Said> said = run(3);
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::physics_failed);
  EXPECT_NE(said[0].err.find("outside the domain"), std::string::npos) << said[0].err;
  EXPECT_NE(said[0].err.find("particle "), std::string::npos) << said[0].err;
  EXPECT_EQ(said[1].err + said[2].err, "");
  ASSERT_TRUE(fs::exists(options_.checkpoint));
  options_.resume = options_.checkpoint;
  options_.scene.clear();
  options_.set.clear();
  options_.checkpoint.clear();
  options_.checkpoint_every.clear();
  options_.csv.clear();
  options_.summary = file("summary.json");
  options_.end = "42 ms";
  for (const Said& told : run(2)) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
  EXPECT_LT(summary()["momentum_error"], 1e-10);
  options_.end = "200 ms";
  for (const Said& told : run(2)) EXPECT_EQ(told.result, RunSceneResult::physics_failed);
}

// Finds on one rank what is not a number in the middle of a step, while others wait: the physics failed all the
// same.
TEST_F(RunSceneOverRanks, EndsAllWhereTheStepOfOneFails) {
  options_.set = {"loads=[{body_force: {acceleration: [\"x > 0.12 && t > 0.01 ? log(0 - 1) : 0\", 0]}}]"};
  int code = 0;
  EXPECT_NE(reason(3, &code).find("body force on 'strip'"), std::string::npos) << reason(3);
  EXPECT_EQ(code, static_cast<int>(RunSceneResult::physics_failed));
}

TEST_F(RunSceneOverRanks, LetsRanksWithoutParticlesBe) {
  options_.summary = file("summary.json");
  run(1);
  const double impulse = summary()["contact_impulse"]["plate"][2];
  const std::vector<Said> said = run(24);
  for (const Said& told : said) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
  EXPECT_NE(said[0].err.find("of 24 ranks have no particle"), std::string::npos) << said[0].err;
  EXPECT_NEAR(summary()["contact_impulse"]["plate"][2], impulse, 1e-10 * impulse);
  EXPECT_EQ(run(2)[0].err.find("no particle"), std::string::npos);
}

TEST_F(RunSceneOverRanks, RefusesTheCheckpointOfAnotherScene) {
  options_.checkpoint = file("press.h5");
  options_.end = "5 ms";
  run(2);
  options_.resume = options_.checkpoint;
  options_.checkpoint.clear();
  options_.scene = source_file("test/data/leaves_domain.yaml");
  options_.set.clear();
  int code = 0;
  const std::string told = reason(3, &code);
  EXPECT_NE(told.find("press.h5"), std::string::npos) << told;
  EXPECT_EQ(told.find('\n'), std::string::npos) << told;
  EXPECT_EQ(code, static_cast<int>(RunSceneResult::bad_input));
}

TEST_F(RunSceneOverRanks, RefusesBadInputWithOneSentence) {
  const auto refused = [&] {
    int code = 0;
    const std::string told = reason(3, &code);
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
    EXPECT_EQ(code, static_cast<int>(RunSceneResult::bad_input)) << told;
    return told;
  };
  options_.set = {"grid.cell=-1"};
  EXPECT_NE(refused().find("grid.cell"), std::string::npos);
  options_.set.clear();
  options_.scene = file("none.yaml");
  EXPECT_NE(refused().find("no such scene file"), std::string::npos);
  options_.scene.clear();
  options_.resume = file("none.h5");
  EXPECT_NE(refused().find("none.h5"), std::string::npos);
}

TEST_F(RunSceneOverRanks, RefusesRanksThatReadDifferentScenes) {
  try {
    mpm::run_ranks(2, [&](mpm::Communicator& ranks) {
      RunSceneOptions own = options_;
      own.ranks = {&ranks, [](mpm::Communicator*) {}};
      if (!ranks.first()) own.set.push_back("contact.friction=0.3");
      std::ostringstream out, err;
      run_scene(own, out, err, false, [] { return false; });
    });
    FAIL() << "both run";
  } catch (const mpm::RanksError& error) {
    EXPECT_NE(std::string(error.what()).find("rank 1 reads another scene"), std::string::npos) << error.what();
  }
}

}  // namespace run_scene_ranks_test
}  // namespace mpm_ros
