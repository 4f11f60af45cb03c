// A section of doc/verification.md or doc/methods.md, written by the test that checks it: the problem, the exact
// solution and its source, a picture, the numbers, and what they mean. A number that the page shows as checked is
// checked by the same call.
//
//   Page page("waves", "bar", "A bar that vibrates along its axis");
//   page.problem("…").exact("…", "the wave equation").meaning("…");
//   page.near("period", measured, exact, 0.005, "s");        // row of the table, and EXPECT within 0.5 % of exact
//   page.figure().panel("Tip", "time [s]", "u [m]").line("exact", t, u).points("particles", tp, up);
//
// With the environment's MPM_PAGES set to a folder, the page is written there as JSON when it goes out of scope;
// scripts/make_verification.py and scripts/stability_pages.py make text and pictures from the folder.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "map.hpp"

namespace verification {

using Numbers = std::vector<double>;

/// One pair of axes.
class Panel {
 public:
  Panel(const std::string& title, const std::string& x_label, const std::string& y_label) {
    json_ = {{"title", title}, {"x", x_label}, {"y", y_label}, {"series", nlohmann::json::array()}};
  }
  /// What is exact: drawn as a black line.
  Panel& exact(const std::string& label, const Numbers& x, const Numbers& y) { return add("exact", label, x, y); }
  Panel& line(const std::string& label, const Numbers& x, const Numbers& y) { return add("line", label, x, y); }
  Panel& points(const std::string& label, const Numbers& x, const Numbers& y) { return add("points", label, x, y); }
  /// Published or measured by others: hollow marks.
  Panel& published(const std::string& label, const Numbers& x, const Numbers& y) {
    return add("published", label, x, y);
  }
  /// Particles at (x, z) coloured by a field; the axes get equal scales.
  Panel& particles(const std::string& field_label, const Numbers& x, const Numbers& z, const Numbers& field) {
    json_["series"].push_back({{"kind", "particles"}, {"label", field_label}, {"x", x}, {"y", z}, {"c", field}});
    return *this;
  }
  /// In place of curves. The values of the parameter are told beside the cells; the panel's axes have no labels.
  Panel& map(const Map& map) {
    json_["map"] = map.json();
    return *this;
  }
  /// Logarithmic axes.
  Panel& log_x() {
    json_["log_x"] = true;
    return *this;
  }
  Panel& log_y() {
    json_["log_y"] = true;
    return *this;
  }
  /// A triangle that shows the slope of this order on a log-log panel.
  Panel& order(double order) {
    json_["order"] = order;
    return *this;
  }
  const nlohmann::json& json() const { return json_; }

 private:
  Panel& add(const char* kind, const std::string& label, const Numbers& x, const Numbers& y) {
    json_["series"].push_back({{"kind", kind}, {"label", label}, {"x", x}, {"y", y}});
    return *this;
  }
  nlohmann::json json_;
};

/// Panels side by side under one caption.
class Figure {
 public:
  Panel& panel(const std::string& title, const std::string& x_label, const std::string& y_label) {
    panels_.emplace_back(title, x_label, y_label);
    return panels_.back();
  }
  nlohmann::json json() const {
    nlohmann::json list = nlohmann::json::array();
    for (const Panel& panel : panels_) list.push_back(panel.json());
    return list;
  }

 private:
  std::list<Panel> panels_;  // references to panels stay good
};

class Page {
 public:
  /// `chapter`: a key of CHAPTERS in the script that makes the document; `name`: of the picture's file.
  Page(std::string chapter, std::string name, const std::string& title) : name_(std::move(name)) {
    json_ = {{"chapter", std::move(chapter)}, {"title", title}, {"rows", nlohmann::json::array()}};
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const std::string suite = test->test_suite_name();
    json_["test"] = suite + "." + test->name();
    if (suite.rfind("Full", 0) == 0) name_ = "full_" + name_;  // kept when only the short tests are run again
    json_["name"] = name_;
  }
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;
  ~Page() {
    const char* folder = std::getenv("MPM_PAGES");
    if (folder == nullptr) return;
    std::filesystem::create_directories(folder);
    json_["figure"] = figure_.json();
    json_["passed"] = !testing::Test::HasFailure();
    std::ofstream(std::filesystem::path(folder) / (name_ + ".json")) << json_.dump(1) << '\n';
  }

  /// What is computed: geometry, material, loading, cells, method.
  Page& problem(const std::string& text) { return set("problem", text); }
  /// The exact solution in words and formulas, and where it comes from.
  Page& exact(const std::string& text, const std::string& source) {
    json_["source"] = source;
    return set("exact", text);
  }
  /// What the result tells a user.
  Page& meaning(const std::string& text) { return set("meaning", text); }
  /// The scene file that a user can run: a name below test/verification/scenes or a shipped scene.
  Page& scene(const std::string& file) { return set("scene", file); }
  Figure& figure() { return figure_; }

  /// Checked: |reached - exact| <= relative |exact|.
  void near(const std::string& quantity, double reached, double exact, double relative, const std::string& unit) {
    EXPECT_NEAR(reached, exact, relative * std::abs(exact)) << quantity;
    row(quantity, reached, unit, exact, "within " + percent(relative));
  }
  /// Checked: |reached - exact| <= absolute, in the quantity's own unit.
  void near_absolute(const std::string& quantity, double reached, double exact, double absolute,
                     const std::string& unit) {
    EXPECT_NEAR(reached, exact, absolute) << quantity;
    row(quantity, reached, unit, exact, "within " + text(absolute) + of(unit));
  }
  /// Checked: reached <= limit.
  void below(const std::string& quantity, double reached, double limit, const std::string& unit) {
    EXPECT_LE(reached, limit) << quantity;
    row(quantity, reached, unit, nullptr, "at most " + text(limit) + of(unit));
  }
  /// Checked: reached >= limit.
  void above(const std::string& quantity, double reached, double limit, const std::string& unit) {
    EXPECT_GE(reached, limit) << quantity;
    row(quantity, reached, unit, nullptr, "at least " + text(limit) + of(unit));
  }
  /// Shown beside a published number, not checked.
  void beside(const std::string& quantity, double reached, double published, const std::string& unit) {
    row(quantity, reached, unit, published, "reported");
  }
  /// Shown, not checked.
  void report(const std::string& quantity, double reached, const std::string& unit) {
    row(quantity, reached, unit, nullptr, "reported");
  }

 private:
  Page& set(const char* key, const std::string& value) {
    json_[key] = value;
    return *this;
  }
  void row(const std::string& quantity, double reached, const std::string& unit, nlohmann::json exact,
           const std::string& criterion) {
    json_["rows"].push_back(
        {{"quantity", quantity}, {"reached", reached}, {"unit", unit}, {"exact", exact}, {"criterion", criterion}});
  }
  static std::string text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.3g", value);
    return buffer;
  }
  static std::string of(const std::string& unit) {
    return unit.empty() || unit == "1" || unit == "-" ? "" : " " + unit;
  }
  static std::string percent(double fraction) { return text(100.0 * fraction) + " %"; }

  std::string name_;
  nlohmann::json json_;
  Figure figure_;
};

}  // namespace verification
