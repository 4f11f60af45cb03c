#include "mpm/sections/material_driver.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <optional>

#include "mpm/material/path_driver.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

constexpr int kStepsOfALeg = 100;
constexpr int kStepsOfARow = 10;

/// True if the text is a map without the key `name`. The reader reports a text that is not a map.
bool is_nameless(const std::string& text) {
  try {
    const YAML::Node node = YAML::Load(text);
    return node.IsMap() && !node["name"];
  } catch (const YAML::Exception&) {
    return false;
  }
}

MaterialDefinition read_inline(const std::string& text) {
  // Reading it as an element of a scene's list gives the same keys, units and errors.
  const std::vector<std::string> overrides =
      is_nameless(text) ? std::vector<std::string>{"materials.0.name=material"} : std::vector<std::string>{};
  const Source source("materials: [" + text + "]", "MATERIAL", overrides);
  ReadContext context;
  context.source = &source;
  const Map root(Value(context, source.root(), ""), {"materials", "transport", "cracks"});
  Scene scene;
  read_materials(root, scene);
  const std::vector<MaterialDefinition>& materials = scene.definition.materials;
  if (materials.size() != 1) {
    throw SceneError(fmt::format("MATERIAL: {} materials; write one, in braces: {{law: neo_hookean, density: 1000, …}}",
                                 materials.size()));
  }
  return materials.front();
}

std::optional<double> quantity(const std::string& text, const char* option, const Dimension& dimension) {
  if (text.empty()) return std::nullopt;
  try {
    return parse_quantity(text, dimension);
  } catch (const UnitError& error) {
    throw PathError(fmt::format("--{}: {}", option, error.what()));
  }
}

std::string header(bool wet) {
  std::string line = "time [s]";
  for (const char* name : kComponentNames) line += fmt::format(",e{} [1]", name);
  line += ",j [1]";
  for (const char* name : kComponentNames) line += fmt::format(",s{} [Pa]", name);
  return line +
         ",p [Pa],mises [Pa],plastic_strain [1],elastic_energy [J/kg],plastic_energy [J/kg],work [J/kg],"
         "wave_speed [m/s],temperature [K]" +
         (wet ? ",pore_pressure [Pa]\n" : "\n");
}

std::string row(const PathDriver& driver, bool wet) {
  const MaterialPoint& point = driver.point();
  const Symmetric3<double> stress = point.cauchy();
  const double mean = trace(stress) / 3.0;
  const double mises = std::sqrt(1.5 * squared_norm(scale_shift(stress, 1.0, -mean)));
  std::string line = fmt::format("{:.10g}", driver.time());
  const auto add = [&line](double value) { line += fmt::format(",{:.10g}", value); };
  for (const double strain : components(driver.logarithmic_strain())) add(strain);
  add(point.j());
  for (const double component : components(stress)) add(component);
  for (const double value : {0.0 - mean, mises, point.plastic_strain(), point.elastic_energy(), point.plastic_work(),
                             driver.work(), point.wave_speed(), point.temperature()}) {
    add(value);
  }
  if (wet) add(point.pore_pressure());
  return line + "\n";
}

}  // namespace

MaterialDefinition read_driven_material(const MaterialDriverOptions& options) {
  if (options.scene.empty()) return read_inline(options.material);
  const Scene scene = load_scene(options.scene);
  std::vector<std::string> names;
  for (const MaterialDefinition& material : scene.definition.materials) {
    if (material.name == options.material) return material;
    names.push_back(material.name);
  }
  throw SceneError(fmt::format("{}: materials: no material '{}'; {}", scene.path, options.material,
                               suggest(options.material, names)));
}

StrainPath read_driven_path(const MaterialDriverOptions& options) {
  if (options.steps < 0) throw PathError(fmt::format("{} steps; take at least one", options.steps));
  if (options.path.empty() == options.path_file.empty()) {
    throw PathError(fmt::format("give one path: a name of {}, or --path FILE", fmt::join(strain_path_names(), ", ")));
  }
  PathDefinition definition;
  definition.strain = quantity(options.strain, "strain", kPlain);
  definition.confining = quantity(options.confining, "confining", kPressure);
  definition.stress = quantity(options.stress, "stress", kPressure);
  definition.rate = quantity(options.rate, "rate", kRate);
  definition.hold = quantity(options.hold, "hold", kTime);
  definition.shear = options.shear;
  if (!options.path.empty()) {
    definition.steps = options.steps == 0 ? kStepsOfALeg : options.steps;
    return make_strain_path(options.path, definition);
  }
  if (definition.strain || definition.confining || definition.stress || definition.rate || definition.hold ||
      definition.shear) {
    throw PathError("a path from a file has its own strains, stresses and times; give --steps alone");
  }
  return read_path_file(options.path_file, options.steps == 0 ? kStepsOfARow : options.steps);
}

void drive_material(const MaterialDriverOptions& options, std::ostream& out) {
  StrainPath path = read_driven_path(options);
  const std::optional<double> storage = quantity(options.storage, "storage", kPerPascal);
  const std::optional<double> biot = quantity(options.biot, "biot", kPlain);
  const std::optional<double> heating = quantity(options.heating, "heating", kTemperature);
  const std::optional<double> expansion = quantity(options.expansion, "expansion", kPerKelvin);
  if (storage && !(*storage > 0.0)) throw PathError(fmt::format("--storage: {:g} 1/Pa; it must be positive", *storage));
  if (biot && !(*biot > 0.0 && *biot <= 1.0)) throw PathError(fmt::format("--biot: {:g}; it lies in (0, 1]", *biot));
  if (biot && !storage) throw PathError("--biot is of water in pores; add --storage");
  if (heating.has_value() != expansion.has_value()) throw PathError("--heating and --expansion go together");
  if (heating) path.back().growth = std::log1p(*heating * *expansion);
  PathDriver driver(read_driven_material(options));
  const bool wet = storage.has_value();
  out << header(wet) << row(driver, wet);
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (wet && i + 1 == path.size()) driver.close_pores(biot.value_or(1.0), 1.0 / *storage);
    driver.run(path[i], [&] { out << row(driver, wet); });
  }
}

}  // namespace mpm
