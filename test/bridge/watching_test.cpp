// doc/watching.md and the RViz configurations agree with the topics and fields that exist.
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "mpm/simulation/global_quantity.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/message/topics.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace watching_test {

using Row = std::pair<std::string, std::string>;

/// The names that a name of the table stands for: where it has the word N, those with 1 to 9 in its place.
std::vector<std::string> numbered(const std::string& name) {
  const std::size_t place = (name + " ").find(" N ");
  if (place == std::string::npos) return {name};
  std::vector<std::string> names;
  for (char digit = '1'; digit <= '9'; ++digit) names.push_back(std::string(name).replace(place + 1, 1, 1, digit));
  return names;
}

/// For each row of the table whose header begins with `header`: the words in backticks of its first cell, and its
/// second cell.
std::vector<Row> table(const std::string& header) {
  std::ifstream file(source_file("doc/watching.md"));
  std::vector<Row> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind(header, 0) == 0) inside = true;
    if (!inside) continue;
    if (line.empty()) break;
    std::stringstream cells(line);
    std::string cell, names, unit;
    std::getline(cells, cell, '|');
    std::getline(cells, names, '|');
    std::getline(cells, unit, '|');
    unit = unit.substr(1, unit.size() - 2);
    for (std::size_t begin = names.find('`'); begin != std::string::npos; begin = names.find('`', begin)) {
      const std::size_t end = names.find('`', begin + 1);
      for (const std::string& name : numbered(names.substr(begin + 1, end - begin - 1))) rows.emplace_back(name, unit);
      begin = end + 1;
    }
  }
  return rows;
}

TEST(Watching, EveryParticleFieldIsInTheTableWithItsUnit) {
  std::set<Row> known, written;
  for (const Row& field : mpm::Simulation::particle_fields()) known.insert(field);
  for (const Row& row : table("| field ")) EXPECT_TRUE(written.insert(row).second) << row.first << " is there twice";
  for (const Row& row : known) EXPECT_EQ(written.count(row), 1U) << row.first << " [" << row.second << "] is not there";
  for (const Row& row : written) EXPECT_EQ(known.count(row), 1U) << row.first << " [" << row.second << "] is no field";
}

TEST(Watching, EveryGlobalQuantityIsInTheTableWithItsUnit) {
  std::set<Row> known, written;
  for (const Row& quantity : mpm::global_quantity_names()) known.insert(quantity);
  for (const Row& row : table("| quantity ")) EXPECT_TRUE(written.insert(row).second) << row.first << " is there twice";
  for (const Row& row : known) EXPECT_EQ(written.count(row), 1U) << row.first << " [" << row.second << "] is not there";
  for (const Row& row : written) EXPECT_EQ(known.count(row), 1U) << row.first << " [" << row.second << "] is none";
}

TEST(Watching, EveryRVizConfigurationNamesTopicsThatExist) {
  const std::set<std::string> topics = {topics::kParticles, topics::kMarkers, topics::kForceMarkers,
                                        topics::kCrackMarkers};
  int configurations = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_file("config/rviz"))) {
    const std::string path = entry.path().string();
    ASSERT_EQ(entry.path().extension(), ".rviz") << path;
    ++configurations;
    const YAML::Node displays = YAML::LoadFile(path)["Visualization Manager"]["Displays"];
    ASSERT_TRUE(displays.IsSequence()) << path;
    int named = 0;
    for (const YAML::Node& display : displays) {
      for (const char* key : {"Topic", "Marker Topic"}) {
        if (!display[key]) continue;
        ++named;
        const auto topic = display[key].as<std::string>();
        EXPECT_EQ(topics.count(topic.substr(topic.rfind('/') + 1)), 1U) << path << ": " << topic;
      }
    }
    EXPECT_EQ(named, 4) << path << ": particles, shapes, forces and cracks are shown";
  }
  EXPECT_GE(configurations, 1);
}

}  // namespace watching_test
}  // namespace mpm_ros
