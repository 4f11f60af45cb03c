#include "mpm/mechanics/stress_average.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/grid/each_share.hpp"
#include "mpm/kernel/flowing.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/step/device.hpp"

namespace mpm {
namespace {

/// One set's particles as the average needs them.
template <class Geometry, class T, class LawType>
class Particles : public FlowingParticles<Geometry, T, LawType> {
  using Flowing = FlowingParticles<Geometry, T, LawType>;

 public:
  Particles(ParticleSet& set, const LawType& law, double* strain_before)
      : Flowing(arrays(set, law, strain_before)), set_(set) {}

  double mass(std::uint32_t p) const { return set_.mass_of(static_cast<int>(p)); }
  /// Scales the deformation along the grid's axes, so that the volume grows by this factor.
  void swell(std::uint32_t p, double factor) {
    this->stretch(p, Geometry::kDim == 3 ? std::cbrt(factor) : Geometry::kDim == 2 ? std::sqrt(factor) : factor);
  }
  /// Number of the cell along each axis, counted from its block's first; a particle lies at most half a cell before it.
  std::array<int, 3> cell(std::uint32_t p, const GridLayout& layout, const std::array<int, 3>& block) const {
    std::array<int, 3> cell{};
    for (int k = 0; k < Geometry::kDim; ++k) {
      // The floor, by cutting off what is positive: a call of std::floor costs more than all else here.
      const int number = static_cast<int>(layout.in_cells(k, set_.x[k][p]) - kBlockEdge * block[k] + kShift) - kShift;
      cell[k] = std::clamp(number, -1, kBlockEdge - 1);
    }
    return cell;
  }

 private:
  static constexpr int kShift = 64;  ///< cells: farther from its block no particle is

  static FlowingArrays<T> arrays(ParticleSet& set, const LawType& law, double* strain_before) {
    FlowingArrays<T> arrays{};
    for (int i = 0; i < Flowing::Stored::kCount; ++i) arrays.stress[i] = set.tau[i].template data<T>();
    for (int i = 0; i < Geometry::kMatrix; ++i) arrays.gradient[i] = set.f[i].template data<T>();
    arrays.strain = set.history[LawType::kPlasticStrain].template data<T>();
    arrays.strain_before = strain_before;
    if constexpr (!finds_pressure(LawType::kStressFrom)) {
      const double speed = law.wave_speed(Matrix3<double>::identity(), Symmetric3<double>{}, 1.0);
      arrays.least_pressure = Flowing::kPressure * speed * speed;
    }
    return arrays;
  }

  ParticleSet& set_;
};

/// Owner of the block with this key, which has one: blocks whose particles choose a field are owners in all fields that
/// they choose from (step/sorter.cpp), with or without other particles.
int owner_of(const BlockTable& blocks, std::uint64_t key) {
  int first = 0, end = blocks.owners();
  while (first < end) {
    const int middle = (first + end) / 2;
    if (blocks.key(blocks.owner_block(middle)) < key) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first;
}

/// Part of its cell that a particle is in.
int part_of(const CellParts* parts, const ParticleSet& set, const std::array<int, 3>& cell, std::uint32_t p) {
  return parts == nullptr ? 0 : parts->part_of(set, cell, {set.x[0][p], set.x[1][p]});
}

}  // namespace

StressAverage::StressAverage(std::vector<AveragedSet> sets, GeometryKind geometry, int threads, Halo* halo)
    : sets_(std::move(sets)), geometry_(geometry), threads_(threads), halo_(halo) {
  for (const AveragedSet& one : sets_) places_.push_back(one.set->bring(kStrainBefore, "1"));
}

template <class Visit>
void StressAverage::each_set(Visit&& visit) {
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    double* before = sets_[s].set->brought[places_[s]].values.data();
    std::visit(
        [&](const auto& law) {
          if constexpr (std::decay_t<decltype(law)>::kAveragesStress) {
            if (sets_[s].set->precision == Precision::float64) {
              visit(s, before, double(), law);
            } else {
              visit(s, before, float(), law);
            }
          }
        },
        *sets_[s].law);
  }
}

void StressAverage::divide(const NodeChoice& choice, std::unique_ptr<CellParts> parts) {
  choice_ = &choice;
  most_parts_ = parts->most();
  parts_ = std::move(parts);
}

// A block's particles are in its own cells, and in the last ones of the blocks before it.
void StressAverage::find_cells(const Grid& grid, int field, Cells& cells) const {
  if (cells.generation == grid.blocks.generation()) return;
  cells.generation = grid.blocks.generation();
  const int dim = grid.layout.dim(), blocks = grid.blocks.size();
  cells.of_set_block.assign(sets_.size() * blocks, -1);
  int used = 0;
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const ParticleSet& set = *sets_[s].set;
    const std::uint32_t* begin = &set.begin[grid.first_owner];
    const auto add = [&](int owner) {
      for (int before = 0; before < 1 << dim; ++before) {
        int neighbour = 0;
        for (int k = 0; k < dim; ++k) neighbour = 3 * neighbour + 1 - (before >> k & 1);
        int& place = cells.of_set_block[s * blocks + grid.blocks.neighbours(owner)[neighbour]];
        if (place < 0) place = grid.layout.nodes_per_block() * used++;
      }
    };
    for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
      if (begin[owner] != begin[owner + 1]) add(owner);
    }
    if (choice_ == nullptr || !set.chooses || set.field != field) continue;
    for (const std::uint64_t key : choice_->blocks()) add(owner_of(grid.blocks, key));
  }
  const std::size_t needed = static_cast<std::size_t>(most_parts_) * grid.layout.nodes_per_block() * used;
  if (cells.all.size() < needed) cells.all.resize(needed);
}

