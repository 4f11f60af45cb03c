// Needs of the tips of cracks in the material in which they lie: a law that has J, constants for the criterion of
// growth, and room for the contour of J.
// Source: crack reference 4.1, 5.2.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/crack/chain.hpp"
#include "mpm/crack/elastic_constants.hpp"
#include "mpm/crack/fracture_criterion.hpp"
#include "mpm/material/law.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

/// Bodies in which a crack acts.
std::vector<const BodyDefinition*> cracked_bodies(const CrackDefinition& crack, const Scene& scene) {
  const auto& ignored = scene.definition.cracks.ignored_by;
  std::vector<const BodyDefinition*> found;
  for (const BodyDefinition& body : scene.bodies) {
    const bool heeds = std::find(ignored.begin(), ignored.end(), body.name) == ignored.end();
    if (heeds && (crack.body.empty() || crack.body == body.name)) found.push_back(&body);
  }
  return found;
}

std::size_t material_of(const std::string& name, const Scene& scene) {
  const auto& all = scene.definition.materials;
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.name == name; });
  return static_cast<std::size_t>(found - all.begin());
}

bool has_strain_energy(const LawDefinition& law) { return traits_of(law).matter == Matter::solid; }

/// Refuses a rule that asks for the openings of faces that are not followed.
void check_fixed(const Value& end, const GrowthRule& rule, const CrackDefinition& crack, const CracksDefinition& all) {
  if (!crack.fixed || rule.criterion == FractureCriterion::none) return;
  const bool of_openings = rule.criterion == FractureCriterion::opening ||
                           rule.direction == GrowthDirection::normal_to_opening ||
                           rule.direction == GrowthDirection::hoop_of_opening ||
                           (needs_stress_intensity(rule.criterion) && all.split == CracksDefinition::Split::openings);
  if (of_openings) {
    end.fail(fmt::format(
        "'{}' grows by openings, and the faces of a fixed crack are not followed; leave out fixed, or write "
        "criterion: release_rate with direction: self_similar",
        crack.name));
  }
}

/// Refuses tractions of new faces that would have none, or friction beside them.
void check_new_faces(const Value& end, const GrowthRule& rule, const CrackDefinition& crack) {
  if (rule.criterion == FractureCriterion::none || rule.traction.empty()) return;
  if (crack.fixed) {
    end.fail(fmt::format("'{}' is fixed, and its growth has the tractions '{}'; leave out fixed, or the tractions",
                         crack.name, rule.traction));
  }
  if (!crack.faces.smooth()) {
    end.fail(fmt::format(
        "faces with a law of tractions are smooth where they meet, and the growth of '{}' has '{}'; leave out faces",
        crack.name, rule.traction));
  }
}

void check_growth(const Value& end, const CrackDefinition& crack, std::size_t material, const Scene& scene) {
  const CracksDefinition& cracks = scene.definition.cracks;
  const FractureConstants& constants = cracks.materials[material];
  const MaterialDefinition& definition = scene.definition.materials[material];
  const std::optional<ElasticConstants> elastic = elastic_constants_of(definition, scene.definition.geometry);
  const GrowthRule first = constants.growth.value_or(cracks.growth);
  const GrowthRule second = constants.alternate.value_or(cracks.alternate);
  // A material that switches the scene's growth off does so with its alternate rule.
  const bool switched_off = constants.growth && !constants.alternate;
  if (first.criterion == FractureCriterion::none && second.criterion != FractureCriterion::none && !switched_off) {
    end.fail(
        fmt::format("the tip's material is '{}', with an alternate rule and no first one, which it stands in for: "
                    "write growth: {{criterion: ...}}, or leave out alternate",
                    definition.name));
  }
  for (const bool alternate : {false, true}) {
    const GrowthRule& rule = alternate ? second : first;
    const std::string fault = criterion_fault(rule, constants, elastic ? &*elastic : nullptr, alternate);
    if (!fault.empty()) {
      end.fail(fmt::format("the tip's material is '{}', and its {}: {}", definition.name,
                           alternate ? "alternate" : "growth", fault));
    }
    check_fixed(end, rule, crack, cracks);
    if (crack.traction_of_growth.empty()) check_new_faces(end, rule, crack);
  }
}

