// contact: laws between bodies, how normals are found, and when bodies touch.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/math/nearest.hpp"
#include "mpm/rules/section_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

using Kind = ContactLaw::Kind;

const std::vector<std::string> kLawNames = {"coulomb", "stick", "interface", "one_field"};
const std::vector<std::string> kFrictional = {"friction", "static_friction", "adhesion"};
const std::vector<std::string> kStiffnesses = {"normal", "opened", "closed", "tangential"};

/// Refuses keys of constants that the law does not have.
void refuse(const Map& map, Kind kind, const std::vector<std::string>& keys, const std::string& advice) {
  for (const std::string& key : keys) {
    if (const auto value = map.find(key)) {
      value->fail(fmt::format("the law {} has none; {}", kLawNames[static_cast<int>(kind)], advice));
    }
  }
}

Function read_function(const Value& value, const Dimension& dimension) {
  return value.function(dimension, FunctionPlaces::present, kNotNegative);
}

/// Reads an interface stiffness; `perfect`, or a negative number as in the manual, means no displacement in this
/// direction.
double read_stiffness(const Value& value) {
  if (value.is_text() && value.text() == "perfect") return -1.0;
  return value.number(kStiffness);
}

Kind read_kind(const Map& map) {
  const auto friction = map.find("friction");
  const bool word = friction && friction->is_text() && friction->text() == "stick";
  if (const auto law = map.find("law")) {
    const auto kind = static_cast<Kind>(law->choice(kLawNames));
    if (word && kind != Kind::stick) friction->fail("stick is a law of its own; leave out law, or friction");
    return kind;
  }
  if (word) return Kind::stick;
  for (const std::string& key : kStiffnesses) {
    if (const auto value = map.find(key)) value->fail("a stiffness of an imperfect interface; write law: interface");
  }
  return Kind::coulomb;
}

InterfaceLaw read_interface(const Map& map) {
  InterfaceLaw law;
  const auto normal = map.find("normal"), opened = map.find("opened"), closed = map.find("closed");
  if (normal && opened && closed) normal->fail("opened and closed say all of it; leave one of the three out");
  if (normal) law.opened = law.closed = read_stiffness(*normal);
  if (opened || !normal) law.opened = read_stiffness(map.at("opened"));
  if (closed) law.closed = read_stiffness(*closed);
  law.tangential = read_stiffness(map.at("tangential"));
  return law;
}

}  // namespace

ContactLaw read_contact_law(const Map& map, bool needs_friction) {
  ContactLaw law;
  law.kind = read_kind(map);
  if (law.kind == Kind::coulomb || law.kind == Kind::stick) {
    refuse(map, law.kind, kStiffnesses, "leave it out, or write law: interface");
    if (const auto adhesion = map.find("adhesion")) law.adhesion = read_function(*adhesion, kPressure);
  }
  if (law.kind != Kind::coulomb) {
    const auto friction = map.find("friction");
    if (friction && !(law.kind == Kind::stick && friction->is_text() && friction->text() == "stick")) {
      refuse(map, law.kind, {"friction"}, "leave it out, or write law: coulomb");
    }
    refuse(map, law.kind, {"static_friction"}, "leave it out, or write law: coulomb");
  }
  switch (law.kind) {
    case Kind::coulomb: {
      const auto friction = map.find("friction");
      if (!friction && needs_friction) map.fail("coulomb needs friction; write friction: 0 for smooth bodies");
      if (friction) law.friction = read_function(*friction, kPlain);
      if (const auto at_rest = map.find("static_friction")) {
        law.static_friction = read_function(*at_rest, kPlain);
        if (law.static_friction->is_constant() && law.friction.is_constant() &&
            (*law.static_friction)(0.0) < law.friction(0.0)) {
          at_rest->fail(fmt::format("{:g} is less than the friction of sliding, {:g}; write that or more",
                                    (*law.static_friction)(0.0), law.friction(0.0)));
        }
      }
      break;
    }
    case Kind::interface: {
      refuse(map, law.kind, {"adhesion"}, "leave it out");
      law.interface = read_interface(map);
      break;
    }
    case Kind::one_field:
      refuse(map, law.kind, {"adhesion"}, "leave it out");
      refuse(map, law.kind, kStiffnesses, "leave it out, or write law: interface");
      break;
    case Kind::stick:
      break;
  }
  return law;
}

