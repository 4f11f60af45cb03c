// Parts of a scene as factors with choices, and the scene of a row of choices: a block of 16 by 6 cells of 0.1
// m that moves, on a floor, under a tool, beside another body, with a crack, heat and so on. All materials carry waves
// of some 40 m/s, so that every row takes a few dozen steps.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "covering.hpp"

namespace mpm::pairs {

struct Factor {
  std::string name;
  std::vector<std::string> choices;  ///< the first is the plain one
};

/// Factors by number, in the order of factors().
enum Of {
  geometry,
  law,
  transport,
  crack,
  asleep,
  tool,
  averages,
  periodic,
  bodies,
  ranks,
  precision,
  shape,
  update,
  transfer,
  load,
  floor_kind,
  damping,
  leaving,
  device  ///< the last one: its pairs are covered apart
};

inline const std::vector<Factor>& factors() {
  static const std::vector<Factor> all = {
      {"geometry", {"plane_strain", "axisymmetric", "plane_stress", "solid"}},
      {"law",
       {"drucker_prager", "linear_elastic", "neo_hookean", "viscoelastic", "j2_plasticity", "johnson_cook",
        "mohr_coulomb", "mu_i", "cam_clay", "norsand", "newtonian_fluid", "ideal_gas"}},
      {"transport", {"dry", "heat", "solvent", "water", "hot_tool", "heat_and_solvent"}},
      {"crack", {"whole", "open", "glued"}},
      {"sleep", {"awake", "sleep"}},
      {"tool", {"no_tool", "points", "nodes", "free", "thin", "particles", "adhesive", "colliding"}},
      {"averages", {"as_shipped", "no_average", "stress", "dilatation"}},
      {"periodic", {"walls", "periodic"}},
      {"bodies", {"one_body", "two_bodies"}},
      {"ranks", {"one_rank", "two_ranks"}},
      {"precision", {"double", "single"}},
      {"shape", {"ugimp", "ugimp_stretch", "cpdi", "qcpdi", "bspline2", "bspline3", "dirac"}},
      {"update", {"usavg", "usf", "usl", "implicit"}},
      {"transfer", {"flip", "mixed", "xpic", "fmpm", "apic"}},
      {"load", {"no_load", "traction", "body_force", "particle_force", "condition"}},
      {"floor", {"slip", "rough", "fixed", "absorbing"}},
      {"damping", {"undamped", "grid_damping", "particle_damping"}},
      {"leaving", {"inside", "leave"}},
      {"device", {"cpu", "gpu"}},
  };
  return all;
}

/// Difference of a twin's scene, whose answer is the same.
struct Twin {
  double aside = 0.0;      ///< all that does not fill the grid lies so far along x [m]
  bool sleeps = true;      ///< false: without sleep
  bool transports = true;  ///< false: without what is transported
  bool cut = true;         ///< false: without cracks
  bool joined = false;     ///< faces of cracks move as one
  double lifted = 0.0;     ///< tools begin so far above [m]
  bool tools = true;       ///< false: without tools
};

/// Scene of a row of choices, and those of its twins.
class Block {
 public:
  explicit Block(const Row& row) : row_(row) {}

  const std::string& choice(Of factor) const { return factors()[factor].choices[row_[factor]]; }
  bool is(Of factor, const char* word) const { return choice(factor) == word; }
  bool has(Of factor) const { return row_[factor] != 0; }
  bool solid() const { return is(geometry, "solid"); }
  bool round() const { return is(geometry, "axisymmetric"); }
  bool heated() const {
    return is(transport, "heat") || is(transport, "heat_and_solvent") || is(transport, "hot_tool");
  }
  bool has_tool() const { return has(tool) || is(transport, "hot_tool"); }
  /// J is of solids.
  bool is_elastic() const {
    return is(law, "linear_elastic") || is(law, "neo_hookean") || is(law, "viscoelastic") || is(law, "j2_plasticity") ||
           is(law, "johnson_cook");
  }
  /// Choices that are not plain.
  std::string name() const {
    std::string name;
    for (std::size_t f = 0; f < row_.size(); ++f) {
      if (row_[f] != 0) name += (name.empty() ? "" : " ") + factors()[f].choices[row_[f]];
    }
    return name.empty() ? "plain" : name;
  }

  std::string text(const Twin& twin = {}) const {
    const double aside = twin.aside, fills = is_around() ? 0.0 : aside;
    std::string text = fmt::format("geometry: {}\ngrid: {{cell: 0.1, min: {}, max: {}{}}}\n", choice(geometry),
                                   at(round()       ? 0.0
                                      : is_around() ? 0.0
                                                    : -0.4,
                                      0.0, 0.0),
                                   at(is_around() ? 1.6 : 2.4, 0.3, 1.6), has(leaving) ? ", leave: {limit: 4}" : "");
    text += "time: {end: 24 ms, sync: 4 ms" + std::string(is(update, "implicit") ? "" : ", step: 0.5 ms") + "}\n" +
            method();
    text += fmt::format("materials: [{{name: m, {}{}}}]\n", material(), twin.transports ? of_transport() : "");
    text += "bodies:\n" + body("block", fills, fills + (has(bodies) ? 0.8 : 1.6), fills);
    if (has(bodies)) text += body("side", fills + 0.8, fills + 1.6, fills);
    if (has(asleep)) {
      text += fmt::format("  - {{name: idle, material: m, shape: {{box: {{min: {}, max: {}}}}}}}\n",
                          at(aside + 0.6, 0.0, 1.2), at(aside + 1.0, 0.3, 1.4));
      if (twin.sleeps) text += "sleep: {speed: 1e-6, after: 4 ms, from_start: true}\n";
    }
    return text + boundaries(aside) + contact(twin.tools) +
           (has_tool() && twin.tools ? tools(aside, twin.lifted) : "") + loads(aside) +
           (twin.transports ? quantities(twin.tools) : "") + (twin.cut ? cracks(aside, twin.joined) : "");
  }

