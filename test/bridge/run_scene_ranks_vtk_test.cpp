// Files for ParaView of run_scene over several ranks, here threads: a piece of each rank.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "run_scene_over_ranks.hpp"

namespace mpm_ros {
namespace run_scene_ranks_vtk_test {

namespace fs = std::filesystem;
using Said = test::SaidByRank;
class RunSceneInPieces : public test::RunSceneOverRanks {};

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
TEST_F(RunSceneInPieces, WritesPiecesForParaView) {
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
TEST_F(RunSceneInPieces, WritesPiecesToAFolderOfTheRun) {
  options_.end = "1 ms";
  options_.out = file("runs");
  for (const Said& told : run(2)) EXPECT_EQ(told.result, RunSceneResult::done) << told.err;
  int pieces = 0;
  for (const auto& entry : fs::recursive_directory_iterator(file("runs"))) {
    pieces += entry.path().filename() == "particles_0000_0.vtp" || entry.path().filename() == "particles_0000_1.vtp";
  }
  EXPECT_EQ(pieces, 2);
}

}  // namespace run_scene_ranks_vtk_test
}  // namespace mpm_ros