namespace {

/// Refuses rules that others leave without effect.
void check_rules(const Map& map, const ContactDefinition& contact) {
  const auto edges = map.find("edges"), position = map.find("position");
  if (edges && contact.method == ContactMethod::nodes) {
    edges->fail("it is for contact at points; leave it out, or write method: points");
  }
  if (position && contact.detection.kind != Detection::positions) {
    position->fail("a distance that surfaces touch at is for detection: positions; leave it out");
  }
}

/// Reads two different bodies, at least one of them deformable. Returns their indices, counting the deformable bodies
/// first and then the rigid ones.
std::pair<int, int> read_between(const Value& value, const Scene& scene) {
  const std::vector<Value> names = value.elements();
  if (names.size() != 2) value.fail("write the names of two bodies, such as [soil, stone]");
  std::vector<std::string> known;
  for (const BodyDefinition& body : scene.bodies) known.push_back(body.name);
  for (const RigidBodyDefinition& body : scene.definition.rigid_bodies) known.push_back(body.name);
  std::array<int, 2> found{};
  for (int i = 0; i < 2; ++i) {
    const std::string name = names[i].text();
    const auto it = std::find(known.begin(), known.end(), name);
    if (it == known.end()) names[i].fail(fmt::format("no body '{}'; {}", name, suggest(name, known)));
    found[i] = static_cast<int>(it - known.begin());
  }
  if (found[0] == found[1]) names[1].fail("a body has no law with itself; name two");
  const auto [first, second] = std::minmax(found[0], found[1]);
  if (first >= static_cast<int>(scene.bodies.size())) {
    value.fail("rigid bodies pass through each other; name a deformable body");
  }
  return {first, second};
}

/// Laws of pairs in the section, by the indices of read_between().
struct Laws {
  struct Pair {
    int first, second;
    ContactLaw law;
    std::string where;
  };
  std::vector<Pair> pairs;
  const Pair* find(int first, int second) const {
    for (const Pair& pair : pairs) {
      if (pair.first == first && pair.second == second) return &pair;
    }
    return nullptr;
  }
};

Laws read_pairs(const Value& list, const Scene& scene) {
  Laws laws;
  std::vector<std::string> keys = contact_law_keys().names();
  keys.emplace_back("between");
  for (const Value& value : list.elements()) {
    const Map map(value, keys);
    const Value between = map.at("between");
    const auto [first, second] = read_between(between, scene);
    if (const Laws::Pair* other = laws.find(first, second)) {
      between.fail(fmt::format("a second law for these two, the first is at {}; leave one out", other->where));
    }
    const ContactLaw law = read_contact_law(map, true);
    const bool tool = second >= static_cast<int>(scene.bodies.size());
    if (tool && (law.kind == Kind::interface || law.kind == Kind::one_field)) {
      map.at("law").fail(fmt::format("{} is for two deformable bodies; a tool's is coulomb or stick",
                                     kLawNames[static_cast<int>(law.kind)]));
    }
    laws.pairs.push_back({first, second, law, between.where()});
  }
  return laws;
}

/// Gives every body that has a law with another a velocity field of its own; the other bodies share one field, and move
/// together with bodies with which they have no law.
void give_fields(const Laws& laws, const std::optional<ContactLaw>& all, Scene& scene) {
  const int count = static_cast<int>(scene.bodies.size());
  std::vector<bool> own(count, all.has_value());
  for (const Laws::Pair& pair : laws.pairs) {
    if (pair.second < count) own[pair.first] = own[pair.second] = true;
  }
  int next = std::all_of(own.begin(), own.end(), [](bool one) { return one; }) ? 0 : 1;
  for (int b = 0; b < count; ++b) scene.bodies[b].field = own[b] ? next++ : 0;
  ContactLaw one_field;
  one_field.kind = Kind::one_field;
  std::string left;
  for (int first = 0; first < count; ++first) {
    for (int second = first + 1; second < count; ++second) {
      const BodyDefinition &a = scene.bodies[first], &b = scene.bodies[second];
      if (a.field == b.field) continue;
      const Laws::Pair* named = laws.find(first, second);
      if (named == nullptr && !all) left += fmt::format("{}{}/{}", left.empty() ? "" : ", ", a.name, b.name);
      scene.definition.contact.pairs.push_back(
          {a.name, b.name, named != nullptr ? named->law : all.value_or(one_field)});
    }
  }
  if (!left.empty()) {
    scene.choices.emplace_back("contact.pairs",
                               fmt::format("{}: one_field, bodies without a law stick together", left));
  }
}

Map contact_map(const Value& section) {
  std::vector<std::string> keys = contact_law_keys().names();
  for (const std::string& key : contact_keys().names()) keys.push_back(key);
  return Map(section, keys, {{"interface", "write law: interface, with opened, closed and tangential"}});
}

/// Refuses what is said of contact that the scene does not have.
void refuse_unused(const Map& map, const Scene& scene) {
  const auto& tools = scene.definition.rigid_bodies;
  const auto refuse_all = [&](const std::vector<std::string>& keys, const char* why) {
    for (const std::string& key : keys) {
      if (const auto value = map.find(key)) value->fail(why);
    }
  };
  if (tools.empty() && !map.find("law")) {
    refuse_all(kFrictional,
               "it is of tools, and there are none; for deformable bodies write law: coulomb beside it, or pairs");
  }
  const bool of_particles =
      std::any_of(tools.begin(), tools.end(), [](const RigidBodyDefinition& tool) { return tool.particles; });
  bool with_gap = of_particles, with_normals = of_particles;
  for (const PairDefinition& pair : scene.definition.contact.pairs) {
    const bool of_tool = std::any_of(tools.begin(), tools.end(),
                                     [&](const RigidBodyDefinition& tool) { return tool.name == pair.second; });
    if (of_tool || pair.law.kind == Kind::one_field) continue;
    with_normals = true;
    with_gap = with_gap || pair.law.kind != Kind::interface;
  }
  if (!of_particles) {
    refuse_all({"rigid_bias"},
               "it concerns rigid bodies of particles; write normals: particles for one, or leave it out");
  }
  if (!with_normals) {
    refuse_all(
        {"normals", "detection", "position", "minimum_volume"},
        "it concerns contact between deformable bodies and with rigid bodies of particles; write law or pairs, or "
        "normals: particles for a rigid body, or leave it out");
  }
  if (!with_gap) {
    refuse_all({"detection", "position", "minimum_volume"},
               "the scene's contact is by interfaces alone, which act wherever both bodies are; leave it out");
  }
}

}  // namespace

