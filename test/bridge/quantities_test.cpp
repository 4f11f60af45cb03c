// The lists of what a run reports (message/quantities.hpp): doc/analysis.md and the messages say the same, and one line
// is all that a new number needs.
#include "mpm_ros/message/quantities.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ros/message_traits.h>

#include <fstream>
#include <set>
#include <sstream>

#include "test_files.hpp"

namespace mpm_ros {
namespace quantities_test {

std::string text_of(const std::string& path) {
  std::ifstream file(source_file(path));
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

template <class Report, class Message>
bool is_vector(const Quantity<Report, Message>& one) {
  return std::holds_alternative<mpm::Vec3>(one.of_message(Message()));
}

/// "`B fx [N]`", or "-" where there is none.
template <class Report, class Message>
std::string column_text(const Quantity<Report, Message>& one, const std::string& prefix) {
  if (one.column.empty()) return "-";
  const char* axis = one.axisymmetric ? "r" : is_vector(one) ? "x" : "";
  return fmt::format("`{}{}{} [{}]`", prefix, one.column, axis, one.unit);
}

template <class Report, class Message>
std::string keys_text(const Quantity<Report, Message>& one) {
  std::string keys;
  for (const Figure& figure : one.figures) {
    if (!figure.key.empty()) keys += (keys.empty() ? "`" : ", `") + figure.key + "`";
  }
  return keys.empty() ? "-" : keys;
}

/// The rows of the page's table of these numbers.
template <class Report, class Message>
std::string table_of(const std::vector<Quantity<Report, Message>>& quantities, const std::string& prefix) {
  std::string table;
  for (const Quantity<Report, Message>& one : quantities) {
    const std::string field = one.message_field.empty() ? "-" : "`" + one.message_field + "`";
    table +=
        fmt::format("| {} | {} | {}{} | {} | {} | {} |\n", one.name, one.unit, over_text(one.over),
                    one.meaning.empty() ? "" : "; " + one.meaning, field, column_text(one, prefix), keys_text(one));
  }
  return table;
}

TEST(Quantities, AreWhatThePageSays) {
  const std::string page = text_of("doc/analysis.md");
  for (const std::string& table :
       {table_of(contact_quantities(), "B "), table_of(pair_quantities(), "P "), table_of(tip_quantities(), ""),
        table_of(robot_quantities(), "R "), table_of(state_quantities(), "")}) {
    EXPECT_NE(page.find(table), std::string::npos) << "doc/analysis.md does not have these rows:\n" << table;
  }
}

/// The line of a message's definition that declares a field, its comment included.
std::string declaration(const std::string& definition, const std::string& field) {
  std::istringstream lines(definition.substr(0, definition.find("\n====")));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string type, name;
    if (!(words >> type >> name)) continue;
    if (type.front() != '#' && name == field) return line;
  }
  return {};
}

/// A message says of its fields the unit that the list says; counts and what has no unit are left out.
template <class Report, class Message>
void expect_units(const std::vector<Quantity<Report, Message>>& quantities) {
  for (const Quantity<Report, Message>& one : quantities) {
    if (one.message_field.empty() || one.unit == "1") continue;
    const std::string field = one.message_field.substr(0, one.message_field.find('.'));
    const std::string line = declaration(ros::message_traits::Definition<Message>::value(), field);
    EXPECT_NE(line.find("[" + one.unit + "]"), std::string::npos) << one.name << ", in " << line;
  }
}

TEST(Quantities, HaveTheUnitsOfTheMessages) {
  expect_units(contact_quantities());
  expect_units(pair_quantities());
  expect_units(tip_quantities());
  expect_units(robot_quantities());
  expect_units(state_quantities());
}

template <class Report, class Message>
void expect_names_of_their_own(const std::vector<Quantity<Report, Message>>& quantities) {
  std::set<std::string> names, columns, keys;
  for (const Quantity<Report, Message>& one : quantities) {
    EXPECT_TRUE(names.insert(one.name).second) << one.name;
    EXPECT_TRUE(one.column.empty() || columns.insert(one.column).second) << one.column;
    for (const Figure& figure : one.figures) {
      EXPECT_TRUE(figure.key.empty() || keys.insert(figure.key).second) << figure.key;
    }
  }
}

TEST(Quantities, HaveNamesOfTheirOwn) {
  expect_names_of_their_own(contact_quantities());
  expect_names_of_their_own(pair_quantities());
  expect_names_of_their_own(tip_quantities());
  expect_names_of_their_own(robot_quantities());
  expect_names_of_their_own(state_quantities());
  // By these two the statistics and the averages know the force and its interval.
  EXPECT_EQ(contact_quantities().front().name, "force");
  EXPECT_EQ(pair_quantities().front().name, "force");
}

// A line without a field of the message is carried among its values.
TEST(Quantities, NeedNoFieldOfTheirOwn) {
  const std::vector<ContactQuantity> list = {
      ContactQuantity(
          "heat", "J", Over::start, [](const mpm::ContactReport&) { return Value(2.5); }, Nothing{}, "", ""),
      ContactQuantity(
          "drag", "N", Over::mean, [](const mpm::ContactReport&) { return Value(mpm::Vec3(1.0, 2.0, 3.0)); }, Nothing{},
          "", "")};
  ContactForce message;
  fill(message, mpm::ContactReport(), list);
  ASSERT_EQ(message.values.size(), 2U);
  EXPECT_EQ(message.values[0].name, "heat");
  EXPECT_EQ(message.values[0].unit, "J");
  EXPECT_EQ(message.values[1].value, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(list[0].of_message(message), Value(2.5));
  EXPECT_EQ(list[1].of_message(message), Value(mpm::Vec3(1.0, 2.0, 3.0)));
}

}  // namespace quantities_test
}  // namespace mpm_ros