StressAverage::Cell& StressAverage::cell_at(const Grid& grid, int owner, const std::array<int, 3>& cell, int part,
                                            const int* of_block, Cells& cells) const {
  int neighbour = 0, local = 0;
  for (int k = 0; k < grid.layout.dim(); ++k) {
    neighbour = 3 * neighbour + (cell[k] < 0 ? 0 : 1);
    local = kBlockEdge * local + (cell[k] < 0 ? kBlockEdge - 1 : cell[k]);
  }
  return cells.all[most_parts_ * (of_block[grid.blocks.neighbours(owner)[neighbour]] + local) + part];
}

template <class Visit>
void StressAverage::each_patch(const Grid& grid, int field, std::size_t s, Visit&& visit) const {
  const ParticleSet& set = *sets_[s].set;
  if (choice_ == nullptr || !set.chooses || set.field != field) return;
  const Grid& patches = choice_->grid();
  const std::uint32_t* begin = &set.begin[patches.first_owner];
  int owner = -1;
  for (int patch = 0; patch < choice_->patches(); ++patch) {
    const std::uint64_t key = patches.blocks.key(patches.blocks.owner_block(patch));
    if (owner < 0 || key != grid.blocks.key(grid.blocks.owner_block(owner))) {
      owner = owner_of(grid.blocks, key);
      parts_->look_at(grid.blocks.block(grid.blocks.owner_block(owner)));
    }
    if (begin[patch] != begin[patch + 1]) visit(Place{s, begin[patch], begin[patch + 1], owner, parts_.get()});
  }
}

template <class Geometry, class T, class LawType>
void StressAverage::gather(const Place& place, const LawType& law, double* before, const Grid& grid, Cells& cells) {
  const AveragedSet& one = sets_[place.set];
  const Particles<Geometry, T, LawType> particles(*one.set, law, before);
  const int* of_block = &cells.of_set_block[place.set * grid.blocks.size()];
  const std::array<int, 3>& origin = grid.blocks.block(grid.blocks.owner_block(place.owner));
  for (std::uint32_t p = place.first; p < place.end; ++p) {
    if (!particles.flows(p)) continue;
    const std::array<int, 3> at = particles.cell(p, grid.layout, origin);
    Cell& cell = cell_at(grid, place.owner, at, part_of(place.parts, *one.set, at, p), of_block, cells);
    if (cell.step != step_) {
      cell = {};
      cell.step = step_;
    }
    const double mass = particles.mass(p);
    double stress[StoredStress<Geometry>::kCount];
    particles.stress(p, stress);
    cell.mass += mass;
    cell.volume += mass * particles.volume_ratio(p);
    for (int i = 0; i < StoredStress<Geometry>::kCount; ++i) cell.stress[i] += mass * stress[i];
    ++cell.particles;
  }
}

template <class Geometry, class T, class LawType>
double StressAverage::share(const Place& place, const LawType& law, double* before, const Grid& grid, Cells& cells) {
  using Stored = StoredStress<Geometry>;
  const AveragedSet& one = sets_[place.set];
  Particles<Geometry, T, LawType> particles(*one.set, law, before);
  const int* of_block = &cells.of_set_block[place.set * grid.blocks.size()];
  const std::array<int, 3>& origin = grid.blocks.block(grid.blocks.owner_block(place.owner));
  double lost = 0.0;
  for (std::uint32_t p = place.first; p < place.end; ++p) {
    const bool flows = particles.flows(p);
    particles.remember(p);
    if (!flows) continue;
    const std::array<int, 3> at = particles.cell(p, grid.layout, origin);
    const Cell& cell = cell_at(grid, place.owner, at, part_of(place.parts, *one.set, at, p), of_block, cells);
    if (cell.particles < 2) continue;
    const double inverse_mass = 1.0 / cell.mass;
    double mean[Stored::kCount], own[Stored::kCount];
    particles.stress(p, own);
    for (int i = 0; i < Stored::kCount; ++i) mean[i] = cell.stress[i] * inverse_mass;
    const double ratio = particles.volume_ratio(p), mean_ratio = cell.volume * inverse_mass;
    const auto energy = [&](const double* s, double j) {
      return law.elastic_energy(Geometry::dilatation(1.0), Stored::symmetric(s), j);
    };
    lost += particles.mass(p) * (energy(own, ratio) - energy(mean, mean_ratio));
    particles.set_stress(p, mean);
    particles.swell(p, mean_ratio / ratio);
  }
  return lost;
}