/// Refuses an exterior end with material beyond it, which its lengthened last segment would cut.
void check_exterior(const Value& end, const char* key, const CrackDefinition& crack, std::size_t side,
                    const std::vector<const BodyDefinition*>& bodies) {
  const std::size_t last = crack.points.size() - 1;
  const Vec2 &place = side == 0 ? crack.points[0] : crack.points[last],
             &before = side == 0 ? crack.points[1] : crack.points[last - 1];
  const Vec2 beyond = place + kExteriorReach * (place - before);
  for (const BodyDefinition* body : bodies) {
    if (!body->region.contains({beyond.x(), 0.0, beyond.y()})) continue;
    end.fail(fmt::format(
        "an exterior end is lengthened by {:g} segments, and '{}' is still there at ({:g}, {:g}) m; put the end a "
        "quarter to half a cell inside the surface, or write {}: none",
        kExteriorReach, body->name, beyond.x(), beyond.y(), key));
  }
}

/// Refuses a contour that leaves the bodies, as far as a box around them shows.
void check_room(const Value& end, const Vec2& tip, const std::vector<const BodyDefinition*>& bodies,
                const Scene& scene) {
  const GridDefinition& grid = scene.definition.grid;
  const int size = scene.definition.cracks.contour.size;
  Box box;
  for (const BodyDefinition* body : bodies) {
    box.add(body->region.bounds().min);
    box.add(body->region.bounds().max);
  }
  for (const int axis : axes_of(scene)) {
    const double cell = grid.cell[axis], place = axis == 0 ? tip.x() : tip.y();
    const double node = grid.min[axis] + std::round((place - grid.min[axis]) / cell) * cell;
    const double room = std::min(node - box.min[axis], box.max[axis] - node) / cell;
    if (size <= room + 1e-6) continue;
    end.fail(fmt::format(
        "the contour of J reaches {} cells from the tip and leaves the material after {:.3g} along {}; write a smaller "
        "contour: {{size}}, of 2 at least, or a finer grid",
        size, std::max(0.0, room), axis_name(axis)));
  }
}

}  // namespace

void check_crack_tips(const Value& value, const CrackDefinition& crack, const Scene& scene) {
  const std::vector<const BodyDefinition*> bodies = cracked_bodies(crack, scene);
  if (bodies.empty()) value.fail("cracks.ignored_by names every body; leave one out");
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    const char* key = side == 0 ? "start" : "end";
    const YAML::Node node = value.node()[key];
    const Value end = node ? value.child(node, key) : value;
    if (crack.ends[side] == CrackEnd::exterior) check_exterior(end, key, crack, side, bodies);
    if (crack.ends[side] != CrackEnd::tip) continue;
    if (crack.faces.law.kind == ContactLaw::Kind::interface) {
      end.fail(fmt::format("an interface has no J, for its faces carry load; write {}: none", key));
    }
    const Vec2& tip = side == 0 ? crack.points.front() : crack.points.back();
    const auto around = std::find_if(bodies.begin(), bodies.end(), [&](const BodyDefinition* body) {
      return body->region.contains({tip.x(), 0.0, tip.y()});
    });
    if (around == bodies.end()) {
      end.fail(fmt::format("the tip ({:g}, {:g}) m is in no body that the crack divides; write {}: exterior", tip.x(),
                           tip.y(), key));
    }
    const std::string& named = crack.tip_materials[side];
    const std::size_t material = material_of(named.empty() ? (*around)->material : named, scene);
    const MaterialDefinition& definition = scene.definition.materials[material];
    if (!has_strain_energy(definition.law)) {
      end.fail(fmt::format(
          "J is of solids, and the tip's material '{}' is {}, which has no deformation from a shape at rest; "
          "write {}: none",
          definition.name, law_name(definition.law), key));
    }
    check_growth(end, crack, material, scene);
    check_room(end, tip, bodies, scene);
  }
}

}  // namespace mpm
