// Loads on particles: a body force, an acceleration b(t, x, X) of the material; and forces F(t, x, X) on particles. t
// is time, x the place where the material is, X the place where it was at the start. A particle pass of its own beside
// the kernel: f_i += sum of (m_p b_p + F_p) S_ip.
//
// When and where they are read: at the middle of the step, t + dt/2, and at the place where a particle will be then,
// x + v dt/2 with the velocity of the step's start. With it v^{n+1} - v^n = b dt is the midpoint rule. USAVG's
// internal force is the stress after half of the step's strain, so it belongs to the middle as well: read at the
// step's start, b alone would make the step first order (its error is dt/2 (db/dt + v . grad b) a unit of time). USF's
// force stays first order, and the impulse of the load is the midpoint rule's all the same.
//
// A load is spread by the particle's domain, with the S_ip that carries its mass, or put at its centre, with the hat
// function N_i(x_p) there. Spread, a particle feels what it would carry itself; at the centre a concentrated force
// stays in the cell of its particle, and jumps from cell to cell with it (weak: the gradient of N_i does; and where a
// centre is pressed beyond a wall and splines keep to the nodes inside, what it gives to the node beyond is lost, which
// the audit shows). Source: GIMP
// notes (1.6), (1.12), (1.18)-(1.22), (1.27), (1.31); the midpoint is ours.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/math/function.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/rest_partner.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// Function that spreads a load over the nodes: S_ip of the scene's shape function, or N_i(x_p).
enum class LoadSpread { domain, center };

/// In the order of LoadSpread, as a scene says it.
inline constexpr std::array<const char*, 2> kSpreadNames = {"domain", "center"};

/// One load: an acceleration [m/s^2], or a force on a particle [N], by world axis.
struct ParticleLoadTerm {
  enum class Kind { body_force, particle_force };
  Kind kind = Kind::body_force;
  std::optional<int> set;  ///< set of particles, by index; all without one
  std::array<Function, 3> value;
  double factor = 1.0;  ///< factor of the value; 1 over the mass of all for a force shared by mass [1/kg]
  bool each = false;    ///< a force on each particle, which its own mass divides
  LoadSpread spread = LoadSpread::domain;
  /// Marks of whether it acts on a particle of the set, by id from the set's first; on all when empty.
  std::vector<std::uint8_t> chosen;
};

/// A load that has no value somewhere. what() names the load, the place and the time.
class LoadError : public ModuleError {
 public:
  using ModuleError::ModuleError;
};

/// Transfers that bring a load to the nodes, by its spread: in the scene's shape function, and in dirac, whose hat
/// functions are at the centre.
struct LoadTransfers {
  std::unique_ptr<ScalarTransfer> domain, center;
};

class ParticleLoadStage : public Stage, public RestPartner {
 public:
  /// Books what loads have given where a device takes the steps (step/device.hpp): momentum [N s], work [J].
  virtual void count(ParticleLoadTerm::Kind kind, const ImpulseAccount& given) = 0;
  virtual void count_work(double work) = 0;
};

/// All loads of a scene on particles, as one stage. Its work is nodal load times the displacement of its node in a
/// step, with the velocity that conditions have left, over the displacement of FLIP (GIMP notes (2.16)); where
/// particles move otherwise (PIC, XPIC, FMPM, APIC) it is right to first order in dt. Audit: "body_force" and
/// "particle_force", those that there are: the sums over particles awake of m b dt and of F dt; the grid has no part in
/// them. What sleeps bears the load with which it fell asleep, and wakes when it changes.
/// `gravity`: its size [m/s^2]. `transfers`: of these fields and sets, which outlive the result; sets that a term with
/// X, Y or Z acts on have their start_x.
std::unique_ptr<ParticleLoadStage> make_particle_loads(LoadTransfers transfers, Fields& fields,
                                                       std::vector<ParticleSet>& sets,
                                                       const std::vector<ParticleLoadTerm>& terms, int threads,
                                                       double gravity = 0.0);

}  // namespace mpm
