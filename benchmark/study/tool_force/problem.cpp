#include "study/tool_force/problem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/suite.hpp"

namespace mpm::study::tool_force {

double Problem::last(double cells) const { return moves_on ? std::max(to, from + 1.0 / cells) : to; }

double Problem::time_of(double travel) const { return travel * length / speed + 0.5 * ramp; }

const std::vector<Problem>& problems() {
  static const std::vector<Problem> list = [] {
    std::vector<Problem> all;
    for (const auto& group : {blades, footings, walls, clay_tools, slopes, drags}) {
      for (Problem& problem : group()) all.push_back(std::move(problem));
    }
    return all;
  }();
  return list;
}

const Problem& find_problem(const std::string& name) {
  std::string names;
  for (const Problem& problem : problems()) {
    if (problem.name == name) return problem;
    names += (names.empty() ? "" : ", ") + problem.name;
  }
  throw StudyError(fmt::format("no problem of tool_force is called '{}'; there are {}", name, names));
}

std::string soil_material(const std::string& law, double density, double young, double poisson, double friction,
                          double dilation, double cohesion) {
  const std::size_t stroke = law.find('/');
  const std::string match = stroke == std::string::npos ? "" : ", match: " + law.substr(stroke + 1);
  return fmt::format(
      "{{name: soil, law: {}{}, density: {:g}, young: {:g}, poisson: {:g}, friction_angle: {:g} deg, "
      "dilation_angle: {:g} deg, dilation_limit: none, cohesion: {:g}}}",
      law.substr(0, stroke), match, density, young, poisson, friction, dilation, cohesion);
}

std::string time_section(const Problem& problem, const Setup& setup) {
  // A tenth of a cell, and a twentieth of the stretch of the mean, or less; a power of ten, so that the end is a whole
  // number of sync periods to round-off.
  const double most = std::min(0.05 / setup.cells, 0.05 * (problem.to - problem.from)) * problem.length / problem.speed;
  const double sync = std::pow(10.0, std::floor(std::log10(most)));
  const double end = sync * std::ceil(problem.time_of(problem.last(setup.cells)) / sync + 1.0);
  return fmt::format("time: {{end: {:.12g}, sync: {:g}}}", end, sync);
}

std::string speed_expression(const Problem& problem) {
  return fmt::format("{:g} * min(1, t / {:g})", problem.speed, problem.ramp);
}

double elastic_wave(double density, double young, double poisson) {
  return std::sqrt(young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)) / density);
}

}  // namespace mpm::study::tool_force
