#include "mpm/mechanics/pressure_average.hpp"

#include <algorithm>

#include "mpm/math/dimension.hpp"

namespace mpm {
namespace {

// Of every law of soil; simulation/pressure_average_module.cpp checks it.
constexpr int kPlasticStrain = 0;

/// Where the trace of a stress lies among its stored components.
template <class Geometry>
constexpr std::array<int, 3> trace_of() {
  if constexpr (Geometry::kDim == 3) return {0, 1, 2};
  if constexpr (Geometry::kDim != 3) return {0, 1, 3};
}

/// What the flowing particles of a cell have together.
struct CellSum {
  double mass = 0.0, tension = 0.0;
  int particles = 0;
};

}  // namespace

PressureAverage::PressureAverage(std::vector<AveragedSet> sets, GeometryKind geometry, int threads)
    : sets_(std::move(sets)), geometry_(geometry), threads_(threads) {
  for (const AveragedSet& one : sets_) places_.push_back(one.set->bring("plastic_strain_before", "1"));
}

template <class Geometry, class T>
double PressureAverage::average_block(const AveragedSet& one, double* before, std::uint32_t begin, std::uint32_t end,
                                      const GridLayout& layout, const std::array<int, 3>& block) {
  constexpr std::array<int, 3> kTrace = trace_of<Geometry>();
  ParticleSet& set = *one.set;
  const T* strain = set.history[kPlasticStrain].template data<T>();
  T* stress[3];
  for (int k = 0; k < 3; ++k) stress[k] = set.tau[kTrace[k]].template data<T>();
  const auto tension = [&](std::uint32_t p) {
    return (static_cast<double>(stress[0][p]) + stress[1][p] + stress[2][p]) / 3.0;
  };
  const auto flows = [&](std::uint32_t p) { return strain[p] > before[p] && tension(p) < 0.0; };
  const auto cell_of = [&](std::uint32_t p) {
    int cell = 0;
    for (int k = 0; k < Geometry::kDim; ++k) {
      const int node = GridLayout::nearest(layout.in_cells(k, set.x[k][p])) - kBlockEdge * block[k];
      cell = cell * kBlockEdge + std::clamp(node, 0, kBlockEdge - 1);
    }
    return cell;
  };
  CellSum cells[nodes_of_block(Geometry::kDim)];
  bool any = false;
  for (std::uint32_t p = begin; p < end; ++p) {
    if (!flows(p)) continue;
    CellSum& cell = cells[cell_of(p)];
    const double mass = set.mass_of(static_cast<int>(p));
    cell.mass += mass;
    cell.tension += mass * tension(p);
    ++cell.particles;
    any = any || cell.particles > 1;
  }
  double lost = 0.0;
  if (any) {
    for (std::uint32_t p = begin; p < end; ++p) {
      if (!flows(p)) continue;
      const CellSum& cell = cells[cell_of(p)];
      if (cell.particles < 2) continue;
      const double old = tension(p), mean = cell.tension / cell.mass;
      for (T* component : stress) component[p] += static_cast<T>(mean - old);
      // p^2 / 2K of Cauchy pressure on the present volume.
      const double j = determinant(Geometry::load_matrix(set.f, static_cast<int>(p)));
      lost += set.mass_of(static_cast<int>(p)) * (old * old - mean * mean) * one.density / (2.0 * one.bulk * j);
    }
  }
  for (std::uint32_t p = begin; p < end; ++p) before[p] = strain[p];
  return lost;
}

template <class Geometry, class T>
void PressureAverage::average(const AveragedSet& one, std::size_t place, const StepContext& context) {
  const GridLayout& layout = context.layout();
  double* before = one.set->brought[place].values.data();
  for (const auto& grid : context.fields) {
    const BlockTable& blocks = grid->blocks;
    const int owners = blocks.owners(), first = grid->first_owner;
    of_owner_.resize(owners);
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (int owner = 0; owner < owners; ++owner) {
      of_owner_[owner] =
          average_block<Geometry, T>(one, before, one.set->begin[first + owner], one.set->begin[first + owner + 1],
                                     layout, blocks.block(blocks.owner_block(owner)));
    }
    for (const double lost : of_owner_) taken_ += lost;
  }
}

void PressureAverage::momentum_gathered(StepContext& context) {
  with_geometry(geometry_, [&](auto kind) {
    using Geometry = decltype(kind);
    for (std::size_t s = 0; s < sets_.size(); ++s) {
      if (sets_[s].set->precision == Precision::float64) {
        average<Geometry, double>(sets_[s], places_[s], context);
      } else {
        average<Geometry, float>(sets_[s], places_[s], context);
      }
    }
  });
}

void PressureAverage::energies(EnergyReport& report) const {
  report.add("pressure averaging", NamedEnergy::Kind::dissipated, taken_);
}

}  // namespace mpm
