#include "page.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "long_tests.hpp"

namespace verification {
namespace {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.3g", value);
  return buffer;
}
std::string of(const std::string& unit) { return unit.empty() || unit == "1" || unit == "-" ? "" : " " + unit; }
std::string percent(double fraction) { return text(100.0 * fraction) + " %"; }

void add_row(nlohmann::json& page, const std::string& quantity, double reached, const std::string& unit,
             nlohmann::json exact, const std::string& criterion) {
  page["rows"].push_back({{"quantity", quantity},
                          {"reached", reached},
                          {"unit", unit},
                          {"exact", std::move(exact)},
                          {"criterion", criterion}});
}

}  // namespace

Panel::Panel(const std::string& title, const std::string& x_label, const std::string& y_label)
    : json_(std::make_unique<nlohmann::json>()) {
  *json_ = {{"title", title}, {"x", x_label}, {"y", y_label}, {"series", nlohmann::json::array()}};
}
Panel::~Panel() = default;

Panel& Panel::particles(const std::string& field_label, const Numbers& x, const Numbers& z, const Numbers& field) {
  (*json_)["series"].push_back({{"kind", "particles"}, {"label", field_label}, {"x", x}, {"y", z}, {"c", field}});
  return *this;
}

Panel& Panel::map(const Map& map) {
  (*json_)["map"] = map.json();
  return *this;
}

Panel& Panel::log_x() {
  (*json_)["log_x"] = true;
  return *this;
}

Panel& Panel::log_y() {
  (*json_)["log_y"] = true;
  return *this;
}

Panel& Panel::order(double order) {
  (*json_)["order"] = order;
  return *this;
}

Panel& Panel::add(const char* kind, const std::string& label, const Numbers& x, const Numbers& y) {
  (*json_)["series"].push_back({{"kind", kind}, {"label", label}, {"x", x}, {"y", y}});
  return *this;
}

nlohmann::json Figure::json() const {
  nlohmann::json list = nlohmann::json::array();
  for (const Panel& panel : panels_) list.push_back(panel.json());
  return list;
}

Page::Page(const std::string& chapter, std::string name, const std::string& title)
    : name_(std::move(name)), json_(std::make_unique<nlohmann::json>()) {
  nlohmann::json& json = *json_;
  json = {{"chapter", chapter}, {"title", title}, {"rows", nlohmann::json::array()}};
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string suite = test->test_suite_name();
  json["test"] = suite + "." + test->name();
  if (suite.rfind("Full", 0) == 0) name_ = "full_" + name_;
  json["name"] = name_;
  long_ = long_test(suite, test->name(), test->file());
}

Page::~Page() {
  const char* folder = std::getenv("MPM_PAGES");
  if (folder == nullptr) return;
  // Those of long tests stay when only the short ones run again.
  const std::filesystem::path pages = std::filesystem::path(folder) / (long_ ? "long" : "short");
  std::filesystem::create_directories(pages);
  (*json_)["figure"] = figure_.json();
  (*json_)["passed"] = !testing::Test::HasFailure();
  std::ofstream(pages / (name_ + ".json")) << json_->dump(1) << '\n';
}

void Page::near(const std::string& quantity, double reached, double exact, double relative, const std::string& unit) {
  EXPECT_NEAR(reached, exact, relative * std::abs(exact)) << quantity;
  add_row(*json_, quantity, reached, unit, exact, "within " + percent(relative));
}

void Page::near_absolute(const std::string& quantity, double reached, double exact, double absolute,
                         const std::string& unit) {
  EXPECT_NEAR(reached, exact, absolute) << quantity;
  add_row(*json_, quantity, reached, unit, exact, "within " + text(absolute) + of(unit));
}

void Page::below(const std::string& quantity, double reached, double limit, const std::string& unit) {
  EXPECT_LE(reached, limit) << quantity;
  add_row(*json_, quantity, reached, unit, nullptr, "at most " + text(limit) + of(unit));
}

void Page::above(const std::string& quantity, double reached, double limit, const std::string& unit) {
  EXPECT_GE(reached, limit) << quantity;
  add_row(*json_, quantity, reached, unit, nullptr, "at least " + text(limit) + of(unit));
}

void Page::beside(const std::string& quantity, double reached, double published, const std::string& unit) {
  add_row(*json_, quantity, reached, unit, published, "reported");
}

void Page::report(const std::string& quantity, double reached, const std::string& unit) {
  add_row(*json_, quantity, reached, unit, nullptr, "reported");
}

Page& Page::set(const char* key, const std::string& value) {
  (*json_)[key] = value;
  return *this;
}

}  // namespace verification
