// Definition of transport in a scene: which quantities particles carry beside their motion, the materials' constants,
// and what holds, feeds and drains the quantities. All obey one equation (GIMP notes, chapter 6),
//
//   C dT/dt = -div q + s,   q = -K grad T,
//
// in which T is a temperature, a potential of diffusion, or the pressure of water in pores.
#pragma once

#include <array>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/function.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/math/tensor.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

enum class Transported { temperature, concentration, pore_pressure };

/// Facts about a quantity, by which others name and treat it.
struct TransportedTraits {
  const char* name;
  const char* unit;
  const char* content_unit;  ///< unit of heat, of solute over its saturation, of water
  bool absolute;             ///< has no value below zero
  bool by_mass;              ///< its capacity is that of a mass, else that of a volume
};
/// In the order of Transported.
inline constexpr TransportedTraits kTransported[] = {{"temperature", "K", "J", true, true},
                                                     {"concentration", "1", "m^3", false, false},
                                                     {"pore_pressure", "Pa", "m^3", false, false}};
inline constexpr int kQuantities = std::size(kTransported);
constexpr const TransportedTraits& traits_of(Transported quantity) { return kTransported[static_cast<int>(quantity)]; }

/// A constant of a material, or a number that follows the quantity along straight lines between given points and stays
/// what it is beyond them.
class Property {
 public:
  Property() = default;
  Property(double constant) : constant_(constant) {}  // NOLINT: implicit, so that a number can stand for a property
  /// `points`: quantity and number, the quantity ascending; at least one.
  explicit Property(std::vector<std::array<double, 2>> points) : points_(std::move(points)) {}

  double operator()(double quantity) const { return points_.empty() ? constant_ : between(quantity); }
  bool is_constant() const { return points_.empty(); }
  double least() const;
  double most() const;

 private:
  double between(double quantity) const;
  double constant_ = 0.0;
  std::vector<std::array<double, 2>> points_;
};

/// A material's constants for one quantity.
struct TransportMaterial {
  /// Heat capacity [J/(kg K)]; saturation [1]; storage 1/Q, the water that a pressure brings into a volume [1/Pa].
  Property capacity;
  /// Conductivity [W/(m K)]; saturation times diffusivity [m^2/s]; permeability over viscosity [m^2/(Pa s)].
  Property conductivity;
  /// Over the conductivity, of each direction, where it is not the same in all.
  std::optional<Symmetric3<double>> anisotropy;
  /// Linear strain that brings no stress, of a change by one [1/K], [1].
  double expansion = 0.0;

  // Constants of heat.
  double heat_fraction = 0.9;  ///< part of the plastic work that becomes heat (Taylor and Quinney)
  // Constants of water in pores.
  Symmetric3<double> biot{};   ///< part of the pressure that the skeleton feels, 1 at most
  double fluid_density = 0.0;  ///< density of the water that gravity drives [kg/m^3]
};

/// Values that nodes in a region have.
struct ValueDefinition {
  std::string name;
  RigidBodyDefinition region;  ///< its surface and pose; nodes on it belong to it
  Function value;
  std::string where;  ///< "file:line: key.path", for errors; may be empty
};

/// Flux into a body through a face of some of its particles' domains.
struct FluxDefinition {
  enum class Kind {
    given,       ///< `value` a unit of area
    convection,  ///< coefficient (ambient - T)
    radiation    ///< emissivity sigma (ambient^4 - T^4)
  };
  std::string name;
  std::string body;
  int face = 0;                          ///< in the order of kWallNames
  std::vector<std::uint32_t> particles;  ///< as in TractionDefinition
  Kind kind = Kind::given;
  Function value;  ///< flux [content/(m^2 s)], or the quantity of the surroundings
  double coefficient = 0.0;
};

/// Content that a volume of a body gains, and a quantity that a body is taken through.
struct SourceDefinition {
  std::string body;  ///< all when empty
  bool ramp = false;
  Function value;  ///< [content/(m^3 s)]; of a ramp the quantity itself, whose changes all particles follow
};

/// Way in which a change of the nodes becomes one of particles: GIMP notes (6.22), by the content that a node can take,
/// or (6.24), by the volume at the node and the particle's own capacity.
enum class RateMethod { nodal_capacity, particle_capacity };

/// A rigid body that exchanges heat with what it touches.
struct ToolHeatDefinition {
  std::string body;
  double conductance = 0.0;    ///< conductance of the contact [W/(m^2 K)]
  Function temperature;        ///< [K]; with a capacity the one at the start
  double capacity = 0.0;       ///< capacity of the whole body [J/K]; 0: the temperature is given
  double friction_part = 1.0;  ///< part of the heat of friction that goes to the material
};
/// Two bodies of different velocity fields that conduct where they touch; a body twice: the faces of its cracks.
struct PairHeatDefinition {
  std::string first, second;
  double conductance = 0.0;  ///< [W/(m^2 K)]
};

inline constexpr double kStefanBoltzmann = 5.670374419e-8;  ///< [W/(m^2 K^4)]

struct QuantityDefinition {
  Transported quantity = Transported::temperature;
  RateMethod method = RateMethod::nodal_capacity;
  int order = 2;  ///< order of nodal_capacity: 1 is (6.22) as it stands, 2 adds once what is lost on the way
  std::vector<TransportMaterial> materials;               ///< in the order of SimulationDefinition::materials
  std::vector<std::pair<std::string, Function>> initial;  ///< by body; an empty name: those that no other names
  double reference = 0.0;                                 ///< at which nothing is strained by it
  std::vector<ValueDefinition> values;
  std::vector<FluxDefinition> fluxes;
  std::vector<SourceDefinition> sources;

  // Settings of heat.
  bool compression_heat = true;  ///< a change of volume heats what expands with heat
  std::vector<ToolHeatDefinition> tools;
  std::vector<PairHeatDefinition> pairs;
};

/// Least capacity of a volume [J/(m^3 K)], [1], [1/Pa]. `density` [kg/m^3]: of the material at the start.
double least_capacity(const TransportMaterial& material, Transported quantity, double density);
/// Largest conductivity over that [m^2/s], along the direction that conducts best.
double largest_diffusivity(const TransportMaterial& material, Transported quantity, double density);
/// Longest update that one stage can take, Dx^2 C / (4 K) [s]; infinite where nothing conducts.
double stable_step(double cell, double diffusivity);
/// Largest change of a flux with the quantity of the surface, up to `most` of it [content/(m^2 s quantity)].
double surface_conductance(const FluxDefinition& flux, double most);
/// Longest update with such a surface, which is read once in it: it must not overshoot [s].
double longest_update(double cell, double least_capacity, double conductance);

/// Initial value of a body at a place at the start. @throws FunctionError
double initial_value(const QuantityDefinition& quantity, const std::string& body, const Vec3& place);

struct TransportDefinition {
  std::vector<QuantityDefinition> quantities;
  /// Null if the scene does not have it.
  const QuantityDefinition* find(Transported quantity) const;
};

}  // namespace mpm
