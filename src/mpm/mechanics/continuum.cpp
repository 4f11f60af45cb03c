#include "mpm/mechanics/continuum.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "field_passes.hpp"
#include "increments.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/step/device.hpp"

namespace mpm {
namespace {

/// T is the precision of the particles.
template <class T>
class Continuum final : public Mechanics {
  using Kernels = mpm_kernel::KernelTable<T>;
  using Field = FieldAtWork<T>;
  using Block = mpm_kernel::BlockView;

 public:
  Continuum(Kernels kernels, Fields& fields, std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
            const ContinuumSettings& settings)
      : kernels_(kernels),
        layout_(fields.front()->layout),
        sets_(sets),
        laws_(laws),
        settings_(settings),
        motion_(settings.transfer.kind == TransferKind::apic   ? mpm_kernel::kAffine
                : settings.transfer.kind == TransferKind::flip ? mpm_kernel::kIncrement
                                                               : mpm_kernel::kAdopt),
        passes_(fields, settings.threads, settings.choice, settings.halo),
        increments_(settings.threads) {}

  void scatter_momentum(StepContext&) override {
    failed_.reset();
    turn_ = (turn_ + 1) % settings_.transfer.every;
    if (settings_.transfer.mixes()) increments_.make_room(passes_);
    passes_.each_field([&](Field& field) { look_at(field); });
    passes_.spread(
        "particles: momentum to the grid", {&Grid::mass, &Grid::momentum}, [&](Field& field, const Block& block) {
          kernels_.scatter_momentum[motion_ == mpm_kernel::kAffine](field.view, block, field.sets(), field.count());
        });
    find_velocities();
  }

  void strain_and_force(StepContext& context, double dt) override {
    if (settings_.average_dilatation) {
      strain_by_mean(context.dt, dt);
      internal_force(context);
      return;
    }
    passes_.take_for_strain(context.dt);
    passes_.spread("particles: strain, stress and force", {&Grid::force}, [&](Field& field, const Block& block) {
      strain(field, block, {dt, settings_.gradient_terms, true});
    });
  }

  void internal_force(StepContext&) override {
    if (settings_.average_dilatation) find_means(true);
    passes_.spread("particles: force", {&Grid::force}, [&](Field& field, const Block& block) {
      const double* pressure = settings_.average_dilatation ? field.mean.data() : nullptr;
      kernels_.force(field.view, block, field.sets(), field.count(), pressure);
    });
  }

  void clear_forces(StepContext&) override {
    passes_.each_field([&](Field& field) { passes_.clear("grid: momentum", field.grid, field.grid.force); });
  }

  void update_momentum(StepContext& context) override {
    double gravity[3] = {};
    for (int k = 0; k < layout_.dim(); ++k) gravity[k] = settings_.gravity[layout_.axis(k)];
    for (Field& field : passes_.fields()) {
      passes_.each_node_range("grid: momentum", field.grid, [&](int first, int last) {
        kernels_.nodal_update(field.view, first, last, context.dt, gravity);
      });
    }
  }

  int increments() const override {
    if (settings_.transfer.mixes()) return turn_ == 0 ? settings_.transfer.mixed - 1 : 0;
    return motion_ == mpm_kernel::kAdopt ? settings_.transfer.order - 1 : 0;
  }
  void begin_increments(StepContext&) override { increments_.begin(passes_, settings_.transfer); }
  void find_increment(StepContext& context) override {
    increments_.find(passes_, kernels_);
    if (settings_.transfer.mixes()) slip_energy_ -= increments_.work(passes_, context.dt);
  }
  void add_increment(StepContext& context) override {
    increments_.add(passes_, &Grid::velocity);
    if (settings_.transfer.mixes()) increments_.add(passes_, &Grid::force, context.dt);
  }

  void move_particles(StepContext& context) override {
    move(context, false);
    end_step();
  }

  void move_and_regather(StepContext& context) override {
    move(context, true);
    find_velocities();
  }

  void strain_and_place(StepContext& context, double dt) override {
    if (settings_.average_dilatation) {
      strain_by_mean(context.dt, dt);
    } else {
      passes_.take_for_strain(context.dt);
      passes_.each_block("particles: strain, stress and place", [&](Field& field, const Block& block) {
        strain(field, block, {dt, settings_.gradient_terms, false, nullptr});
      });
    }
    for (ParticleSet& set : sets_) set.x.swap(set.next_x);
    end_step();
  }