bool StressAverage::divides(int field) const {
  return std::any_of(sets_.begin(), sets_.end(),
                     [&](const AveragedSet& one) { return one.set->chooses && one.set->field == field; });
}

// Sums of one part of each cell over all ranks, where several have particles in it.
void StressAverage::exchange(const Grid& grid, int field, int part, Cells& cells) {
  constexpr int kMass = 0, kVolume = 1, kParticles = 2, kStress = 3;
  const int nodes = grid.layout.nodes_per_block(), blocks = grid.blocks.size();
  if (!sums_) sums_.emplace(kStress + static_cast<int>(Cell().stress.size()), nodes);
  NodalField& sums = *sums_;
  sums.resize(blocks);
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const ParticleSet& set = *sets_[s].set;
    if (set.field != field && set.far_field != field) continue;
    const int* of_block = &cells.of_set_block[s * blocks];
    std::fill_n(sums.data(), sums.size(), 0.0);
    const auto each_cell = [&](auto&& visit) {
      for (int b = 0; b < blocks; ++b) {
        for (int n = 0; n < nodes && of_block[b] >= 0; ++n) {
          visit(cells.all[most_parts_ * (of_block[b] + n) + part], b, n);
        }
      }
    };
    each_cell([&](const Cell& cell, int b, int n) {
      if (cell.step != step_) return;
      sums.at(b, kMass, n) = cell.mass;
      sums.at(b, kVolume, n) = cell.volume;
      sums.at(b, kParticles, n) = cell.particles;
      for (std::size_t i = 0; i < cell.stress.size(); ++i)
        sums.at(b, kStress + static_cast<int>(i), n) = cell.stress[i];
    });
    halo_->add(field, sums);
    each_cell([&](Cell& cell, int b, int n) {
      if (sums.at(b, kParticles, n) == 0.0) return;
      cell.step = step_;
      cell.mass = sums.at(b, kMass, n);
      cell.volume = sums.at(b, kVolume, n);
      cell.particles = static_cast<std::uint32_t>(sums.at(b, kParticles, n));
      for (std::size_t i = 0; i < cell.stress.size(); ++i)
        cell.stress[i] = sums.at(b, kStress + static_cast<int>(i), n);
    });
  }
}

template <class Geometry>
void StressAverage::average(const Grid& grid, int field, Cells& cells) {
  find_cells(grid, field, cells);
  of_owner_.assign(grid.blocks.owners(), 0.0);
  const auto of_block = [&](std::size_t s, int owner) {
    const std::uint32_t* begin = &sets_[s].set->begin[grid.first_owner + owner];
    return Place{s, begin[0], begin[1], owner, nullptr};
  };
  // A block adds to its own cells and to the last ones of those before it, so blocks of one colour share no cell.
  grid.shares.by_colour("particles: stress to cells", threads_, [&](int owner) {
    each_set([&](std::size_t s, double* before, auto scalar, const auto& law) {
      gather<Geometry, decltype(scalar)>(of_block(s, owner), law, before, grid, cells);
    });
  });
  each_set([&](std::size_t s, double* before, auto scalar, const auto& law) {
    each_patch(grid, field, s,
               [&](const Place& at) { gather<Geometry, decltype(scalar)>(at, law, before, grid, cells); });
  });
  const int parts = divides(field) ? most_parts_ : 1;
  for (int part = 0; part < parts && halo_ != nullptr; ++part) exchange(grid, field, part, cells);
  grid.shares.at_once("cells: stress to particles", threads_, [&](int owner) {
    each_set([&](std::size_t s, double* before, auto scalar, const auto& law) {
      of_owner_[owner] += share<Geometry, decltype(scalar)>(of_block(s, owner), law, before, grid, cells);
    });
  });
  for (const double lost : of_owner_) taken_ += lost;
  each_set([&](std::size_t s, double* before, auto scalar, const auto& law) {
    each_patch(grid, field, s,
               [&](const Place& at) { taken_ += share<Geometry, decltype(scalar)>(at, law, before, grid, cells); });
  });
}

void StressAverage::momentum_gathered(StepContext& context) {
  ++step_;
  cells_.resize(context.fields.size());
  with_geometry(geometry_, [&](auto kind) {
    using Geometry = decltype(kind);
    for (std::size_t f = 0; begun_ != 0 && f < context.fields.size(); ++f) {
      average<Geometry>(*context.fields[f], static_cast<int>(f), cells_[f]);
    }
  });
  begin();
}

// As ground has that was settled: the plastic strains of the start are not of this run.
void StressAverage::begin() {
  if (begun_ != 0) return;
  begun_ = 1;
  with_geometry(geometry_, [&](auto kind) {
    each_set([&](std::size_t s, double* before, auto scalar, const auto& law) {
      Particles<decltype(kind), decltype(scalar), std::decay_t<decltype(law)>> particles(*sets_[s].set, law, before);
      for (int p = 0; p < sets_[s].set->size(); ++p) particles.remember(p);
    });
  });
}

void StressAverage::count(Device& device) { taken_ += device.take_averaged(); }

void StressAverage::energies(EnergyReport& report) const {
  report.add("stress averaging", NamedEnergy::Kind::dissipated, taken_);
}

}  // namespace mpm
