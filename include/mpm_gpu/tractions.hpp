// Tractions on faces of particles' boxes, as mpm/mechanics/face_tractions.hpp has them, part of the loads on nodes
// (loads.hpp). Boxes of uGIMP keep their size and do not turn: the area of a face is one number, and at all nodes
// around its corners there is mass. Tractions that follow a face or are functions of place do not act here, nor with
// other shape functions.
#pragma once

#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/mechanics/face_tractions.hpp"
#include "mpm_gpu/passes.hpp"

namespace mpm_gpu {

template <class T>
class Tractions {
 public:
  static constexpr std::size_t kMost = 32;

  /// `stage`: that of the simulation, whose terms these are and with which is booked; it outlives this. `across`: the
  /// extent beyond the grid's axes, as SimulationDefinition has it. @throws GpuError for more terms than kMost
  Tractions(mpm::FaceTractions& stage, const std::vector<mpm::ParticleSet>& sets, const mpm::GridLayout& layout,
            double across, const Passes<T>& passes);

  /// Finds the tractions of a step. @throws mpm::LoadError
  void begin_step(double start, double dt);
  /// Adds their forces at the nodes to NodeView::load, or sets it to them.
  void act(Executor& run, const Step<T>& step, bool adds);
  /// Books what they have given since the last call, and this work [J].
  void tell_modules(double work);
  std::size_t bytes() const { return acts_.bytes() + face_.bytes() + force_.bytes(); }

 private:
  mpm::FaceTractions& stage_;
  mpm::GridLayout layout_;
  const Passes<T>& passes_;
  std::vector<double> areas_;   ///< area of the face of each particle, by term [m^2]
  std::vector<double> counts_;  ///< number of particles awake, by term
  std::vector<std::string> titles_;
  std::vector<double> now_, next_;  ///< force on the face of a particle, [term][axis] [N]
  mpm::ImpulseAccount given_;
  Buffer<std::uint32_t> acts_;
  Buffer<int> face_;
  Buffer<double> force_;
};

}  // namespace mpm_gpu