  std::optional<ParticleRef> failed() const override { return failed_; }
  FastestParticle fastest(int set, double cell) const override {
    const mpm_kernel::SetView<T> view = view_of<T>(sets_[set], laws_[set], kernels_);
    std::vector<mpm_kernel::Fastest> of_group((sets_[set].awake() + kSurveyed - 1) / kSurveyed);
    for_particle_groups(
        "particles: wave speed", sets_[set], kSurveyed, settings_.threads,
        [&](int first, int end, int g) { of_group[g] = view.law_kernels->survey(view, first, end, cell); });
    FastestParticle found;
    for (const mpm_kernel::Fastest& one : of_group) {
      if (!(one.rate <= found.rate) && !std::isnan(found.rate)) found = {one.rate, one.particle};
    }
    return found;
  }
  std::string limit_text(const StepLimit& limit) const override {
    return fmt::format("wave speed of '{}' ({:.4g} m/s with its motion and viscosity{}) at ({:.4g}, {:.4g}, {:.4g}) m",
                       sets_[limit.part].name, limit.speed, limit.foreseen ? ", and growing" : "", limit.place.x(),
                       limit.place.y(), limit.place.z());
  }
  Mixed mixed() const override { return mixed_; }
  bool must_sort() const override { return must_sort_; }
  void blocks_renewed() override { generation_ = passes_.fields().front().grid.blocks.generation(); }
  void energies(EnergyReport& report) const override {
    // The energy that XPIC, FMPM and APIC take is not counted, nor that which a mixture gives back beyond order 2.
    if (motion_ != mpm_kernel::kIncrement || settings_.transfer.mixed > 2) report.leave_open();
    if (motion_ == mpm_kernel::kIncrement && (settings_.transfer.flip != 1.0 || settings_.damping != nullptr)) {
      report.add("transfer", NamedEnergy::Kind::dissipated, slip_energy_);
    }
    if (settings_.damping != nullptr) report.add("damping", NamedEnergy::Kind::dissipated, drag_energy_);
  }
  void count(Device& device) override { slip_energy_ += device.take_slip(); }
  void hashed(std::vector<double>& numbers) const override {
    if (settings_.transfer.every > 1) numbers.push_back(turn_);
  }
  void serialise(StateArchive& archive) override {
    archive.generation("sorts_since", generation_);
    archive.sum("parts_when_sorted", parts_when_sorted_);
    if (settings_.transfer.every > 1) archive.value("turn", turn_);
    archive.sum("slip_energy", slip_energy_);
    archive.sum("drag_energy", drag_energy_);
  }

 private:
  // Fields and particles may have been sorted or swapped since the last step.
  void look_at(Field& field) {
    const Grid& grid = field.grid;
    field.view = view_of(field.grid);
    field.views.clear();
    field.set.clear();
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      const std::uint32_t* groups = sets_[s].group_begin.data() + grid.first_owner;
      if (groups[0] == groups[grid.blocks.owners()]) continue;
      field.views.push_back(view_of<T>(sets_[s], laws_[s], kernels_, grid.first_owner));
      field.set.push_back(static_cast<int>(s));
    }
  }

  void find_velocities() {
    for (Field& field : passes_.fields()) {
      passes_.each_node_range("grid: velocity", field.grid,
                              [&](int first, int last) { kernels_.nodal_velocity(field.view, first, last); });
    }
  }

  void strain(const Field& field, const Block& block, const mpm_kernel::StrainSettings& settings) {
    const mpm_kernel::Failure failure = kernels_.strain(field.view, block, field.sets(), field.count(), settings);
    if (failure.set >= 0) note_failure({field.set[failure.set], failure.particle});
  }

