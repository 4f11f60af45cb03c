// The border to the code of one lane: tables of passes, each a function that runs a kernel over all particles or nodes.
// Behind it everything is compiled with MPM_ONE_LANE and the namespace mpm under another name (kernel/lane.hpp), as the
// solver's kernels are once an instruction set; here are plain data and functions of the host.
#pragma once

#include <cstddef>

#include "mpm/kernel/kernels.hpp"
#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/taken.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

enum class Shape : int { ugimp, ugimp_stretch, bspline2, bspline3 };
enum class Update : int { usf, usl, usavg, implicit };

/// The passes of a step, which Solver puts in their order.
template <class T>
struct Passes {
  using Pass = void (*)(Executor&, const Step<T>&);
  Pass domains;             ///< stretch of boxes for this step; null of a shape function that does not stretch
  Pass momentum[2];         ///< m, m v and v on nodes, v as walls let it be for the strain; with APIC's affine field
  Pass gradient;            ///< grad v of particles
  Pass first_increment[2];  ///< velocity that XPIC and FMPM pass to and fro; where FLIP is mixed with it
  Pass to_particles;        ///< increment at particles, in the place of gradients
  Pass increment[2];  ///< the next one at nodes, from those, and the velocity with it; where FLIP is mixed with it
  Pass force[2];      ///< a, and v of the step's end, by force, gravity and walls; and by what else drives nodes
  /// v and next x of particles; what has left its cell or the domain. By motion and Counting.
  Pass move[mpm_kernel::kMotions][3];

  // Loads on particles: acceleration of these, in the place of gradients; their force at the nodes, by LoadSpread,
  // added to what is there or not; that of tractions; power of both at each node.
  void (*load_of_particles)(Executor&, const Step<T>&, const LoadView&);
  void (*load[2])(Executor&, const Step<T>&, bool adds);
  void (*traction)(Executor&, const Step<T>&, const TractionView&, bool adds);
  void (*load_power)(Executor&, const Step<T>&, double* power);
  /// Holds nodes at prescribed velocities.
  void (*hold)(Executor&, const Step<T>&, const HeldView&, HeldPart);
  /// Puts particles outside the grid back (leaving_passes.hpp).
  void (*put_back)(Executor&, const Step<T>&, double* numbers);

  // Volume of liquids (liquid_passes.hpp): volumes over mass of the particles of one set, that of `start` or times J;
  // fullness of nodes from those; what the particles of one set see of it, in the place of gradients.
  void (*volumes)(Executor&, const Step<T>&, int set, double start, bool stays, double* volume);
  void (*fullness)(Executor&, const Step<T>&, const double* volume, double cell, double* fullness);
  void (*fullness_to_particles)(Executor&, const Step<T>&, int set, const double* fullness);
};

// The same for any shape function and precision (prescribed_passes.hpp, leaving_passes.hpp).
void find_held_work(Executor& run, const HeldView& held, double* work);
void find_held_shares(Executor& run, const HeldView& held, const std::uint32_t* entry, const double* factor,
                      double* share, long count);
void copy_faults(Executor& run, const std::uint8_t* fault, const std::uint32_t* id, long count, std::uint8_t* fault_to,
                 std::uint32_t* id_to);
void copy_keys(Executor& run, const NodeView& nodes, std::uint64_t* to);

/// Strain and stress of the particles of one set, by its law.
template <class T>
using LawPass = void (*)(Executor&, const Step<T>&, int set, const void* law);
/// Mean stresses of the cells of one set (mechanics/stress_average.hpp).
template <class T>
using AveragePass = void (*)(Executor&, const Step<T>&, int set, const void* law);
/// Rate at which each particle of one set crosses cells of this edge [m], at its number [1/s] (kernel/survey.hpp).
template <class T>
using RatePass = void (*)(Executor&, const Step<T>&, int set, const void* law, double cell, double* rates);

/// Sums over the particles of one set; where all have the same mass, as if it were 1.
template <class T>
using TotalsPass = Totals (*)(Executor&, const Step<T>&, int set, const void* law, Buffer<Totals>& room);

/// Relaxes J of the particles of one liquid over the time `waited` [s]; `law` is on the host. `lost`: energy that each
/// particle loses, at its number [J].
template <class T>
using RelaxPass = void (*)(Executor&, const Step<T>&, int set, const void* law, double waited, double* lost);

/// In three dimensions or, with two axes, plane strain. The last argument tells the precision.
const Passes<double>& passes(int dim, Shape shape, double);
const Passes<float>& passes(int dim, Shape shape, float);
/// By the index of the law in the list of laws (material/law.hpp); null for one that cannot run there.
LawPass<double> law_pass(int dim, std::size_t law, double);
LawPass<float> law_pass(int dim, std::size_t law, float);
/// Null for a law whose stress is not averaged.
AveragePass<double> average_pass(int dim, std::size_t law, double);
AveragePass<float> average_pass(int dim, std::size_t law, float);
RatePass<double> rate_pass(int dim, std::size_t law, double);
RatePass<float> rate_pass(int dim, std::size_t law, float);
TotalsPass<double> totals_pass(int dim, std::size_t law, double);
TotalsPass<float> totals_pass(int dim, std::size_t law, float);
/// Null for a law that is no liquid's.
RelaxPass<double> relax_pass(int dim, std::size_t law, double);
RelaxPass<float> relax_pass(int dim, std::size_t law, float);

}  // namespace mpm_gpu