 private:
  bool is_around() const { return has(periodic) && !round(); }
  std::string at(double x, double y, double z) const {
    return solid() ? fmt::format("[{}, {}, {}]", x, y, z) : fmt::format("[{}, {}]", x, z);
  }

  std::string method() const {
    std::string text =
        fmt::format("method: {{shape: {}, update: {}, precision: {}", choice(shape), choice(update), choice(precision));
    if (is(transfer, "mixed")) text += ", transfer: {flip: 0.6, xpic: 2, every: 5}";
    if (is(transfer, "flip") && !is(update, "implicit")) text += ", transfer: flip";
    if (is(transfer, "xpic")) text += ", transfer: {xpic: 2}";
    if (is(transfer, "fmpm")) text += ", transfer: {fmpm: 2}";
    if (is(transfer, "apic")) text += ", transfer: apic";
    if (is(averages, "no_average")) text += ", average_stress: false";
    if (is(averages, "stress")) text += ", average_stress: true";
    if (is(averages, "dilatation")) text += ", average_dilatation: true";
    if (is(damping, "grid_damping")) text += ", damping: {grid: 5}";
    if (is(damping, "particle_damping")) text += ", damping: {particle: 5}";
    return text + "}\n";
  }

  std::string material() const {
    const std::string elastic = ", young: 1 MPa, poisson: 0.3";
    const std::string& name = choice(law);
    std::string text = "density: 1000, law: " + name;
    if (name == "linear_elastic" || name == "neo_hookean") return text + elastic;
    if (name == "viscoelastic") return text + elastic + ", branch_modulus: 100 kPa, relaxation_time: 20 ms";
    if (name == "j2_plasticity") return text + elastic + ", yield_stress: 10 kPa, hardening_modulus: 10 kPa";
    if (name == "johnson_cook") {
      return text + ", shear_modulus: 0.4 MPa, C0: 30, S: 1.5, gamma0: 0.2, A: 10 kPa, heat_capacity: 10";
    }
    if (name == "drucker_prager" || name == "mohr_coulomb") {
      return text + elastic + ", friction_angle: 30 deg, cohesion: 10 kPa";
    }
    if (name == "mu_i") return text + elastic + ", mu_s: 0.4, mu_2: 0.6, grain_diameter: 1 mm";
    if (name == "cam_clay") {
      return text +
             ", lambda: 0.2, kappa: 0.05, M: 1, void_ratio: 1, shear_modulus: 0.4 MPa, preconsolidation_pressure: 50 "
             "kPa, least_pressure: 20 kPa";
    }
    if (name == "norsand") {
      return text +
             ", gamma: 0.9, lambda: 0.02, M: 1.25, N: 0.3, chi: 3.5, H: 100, shear_modulus: 1 MPa, void_ratio: 0.8, "
             "least_pressure: 2 kPa";
    }
    if (name == "newtonian_fluid") return text + ", sound_speed: 30, viscosity: 1, tension: allow";
    return "density: 1000, law: ideal_gas, pressure: 0.7 MPa, temperature: 293, ambient_pressure: 0.7 MPa";
  }
  std::string of_transport() const {
    std::string text;
    if (heated()) {
      text += ", conductivity: 1000";
      if (!is(law, "johnson_cook") && !is(law, "ideal_gas")) text += ", heat_capacity: 1000";
    }
    if (is(transport, "solvent") || is(transport, "heat_and_solvent")) text += ", saturation: 0.2, diffusivity: 1e-3";
    if (is(transport, "water")) text += ", biot: 0.8, storage: 1e-6, permeability: 1e-10, viscosity: 1e-3";
    return text;
  }

  // Motion that closes cracks, so that no contact depends on round-off.
  std::string body(const char* name, double from, double to, double aside) const {
    const std::string along = fmt::format("\"{}-0.1*(x-{})\"", round() ? "" : "0.1*sin(5*z)", aside);
    return fmt::format(
        "  - {{name: {}, material: m, shape: {{box: {{min: {}, max: {}}}}}, initial: {{velocity: [{}, "
        "{}\"-0.3*z\"]}}}}\n",
        name, at(from, 0.0, 0.0), at(to, 0.3, 0.6), along, solid() ? "0, " : "");
  }