  void move(StepContext& context, bool regather) {
    mpm_kernel::MoveSettings settings{context.dt, turn_ == 0 ? settings_.transfer.flip : 1.0, regather};
    settings.by_point = settings_.axis_motion == AxisMotion::point;
    settings.damped = look_at_damping(settings);
    settings.counted = motion_ == mpm_kernel::kIncrement && settings.flip != 1.0;
    const bool counts = settings.counted || settings.damped;
    std::atomic<bool> gone{false};
    std::atomic<int> groups{0}, parts{0};
    passes_.take(&Grid::velocity);
    passes_.take(&Grid::force);
    passes_.each_field([&](Field& field) {
      if (counts) field.taken.assign(field.grid.blocks.owners(), {});
      field.loose.assign(field.grid.blocks.owners(), 0);  // some owners have no particle
    });
    const auto move_block = [&](Field& field, const Block& block) {
      const mpm_kernel::Moved moved = kernels_.move[motion_](field.view, block, field.sets(), field.count(), settings);
      field.loose[block.owner] = moved.loose;
      if (moved.gone) gone.store(true, std::memory_order_relaxed);
      if (counts) field.taken[block.owner] = moved;
      groups.fetch_add(moved.groups, std::memory_order_relaxed);
      parts.fetch_add(moved.parts, std::memory_order_relaxed);
    };
    if (regather) {
      passes_.spread("particles: velocity, momentum to the grid", {&Grid::momentum}, move_block);
    } else {
      passes_.each_block("particles: velocity and place", move_block);
    }
    const std::uint64_t generation =
        passes_.fields().front().grid.blocks.generation();  // generation of all: they are rebuilt together
    if (generation_ != generation) {
      generation_ = generation;
      parts_when_sorted_ = parts;
    }
    must_sort_ = gone;
    mixed_ = {static_cast<double>(groups), static_cast<double>(parts - parts_when_sorted_)};
    if (counts) book_taken();
    if (settings.damped) close_damping(context);
  }

  // Tells the kernels the rates of this step; whether there are any in the update of the particles.
  bool look_at_damping(mpm_kernel::MoveSettings& settings) {
    const DampingControl* damping = settings_.damping;
    if (damping == nullptr) return false;
    if (turn_ == 0) settings.flip = damping->flip();
    if (!damping->in_update() && !damping->needs_energy()) return false;
    passes_.each_field([&](Field& field) {
      for (int i = 0; i < field.count(); ++i) {
        const DampingRates rates = damping->rates(field.set[i]);
        settings.grid_damping = rates.grid;
        settings.particle_damping = rates.particle;
        field.views[i].damping[0] = rates.grid_of_particle;
        field.views[i].damping[1] = rates.particle_of_particle;
      }
    });
    return true;
  }

  // Sums over blocks in their order: the same bits for any number of threads.
  void book_taken() {
    passes_.each_field([&](Field& field) {
      for (const mpm_kernel::Moved& moved : field.taken) {
        slip_energy_ += moved.slip_energy;
        drag_energy_ += moved.drag_energy;
      }
    });
  }

  void close_damping(const StepContext& context) {
    Damped sum;
    passes_.each_field([&](Field& field) {
      for (const mpm_kernel::Moved& moved : field.taken) {
        for (int k = 0; k < layout_.dim(); ++k) sum.momentum[layout_.axis(k)] += moved.drag[k];
        sum.grid_energy += moved.grid_kinetic;
        sum.particle_energy += moved.particle_kinetic;
      }
    });
    settings_.damping->end_step(context, sum);
  }

  void strain_by_mean(double step, double dt) {
    passes_.take_for_strain(step);
    find_means(false);
    passes_.each_block("particles: strain, stress and place", [&](Field& field, const Block& block) {
      strain(field, block, {dt, settings_.gradient_terms, false, field.mean.data()});
    });
  }

