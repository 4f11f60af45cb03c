#include "mpm/crack/traction_completion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>

#include "mpm/crack/crack_error.hpp"
#include "mpm/crack/traction_curve.hpp"

namespace mpm {
namespace {

using Given = std::optional<double>;

int count_given(std::initializer_list<Given> numbers) {
  int count = 0;
  for (const Given& number : numbers) count += number.has_value();
  return count;
}

void expect_above_zero(std::initializer_list<std::pair<const char*, Given>> numbers) {
  for (const auto& [name, number] : numbers) {
    if (number && !(*number > 0.0 && std::isfinite(*number))) {
      throw CrackError(fmt::format("the {} of a traction law must be positive and finite, it is {}", name, *number));
    }
  }
}

void expect_above_zero(const GivenTraction& given) {
  expect_above_zero({{"toughness", given.toughness},
                     {"strength", given.strength},
                     {"opening at failure", given.opening},
                     {"stiffness", given.stiffness},
                     {"elastic opening", given.elastic},
                     {"elastic part of the opening", given.elastic_part}});
}

/// Fills strength and opening of a law with toughness = area * strength * opening.
void complete_two_of_three(const GivenTraction& given, const char* kind, double area, TractionMode& mode) {
  const int count = count_given({given.toughness, given.strength, given.opening});
  if (count != 2) {
    throw CrackError(fmt::format("a {} traction law takes two of toughness, strength and opening, {} given", kind,
                                 count == 0   ? "none is"
                                 : count == 1 ? "only one is"
                                              : "all three are"));
  }
  mode.strength = given.strength ? *given.strength : *given.toughness / (area * *given.opening);
  mode.opening = given.opening ? *given.opening : *given.toughness / (area * *given.strength);
}

}  // namespace

TractionMode complete_triangular(const GivenTraction& given) {
  expect_above_zero(given);
  TractionMode mode;
  complete_two_of_three(given, "triangular", 0.5, mode);
  if (count_given({given.stiffness, given.elastic, given.elastic_part}) > 1) {
    throw CrackError("a triangular traction law takes at most one of its stiffness and its elastic opening");
  }
  mode.elastic = given.stiffness ? mode.strength / *given.stiffness
                 : given.elastic ? *given.elastic
                                 : given.elastic_part.value_or(kTriangularElasticPart) * mode.opening;
  TractionCurve(TractionKind::triangular, mode);
  return mode;
}

TractionMode complete_cubic(const GivenTraction& given) {
  expect_above_zero(given);
  TractionMode mode;
  complete_two_of_three(given, "cubic", 9.0 / 16.0, mode);
  if (count_given({given.stiffness, given.elastic, given.elastic_part}) > 0) {
    throw CrackError(
        "a cubic traction law takes no stiffness and no elastic opening: it has its peak at a third of its "
        "opening");
  }
  TractionCurve(TractionKind::cubic, mode);
  return mode;
}

TractionMode complete_exponential(const GivenTraction& given, double decay) {
  expect_above_zero(given);
  expect_above_zero({{"decay", decay}});
  if (count_given({given.toughness, given.opening}) != 1) {
    throw CrackError("an exponential traction law takes either its toughness or its opening at failure");
  }
  if (count_given({given.elastic, given.elastic_part}) > 1 ||
      count_given({given.strength, given.stiffness, given.elastic, given.elastic_part}) != 2) {
    throw CrackError("an exponential traction law takes two of strength, stiffness and elastic opening");
  }
  const double area = exponential_area(decay);
  TractionMode mode;
  mode.decay = decay;
  if (given.elastic_part) {
    const double part = *given.elastic_part, whole = 0.5 * (part + area * (1.0 - part));  // G_c = whole sigma u_c
    if (!(part < 1.0))
      throw CrackError(fmt::format("the elastic part of an opening must be less than 1, not {}", part));
    if (given.opening) {
      mode.opening = *given.opening;
    } else {
      mode.opening = given.strength ? *given.toughness / (whole * *given.strength)
                                    : std::sqrt(*given.toughness / (whole * *given.stiffness * part));
    }
    mode.elastic = part * mode.opening;
    mode.strength = given.strength ? *given.strength : *given.stiffness * mode.elastic;
  } else {
    mode.elastic = given.elastic ? *given.elastic : *given.strength / *given.stiffness;
    mode.strength = given.strength ? *given.strength : *given.stiffness * mode.elastic;
    mode.opening =
        given.opening ? *given.opening : mode.elastic + (2.0 * *given.toughness / mode.strength - mode.elastic) / area;
    if (!(mode.opening > mode.elastic)) {
      throw CrackError(
          fmt::format("an exponential traction law of {} Pa that is elastic up to {} m stores {} J/m^2 by "
                      "then: its opening at failure must be larger, and its toughness more than that",
                      mode.strength, mode.elastic, 0.5 * mode.strength * mode.elastic));
    }
  }
  TractionCurve(TractionKind::exponential, mode);
  return mode;
}

// 2 G_c = sigma_1 u_2 + sigma_2 (u_c - u_1).
TractionMode complete_trilinear(const GivenTrilinear& given) {
  expect_above_zero({{"strength", given.strength},
                     {"elastic opening", given.elastic},
                     {"traction at the second corner", given.strength_2},
                     {"opening of the second corner", given.elastic_2},
                     {"opening at failure", given.opening},
                     {"toughness", given.toughness},
                     {"stiffness", given.stiffness}});
  if (given.stiffness && given.strength && given.elastic) {
    throw CrackError(
        "the first corner of a trilinear traction law takes two of strength, elastic opening and stiffness");
  }
  if (count_given({given.strength, given.elastic, given.strength_2, given.elastic_2, given.opening, given.toughness,
                   given.stiffness}) != 5) {
    throw CrackError(
        "a trilinear traction law takes five of: traction and opening at both corners, opening at failure, "
        "toughness; a stiffness stands for one number of the first corner");
  }
  GivenTrilinear g = given;
  if (g.stiffness && g.elastic) g.strength = *g.stiffness * *g.elastic;
  if (g.stiffness && g.strength && !g.elastic) g.elastic = *g.strength / *g.stiffness;
  if (g.stiffness && !g.elastic) {
    g.elastic = (2.0 * *g.toughness - *g.strength_2 * *g.opening) / (*g.stiffness * *g.elastic_2 - *g.strength_2);
    g.strength = *g.stiffness * *g.elastic;
  }
  if (!g.strength) g.strength = (2.0 * *g.toughness - *g.strength_2 * (*g.opening - *g.elastic)) / *g.elastic_2;
  if (!g.elastic) g.elastic = *g.opening - (2.0 * *g.toughness - *g.strength * *g.elastic_2) / *g.strength_2;
  if (!g.strength_2) g.strength_2 = (2.0 * *g.toughness - *g.strength * *g.elastic_2) / (*g.opening - *g.elastic);
  if (!g.elastic_2) g.elastic_2 = (2.0 * *g.toughness - *g.strength_2 * (*g.opening - *g.elastic)) / *g.strength;
  if (!g.opening) g.opening = *g.elastic + (2.0 * *g.toughness - *g.strength * *g.elastic_2) / *g.strength_2;
  TractionMode mode;
  mode.strength = *g.strength;
  mode.elastic = *g.elastic;
  mode.strength_2 = *g.strength_2;
  mode.elastic_2 = *g.elastic_2;
  mode.opening = *g.opening;
  TractionCurve(TractionKind::trilinear, mode);
  return mode;
}

}  // namespace mpm