  std::string boundaries(double aside) const {
    std::string text = "boundaries: {z";
    text += has(periodic) && round()  ? ": periodic"
            : is(floor_kind, "rough") ? "_min: {friction: 0.4}"
                                      : "_min: " + choice(floor_kind);
    if (solid()) text += ", y_min: slip, y_max: slip";
    if (is_around()) text += ", x: periodic";
    if (is(load, "condition")) {
      text += fmt::format(", conditions: [{{region: {{box: {{min: {}, max: {}}}}}, direction: x, velocity: 0}}]",
                          at(aside + 1.45, -0.01, 0.05), at(aside + 1.65, 0.31, 0.45));
    }
    return text + "}\n";
  }

  std::string contact(bool tools) const {
    std::string contact = is(tool, "nodes") ? "method: nodes" : is(tool, "adhesive") && tools ? "adhesion: 2 kPa" : "";
    if (has(bodies)) {
      contact += (contact.empty() ? "" : ", ") + std::string("pairs: [{between: [block, side], friction: 0.3}]");
    }
    return contact.empty() ? "" : "contact: {" + contact + "}\n";
  }

  std::string tools(double aside, double lifted) const {
    std::string text;
    const bool thin = is(tool, "thin"), moved = is(tool, "free") || is(tool, "colliding");
    const double half = thin ? 0.02 : round() ? 0.24 : 0.14, middle = round() ? 0.0 : aside + 0.35;
    text += "rigid_bodies:\n";
    const auto one = [&](const char* name, double x, double z, const char* velocity, const std::string& more) {
      const std::string form = round()   ? fmt::format("cylinder: {{radius: {}, height: 0.3}}", half)
                               : solid() ? fmt::format("box: {{size: [{}, 0.2, 0.3]}}", 2 * half)
                                         : fmt::format("box: {{size: [{}, 0.3]}}", 2 * half);
      text += fmt::format("  - {{name: {}, shape: {{{}}}, pose: {{position: {}}}, {}, friction: 0.3{}}}\n", name, form,
                          at(x, 0.15, z),
                          moved ? fmt::format("free: {{density: 2000, velocity: {}}}", velocity)
                                : fmt::format("motion: {{velocity: {}}}", velocity),
                          more);
    };
    const char* down = solid() ? "[0, 0, -2]" : "[0, -2]";
    one("tool", middle, 0.751 + lifted, down,
        thin                    ? ", sides: two"
        : is(tool, "particles") ? ", normals: particles, sides: one"
        : is(tool, "colliding") ? ", collide: true, sides: one"
                                : ", sides: one");
    if (is(tool, "colliding")) one("stone", middle, 1.052 + lifted, down, ", collide: true, sides: one");
    return text;
  }

  std::string loads(double aside) const {
    if (is(load, "traction")) {
      return fmt::format("loads: [{{traction: {{body: {}, edge: x_max, traction: {}}}}}]\n",
                         has(bodies) ? "side" : "block", solid() ? "[500, 0, 0]" : "[500, 0]");
    }
    if (is(load, "body_force")) {
      return fmt::format("loads: [{{body_force: {{body: block, acceleration: {}}}}}]\n",
                         solid() ? "[0, 0, -3]" : "[0, -3]");
    }
    if (is(load, "particle_force")) {
      return fmt::format(
          "loads: [{{particle_force: {{body: block, force: {}, region: {{box: {{min: {}, max: {}}}}}}}}}]\n",
          solid() ? "[0, 0, -20]" : "[0, -200]", at(aside + 0.4, 0.0, 0.2), at(aside + 0.8, 0.3, 0.4));
    }
    return "";
  }

  std::string quantities(bool tools) const {
    if (!has(transport)) return "";
    std::string text;
    if (heated()) {
      // Laws whose pressure follows from their temperature are as soft beside it as the others by less heat.
      const bool pressed = is(law, "johnson_cook") || is(law, "ideal_gas");
      text = fmt::format("temperature: {{initial: 293, compression_heat: off, sources: [{{rate: {}}}]",
                         pressed ? 2e5 : 2e8);
      if (is(transport, "hot_tool") && tools) {
        text += fmt::format(", tools: [{{body: tool, conductance: 3000, temperature: {}}}]", pressed ? 294 : 350);
      }
      text += "}";
    }
    if (is(transport, "solvent") || is(transport, "heat_and_solvent")) {
      text += (text.empty() ? "" : ", ") + std::string("concentration: {initial: \"0.2+0.1*z\"}");
    }
    if (is(transport, "water")) text = "pore_pressure: {}";
    return "transport: {" + text + "}\n";
  }

  std::string cracks(double aside, bool joined) const {
    if (!has(crack)) return "";
    return fmt::format(
        "cracks: {{contour: {{size: 2}}, list: [{{name: notch, line: {{from: [{0}, 0.57], to: [{0}, 0.337]}}, start: "
        "exterior, {1}}}]}}\n",
        aside + 0.53,
        joined              ? "end: none, faces: {law: one_field}"
        : is(crack, "open") ? is_elastic() ? "end: tip" : "end: none"
                            : "end: none, faces: {law: interface, normal: 4e7, tangential: 4e7}");
  }

  Row row_;
};

}  // namespace mpm::pairs