  // Finds the mass-weighted mean of the particles' dilatation or mean stress at the nodes of every field.
  void find_means(bool of_stress) {
    constexpr const char* kMeans = "particles: means to the grid";
    passes_.each_field([&](Field& field) {
      field.mean.resize(field.grid.blocks.size());
      passes_.clear(kMeans, field.grid, field.mean);
      each_owner(kMeans, field.grid, settings_.threads, [&](const Block& block) {
        kernels_.spread_mean[of_stress](field.view, block, field.sets(), field.count(), field.mean.data());
      });
    });
    auto& patches = passes_.patches();
    for (std::size_t f = 0; f < passes_.fields().size(); ++f) {
      Field& field = passes_.fields()[f];
      if (patches) settings_.choice->give(patches->mean, static_cast<int>(f), field.mean);
      add_of_others(settings_.halo, static_cast<int>(f), field.mean);
      for (const Grid::MeanAtRest& rests : field.grid.means_at_rest) {
        double& mean = field.mean.at(rests.node.block, 0, rests.node.node);
        const double mass = field.grid.mass.at(rests.node.block, 0, rests.node.node);
        mean = (mean + (of_stress ? rests.stress : 0.0)) * mass / (mass + rests.mass);
      }
      passes_.each_carrying(kMeans, field.grid,
                            [&](int b, int n, double inverse_mass) { field.mean.block(b)[n] *= inverse_mass; });
      if (patches) settings_.choice->take(field.mean, static_cast<int>(f), patches->mean);
    }
  }

  // Domains have grown, and particles with them moved: will the next step's tiles hold them?
  void end_step() {
    for (Field& field : passes_.fields()) field.grid.loose.swap(field.loose);  // patches are always loose
    const bool sorts = must_sort_ || (mixed_.too_much() && settings_.halo == nullptr);
    if (kernels_.outgrown == nullptr || sorts) return;
    std::atomic<bool> outgrown{false};
    passes_.each_field([&](Field& field) { look_at(field); });
    passes_.each_block("particles: reach of domains", [&](Field& field, const Block& block) {
      const bool one = kernels_.outgrown(field.view, block, field.sets(), field.count());
      if (one) outgrown.store(true, std::memory_order_relaxed);
    });
    must_sort_ = outgrown;
  }

  void note_failure(ParticleRef particle) {
    in_turn([&] {
      const auto id = [this](ParticleRef p) { return sets_[p.set].id[p.index]; };
      if (!failed_ || id(particle) < id(*failed_)) failed_ = particle;
    });
  }

  static constexpr int kSurveyed = 4096;  ///< particles that a thread surveys in one go

  Kernels kernels_;
  const GridLayout& layout_;
  std::vector<ParticleSet>& sets_;
  const std::vector<Law>& laws_;
  ContinuumSettings settings_;
  mpm_kernel::Motion motion_;
  FieldPasses<T> passes_;
  std::optional<ParticleRef> failed_;
  bool must_sort_ = false;
  Mixed mixed_;
  Increments<T> increments_;
  std::int32_t turn_ = 0;                         ///< steps since one in which the fraction of FLIP held
  double slip_energy_ = 0.0, drag_energy_ = 0.0;  ///< taken by PIC and by damping of the particles [J]
  std::uint64_t generation_ = 0;                  ///< generation of the blocks that parts_when_sorted_ was counted with
  int parts_when_sorted_ = 0;
};

}  // namespace

template <class T>
std::unique_ptr<Mechanics> make_mechanics(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                          std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                          const ContinuumSettings& settings) {
  return std::make_unique<Continuum<T>>(kernels, fields, sets, laws, settings);
}

void prepare(ParticleSet& set, ShapeKind shape, const Transfer& transfer) {
  const std::size_t dim = set.x.size(), size = set.id.size();
  const auto room = [&](std::size_t components) {
    std::vector<ParticleScalar> field;
    for (std::size_t c = 0; c < components; ++c) field.emplace_back(set.precision, size);
    return field;
  };
  set.domain = room(traits_of(shape).stored(static_cast<int>(dim)));
  if (transfer.kind == TransferKind::apic) set.affine = room(dim * dim);
}

template <class T>
Grouping kernel_grouping(const mpm_kernel::KernelTable<T>& kernels) {
  return {kernels.lanes, kernels.by_column ? Grouping::By::column : Grouping::By::node};
}

#define MPM_INSTANTIATE(T)                                                                               \
  template std::unique_ptr<Mechanics> make_mechanics(const mpm_kernel::KernelTable<T>&, Fields&,         \
                                                     std::vector<ParticleSet>&, const std::vector<Law>&, \
                                                     const ContinuumSettings&);                          \
  template Grouping kernel_grouping(const mpm_kernel::KernelTable<T>&);
MPM_INSTANTIATE(double)
MPM_INSTANTIATE(float)

}  // namespace mpm