FrictionLaw read_contact(const Map& root, Scene& scene, bool with_tools) {
  const auto section = root.find("contact");
  if (!section) return {};
  const Map map = contact_map(*section);
  const ContactLaw law = read_contact_law(map, false);
  read_keys(map, contact_keys(), scene.definition.contact);
  check_rules(map, scene.definition.contact);
  if (!with_tools) return {};
  const auto refuse_function = [&](const char* key, const Function& function) {
    if (!function.is_constant()) map.at(key).fail("of all tools it is a number; write functions of time in pairs");
  };
  refuse_function("friction", law.friction);
  refuse_function("adhesion", law.adhesion);
  if (law.static_friction) refuse_function("static_friction", *law.static_friction);
  return law.at(0.0);
}

void read_contact_pairs(const Map& root, Scene& scene) {
  const auto section = root.find("contact");
  if (!section) return;
  const Map map = contact_map(*section);
  std::optional<ContactLaw> all;
  if (const auto named = map.find("law")) {
    all = read_contact_law(map, true);
    const bool tools = !scene.definition.rigid_bodies.empty();
    if (tools && (all->kind == Kind::interface || all->kind == Kind::one_field)) {
      named->fail(fmt::format("{} is not for tools, and this is the law of all bodies; write it in pairs",
                              kLawNames[static_cast<int>(all->kind)]));
    }
  }
  const auto list = map.find("pairs");
  const Laws laws = list ? read_pairs(*list, scene) : Laws{};
  give_fields(laws, all, scene);
  const int count = static_cast<int>(scene.bodies.size());
  for (const Laws::Pair& pair : laws.pairs) {
    if (pair.second < count) continue;
    scene.definition.contact.pairs.push_back(
        {scene.bodies[pair.first].name, scene.definition.rigid_bodies[pair.second - count].name, pair.law});
  }
  refuse_unused(map, scene);
}

}  // namespace mpm
