// Tables of keys: ranges and their words, the check of a definition, and the pages, which show the rows of every table.
// 0.1 s.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "mpm/material/law_keys.hpp"
#include "mpm/math/build_info.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/sections/all_keys.hpp"
#include "mpm/sleep/sleep_keys.hpp"

namespace mpm {
namespace keys_test {

std::string text_of(const std::string& page) {
  std::ifstream file(source_folder() + "/doc/" + page);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string row_text(const KeyRow& row) {
  const std::string table = markdown({row});
  return table.substr(table.find("|---|\n") + 6);
}

TEST(Keys, RangesSayWhatIsWrong) {
  EXPECT_EQ(kPositive.fault(1e-9, kLength), "");
  EXPECT_EQ(kPositive.fault(0.0, kLength), "is not greater than 0");
  EXPECT_EQ(kNotNegative.fault(0.0, kLength), "");
  EXPECT_EQ(kNotNegative.fault(-1.0, kLength), "is less than 0");
  EXPECT_EQ(kPositive.fault(kInfinity, kLength), "is not finite");
  EXPECT_EQ(or_none(kPositive).fault(kInfinity, kLength), "");
  EXPECT_EQ(kAny.fault(kNan, kLength), "is not a number");
  EXPECT_EQ(between(0.0, 1.0).fault(1.0, kPlain), "is not below 1");
  EXPECT_EQ(kPart.fault(1.5, kPlain), "is more than 1");
  EXPECT_EQ(from_to_below(0.0, 0.5 * kPi).fault(2.0 * kPi, kAngle), "is not below 90 deg");
}

TEST(Keys, RangesInWords) {
  EXPECT_EQ(kAny.words(kLength), "");
  EXPECT_EQ(above(2.0).words(kLength), "above 2 m");
  EXPECT_EQ(at_least(1.0).words(kPlain), "of 1 or more");
  EXPECT_EQ(at_least(1.0).signs(kPlain), "≥ 1");
  EXPECT_EQ(kPositive.signs(kLength), "> 0");
  EXPECT_EQ(kPart.signs(kPlain), "from 0 to 1");
  EXPECT_EQ(above_to(0.0, 1.0).words(kPlain), "above 0 and up to 1");
  EXPECT_EQ(between(-1.0, 0.5).words(kPlain), "between -1 and 0.5, both excluded");
}

TEST(Keys, DefinitionsAreChecked) {
  SleepDefinition sleep{0.01, 0.03, 0.1};
  EXPECT_FALSE(sleep_keys().fault(sleep));
  sleep.damping = 1.0;
  ASSERT_TRUE(sleep_keys().fault(sleep));
  EXPECT_EQ(sleep_keys().fault(sleep)->key, "damping");
  EXPECT_EQ(sleep_keys().fault(sleep)->text, "1 is not below 1");
  // A number that stands for a key that is left out is in order: no saturation, and a strength that does not fall.
  EXPECT_FALSE(material_fault({"metal", 7850.0, J2PlasticityDefinition{{2e11, 0.3}, 1e8}}));
}

TEST(Keys, DefaultsAreThoseOfDefinitions) {
  std::map<std::string, std::string> defaults;
  for (const KeyRow& row : law_keys<NorSandDefinition>().page()) defaults[row.name] = row.fallback;
  EXPECT_EQ(defaults["`shear_exponent`"], "`0.5`");
  EXPECT_EQ(defaults["`least_pressure`"], "`100 Pa`");
  EXPECT_EQ(defaults["`void_ratio`"], "this or `relative_density`");
  EXPECT_EQ(defaults["`gamma`"], "required");
}

TEST(Keys, StandInThePages) {
  std::map<std::string, std::set<std::string>> rows;
  for (const KeySection& section : all_keys()) {
    for (const KeyRow& row : section.rows) {
      rows[section.page].insert(row_text(row));
    }
  }
  for (const auto& [page, wanted] : rows) {
    const std::string text = text_of(page);
    for (const std::string& row : wanted) {
      EXPECT_NE(text.find("\n" + row), std::string::npos) << "doc/" << page << " lacks the row\n" << row;
    }
  }
}

TEST(Keys, AreFoundByTheirSection) {
  EXPECT_EQ(keys_text("sleep"), "sleep (doc/scene/sleep.md)\n\n" + markdown(sleep_keys().page()));
  EXPECT_NE(keys_text("method").find("method.damping.feedback"), std::string::npos);
  EXPECT_THROW(keys_text("slepe"), SceneError);
}

TEST(Keys, HoldForDefinitionsMadeInCpp) {
  EXPECT_FALSE(keys_fault(SimulationDefinition()));
  const auto key_of = [](const std::function<void(SimulationDefinition&)>& change) {
    SimulationDefinition d;
    change(d);
    const auto fault = keys_fault(d);
    return fault ? fault->key : std::string("none");
  };
  EXPECT_EQ(key_of([](auto& d) { d.time.cfl = 1.5; }), "time.cfl");
  EXPECT_EQ(key_of([](auto& d) { d.contact.detection.minimum_volume = -0.1; }), "contact.minimum_volume");
  EXPECT_EQ(key_of([](auto& d) { d.cracks.list.resize(1), d.cracks.length = 0.0; }), "cracks.length");
  EXPECT_EQ(key_of([](auto& d) { d.cracks.list.resize(1), d.cracks.contour.size = 1; }), "cracks.contour.size");
  EXPECT_EQ(key_of([](auto& d) { d.transport.quantities.resize(1), d.transport.quantities[0].order = 3; }),
            "transport.order");
  EXPECT_EQ(key_of([](auto& d) { d.sleep.emplace().balance = -1.0; }), "sleep.speed");  // the first that is not set
}

}  // namespace keys_test
}  // namespace mpm
