// A section of doc/verification.md or doc/methods.md, written by the test that checks it: the problem, the exact
// solution and its source, a picture, the numbers, and their meaning. The call that puts a checked number on the page
// also checks it.
//
//   Page page("waves", "bar", "A bar that vibrates along its axis");
//   page.problem("…").exact("…", "the wave equation").meaning("…");
//   page.near("period", measured, exact, 0.005, "s");        // row of the table, and EXPECT within 0.5 % of exact
//   page.figure().panel("Tip", "time [s]", "u [m]").line("exact", t, u).points("particles", tp, up);
//
// If the environment variable MPM_PAGES names a folder, the page is written there as JSON when it goes out of scope;
// scripts/make_verification.py and scripts/stability_pages.py make text and pictures from the folder.
#pragma once

#include <gtest/gtest.h>

#include <list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "map.hpp"

namespace verification {

using Numbers = std::vector<double>;

/// One pair of axes.
class Panel {
 public:
  Panel(const std::string& title, const std::string& x_label, const std::string& y_label);
  ~Panel();
  /// The exact solution, drawn as a black line.
  Panel& exact(const std::string& label, const Numbers& x, const Numbers& y) { return add("exact", label, x, y); }
  Panel& line(const std::string& label, const Numbers& x, const Numbers& y) { return add("line", label, x, y); }
  Panel& points(const std::string& label, const Numbers& x, const Numbers& y) { return add("points", label, x, y); }
  /// Values published or measured by others, drawn as hollow marks.
  Panel& published(const std::string& label, const Numbers& x, const Numbers& y) {
    return add("published", label, x, y);
  }
  /// Particles at (x, z), coloured by a field; the axes get equal scales.
  Panel& particles(const std::string& field_label, const Numbers& x, const Numbers& z, const Numbers& field);
  /// Draws a map in place of curves. The values of the parameter stand beside its cells; the axes have no labels.
  Panel& map(const Map& map);
  /// Makes an axis logarithmic.
  Panel& log_x();
  Panel& log_y();
  /// Adds a triangle that shows the slope of this order on a log-log panel.
  Panel& order(double order);
  const nlohmann::json& json() const { return *json_; }

 private:
  Panel& add(const char* kind, const std::string& label, const Numbers& x, const Numbers& y);
  std::unique_ptr<nlohmann::json> json_;
};

/// Panels side by side under one caption.
class Figure {
 public:
  Panel& panel(const std::string& title, const std::string& x_label, const std::string& y_label) {
    panels_.emplace_back(title, x_label, y_label);
    return panels_.back();
  }
  nlohmann::json json() const;

 private:
  std::list<Panel> panels_;  // a list, so that references to panels stay valid
};

class Page {
 public:
  /// `chapter`: a key of CHAPTERS in the script that makes the document; `name`: name of the picture's file.
  Page(const std::string& chapter, std::string name, const std::string& title);
  Page(const Page&) = delete;
  Page& operator=(const Page&) = delete;
  ~Page();

  /// The problem that is computed: geometry, material, loading, cells, method.
  Page& problem(const std::string& text) { return set("problem", text); }
  /// The exact solution in words and formulas, and its source.
  Page& exact(const std::string& text, const std::string& source) { return set("source", source).set("exact", text); }
  /// The meaning of the result for a user.
  Page& meaning(const std::string& text) { return set("meaning", text); }
  /// The scene that a user can run: the name of a file in test/verification/scenes or of a shipped scene.
  Page& scene(const std::string& file) { return set("scene", file); }
  Figure& figure() { return figure_; }

  /// Adds a number and expects |reached - exact| <= relative |exact|.
  void near(const std::string& quantity, double reached, double exact, double relative, const std::string& unit);
  /// Adds a number and expects |reached - exact| <= absolute, in the quantity's own unit.
  void near_absolute(const std::string& quantity, double reached, double exact, double absolute,
                     const std::string& unit);
  /// Adds a number and expects reached <= limit.
  void below(const std::string& quantity, double reached, double limit, const std::string& unit);
  /// Adds a number and expects reached >= limit.
  void above(const std::string& quantity, double reached, double limit, const std::string& unit);
  /// Adds a number beside a published one, without a check.
  void beside(const std::string& quantity, double reached, double published, const std::string& unit);
  /// Adds a number without a check.
  void report(const std::string& quantity, double reached, const std::string& unit);

 private:
  Page& set(const char* key, const std::string& value);

  std::string name_;
  bool long_ = false;  ///< true for a test that only --full runs
  std::unique_ptr<nlohmann::json> json_;
  Figure figure_;
};

}  // namespace verification
