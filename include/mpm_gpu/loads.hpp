// Body forces and forces on particles, as mpm/mechanics/particle_loads.hpp has them. The host reads their functions: of
// time in each step, of the place at the start once, by particle. Functions of the present place, and of time and the
// place at the start together, would have to be read for each particle in each step: they do not act here.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mpm/mechanics/particle_loads.hpp"
#include "mpm_gpu/passes.hpp"
#include "mpm_gpu/stage.hpp"
#include "mpm_gpu/totals.hpp"
#include "mpm_gpu/tractions.hpp"

namespace mpm_gpu {

template <class T>
class Loads final : public Stage<T> {
 public:
  static constexpr std::size_t kMost = 32;  ///< loads of one spread whose value is the same wherever they act

  /// `terms`, unless empty, have a stage with which impulses and work are booked, which outlives this; `book` may be
  /// null. `tractions` are part of them. @throws GpuError for more loads than kMost; mpm::LoadError for one that has no
  /// value somewhere
  Loads(const std::vector<mpm::ParticleLoadTerm>& terms, const std::vector<mpm::ParticleSet>& sets,
        const mpm::GridLayout& layout, const Passes<T>& passes, mpm::ParticleLoadStage* book,
        std::optional<Tractions<T>> tractions = {});

  void make_room(Executor& run, long nodes) override;
  void begin_step(Executor& run, Step<T>& step, double start, long sorts) override;
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override;
  void tell_modules() override;
  std::size_t bytes() const override;

 private:
  static constexpr int kSpreads = 2, kKinds = 2;
  using ByKind = std::array<mpm::Vec3, kKinds>;

  /// A load whose value is the same wherever it acts.
  struct Alike {
    mpm::ParticleLoadTerm::Kind kind;
    std::array<mpm::Function, 3> value;
    double factor;  ///< 1, or 1 over a mass
    double mass;    ///< mass of all that it acts on [kg]
    std::string title;
  };
  struct OfSpread {
    bool used = false;
    std::vector<Alike> alike;
    std::vector<double> now, next;  ///< [load][axis] [m/s^2]
    bool fixes = false;
    Buffer<std::uint32_t> acts;
    Buffer<double> value, fixed;
  };
  LoadView view_of(OfSpread& spread) const;

  mpm::GridLayout layout_;
  const Passes<T>& passes_;
  mpm::ParticleLoadStage* book_;
  long ids_ = 0;
  std::array<OfSpread, kSpreads> spreads_;
  ByKind fixed_{mpm::Vec3::Zero(), mpm::Vec3::Zero()};  ///< force of loads that do not change [N]
  std::array<mpm::ImpulseAccount, kKinds> given_;       ///< since the modules were told
  std::optional<Tractions<T>> tractions_;
  Buffer<double> load_, power_;
  Total work_;
};

}  // namespace mpm_gpu
