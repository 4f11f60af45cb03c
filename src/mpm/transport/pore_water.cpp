#include "mpm/transport/pore_water.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/particles/for_particles.hpp"
#include "visits.hpp"

namespace mpm {
namespace {

/// a : the symmetric part of the strain from F0 to F1.
double contract(const Symmetric3<double>& a, const Matrix3<double>& f0, const Matrix3<double>& f1) {
  using M = Eigen::Matrix3d;
  const auto eigen = [](const Matrix3<double>& m) {
    M e;
    e << m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz;
    return e;
  };
  const M before = eigen(f0), now = eigen(f1);
  const M d = (now - before) * (0.5 * (now + before)).inverse();
  return a.xx * d(0, 0) + a.yy * d(1, 1) + a.zz * d(2, 2) + a.yz * (d(1, 2) + d(2, 1)) + a.xz * (d(0, 2) + d(2, 0)) +
         a.xy * (d(0, 1) + d(1, 0));
}

}  // namespace

SkeletonGain::SkeletonGain(const TransportParts& parts, std::vector<TransportMaterial> of_set)
    : parts_(parts), of_set_(std::move(of_set)) {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    ParticleSet& set = parts_.sets[s];
    if (is_isotropic(of_set_[s].biot)) {
      last_.push_back(set.bring("squeezed", "1"));
      PaddedArray<double>& last = set.brought[last_[s]].values;
      find_volume_ratios(set, parts_.geometry, 0, set.size(), last.data());
      for (int p = 0; p < set.size(); ++p) last[p] = std::log(last[p]);
      continue;
    }
    const std::size_t first = set.brought.size();
    for (int c = 0; c < 9; ++c) set.bring("squeezed_" + std::to_string(c), "1");
    set.bring(kSqueezedBy, "1");
    last_.push_back(first);
    for (int p = 0; p < set.size(); ++p) {
      const Matrix3<double> f =
          with_geometry(parts_.geometry, [&](auto kind) { return full(kind.load_matrix(set.f, p)); });
      const double components[9] = {f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz};
      for (int c = 0; c < 9; ++c) set.brought[first + c].values[p] = components[c];
    }
  }
}

void SkeletonGain::take(int set, int first, int last, const double* value, double* gain) {
  const TransportMaterial& material = of_set_[set];
  ParticleSet& of = parts_.sets[set];
  const auto modulus = [&](int p) { return 1.0 / material.capacity(value[p]); };
  if (is_isotropic(material.biot)) {
    double j[kGainGroup];
    find_volume_ratios(of, parts_.geometry, first, last, j);
    double* before = of.brought[last_[set]].values.data();
    for (int p = first; p < last; ++p) {
      const double now = std::log(j[p - first]);
      gain[p - first] -= modulus(p) * material.biot.xx * (now - before[p]);
      before[p] = now;
    }
    return;
  }
  for (int p = first; p < last; ++p) {
    double old[9];
    for (int c = 0; c < 9; ++c) old[c] = of.brought[last_[set] + c].values[p];
    const Matrix3<double> before{old[0], old[1], old[2], old[3], old[4], old[5], old[6], old[7], old[8]};
    const Matrix3<double> f =
        with_geometry(parts_.geometry, [&](auto kind) { return full(kind.load_matrix(of.f, p)); });
    const double by = contract(material.biot, before, f);
    of.brought[last_[set] + 9].values[p] = by;
    gain[p - first] -= modulus(p) * by;
    const double now[9] = {f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz};
    for (int c = 0; c < 9; ++c) of.brought[last_[set] + c].values[p] = now[c];
  }
}

PoreWater::PoreWater(TransportedField& pressure, const TransportParts& parts, std::unique_ptr<ScalarTransfer> transfer,
                     bool averaged)
    : pressure_(pressure),
      parts_(parts),
      transfer_(std::move(transfer)),
      averaged_(averaged),
      force_(parts.fields.front()->layout.dim(), parts.fields.front()->layout.nodes_per_block()),
      part_(1, parts.fields.front()->layout.nodes_per_block()),
      around_(force_),
      one_around_(part_),
      push_(parts.sets.size()),
      pushes_(parts.sets.size()),
      by_axis_(parts.sets.size()),
      means_(parts.sets.size()) {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    isotropic_ = isotropic_ && is_isotropic(pressure_.material(static_cast<int>(s)).biot);
    last_.push_back(parts_.sets[s].bring("pushed", "1"));
    PaddedArray<double>& last = parts_.sets[s].brought[last_[s]].values;
    find_volume_ratios(parts_.sets[s], parts_.geometry, 0, parts_.sets[s].size(), last.data());
    const auto& brought = parts_.sets[s].brought;
    const auto squeezed =
        std::find_if(brought.begin(), brought.end(), [](const NamedScalar& one) { return one.name == kSqueezedBy; });
    squeezed_.push_back(static_cast<std::size_t>(squeezed - brought.begin()));
  }
  pushed_ = !isotropic_ || axisymmetric(parts_.geometry) ? 3 : 1;
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    for (int k = 0; k < pushed_; ++k) push_[s][k].assign(parts_.sets[s].size(), 0.0);
    if (averaged_) mean_.emplace_back(parts_.sets[s].size(), 0.0);
  }
}

void PoreWater::average() {
  const std::size_t sets = parts_.sets.size();
  for (std::size_t s = 0; s < sets; ++s) {
    pushes_[s] = {push_[s][0].data()};
    means_[s] = {mean_[s].data()};
  }
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    const Grid& grid = *parts_.fields[f];
    transfer_->spread(static_cast<int>(f), pushes_, ScalarTransfer::Weight::mass, part_);
    for_nodes("pore water: mean pressure", grid, parts_.threads, [&](int b, int n) {
      part_.at(b, 0, n) = grid.carries(b, n) ? part_.at(b, 0, n) / grid.mass.at(b, 0, n) : 0.0;
    });
    transfer_->gather(static_cast<int>(f), part_, means_);
  }
  for (std::size_t s = 0; s < sets; ++s) {
    const double part = pressure_.material(static_cast<int>(s)).biot.xx / parts_.densities[s];
    const double* j = parts_.sets[s].brought[last_[s]].values.data();
    PaddedArray<double>& seen = pressure_.values(static_cast<int>(s));
    for_particles("pore water: mean pressure", parts_.sets[s], parts_.threads, [&](int p) {
      push_[s][0][p] = mean_[s][p];
      seen[p] = mean_[s][p] / (part * j[p]);
    });
  }
}

void PoreWater::push_rows(int set, int axis) {
  for_particle_groups("pore water: pressure", parts_.sets[set], kGainGroup, parts_.threads,
                      [&](int first, int end, int) { push_rows(set, axis, first, end); });
  by_axis_[set] = {};
  for (int c = 0; c < parts_.fields.front()->layout.dim(); ++c) by_axis_[set][c] = push_[set][c].data();
}

void PoreWater::push_rows(int set, int axis, int first, int end) {
  const ParticleSet& of = parts_.sets[set];
  const GridLayout& layout = parts_.fields.front()->layout;
  const Symmetric3<double>& a = pressure_.material(set).biot;
  const double rows[3][3] = {{a.xx, a.xy, a.xz}, {a.xy, a.yy, a.yz}, {a.xz, a.yz, a.zz}};
  const double* row = rows[layout.axis(axis)];
  const PaddedArray<double>& pressure = pressure_.carried(set);
  for (int c = 0; c < layout.dim(); ++c) {
    double* push = push_[set][c].data();
    const double part = row[layout.axis(c)] / parts_.densities[set];
    find_volume_ratios(of, parts_.geometry, first, end, push + first);
    for (int p = first; p < end; ++p) push[p] *= part * pressure[p];
  }
}

void PoreWater::push_hoop(int set) {
  auto& push = push_[set];
  std::fill(push[1].begin(), push[1].end(), 0.0);
  push_hoop(set, 0, parts_.sets[set].awake());
  by_axis_[set] = {push[1].data(), push[1].data(), push[isotropic_ ? 0 : 2].data()};
}

void PoreWater::push_hoop(int set, int first, int end) {
  if (isotropic_) return;
  const ParticleSet& of = parts_.sets[set];
  auto& push = push_[set];
  find_volume_ratios(of, parts_.geometry, first, end, push[2].data() + first);
  const double part = pressure_.material(set).biot.yy / parts_.densities[set];
  for (int p = first; p < end; ++p) push[2][p] *= part * pressure_.carried(set)[p];
}

// Particles may have come from other ranks and gone there.
void PoreWater::fit_scratch() {
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const std::size_t size = parts_.sets[s].id.size();
    for (int k = 0; k < pushed_; ++k) push_[s][k].resize(size);
    if (averaged_) mean_[s].resize(size);
  }
}

void PoreWater::add_force(StepContext& context) {
  const int dim = context.layout().dim();
  const bool rings = axisymmetric(parts_.geometry);
  fit_scratch();
  for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
    const ParticleSet& set = parts_.sets[s];
    const TransportMaterial& own = pressure_.material(static_cast<int>(s));
    const double part = own.biot.xx, per_mass = 1.0 / parts_.densities[s];
    const PaddedArray<double>& pressure = pressure_.carried(static_cast<int>(s));
    double* last = parts_.sets[s].brought[last_[s]].values.data();
    double* push = push_[s][0].data();
    const auto press = [&](int first, int end, double& sum) {
      double j[kGainGroup];
      find_volume_ratios(set, parts_.geometry, first, end, j);
      for (int p = first; p < end; ++p) {
        push[p] = part * pressure[p] * j[p - first] * per_mass;
        // The mean of the pressure: what the squeeze has made of it counts half.
        const double grown = j[p - first] - last[p];
        const double mean = pressure[p] + 0.5 * part * grown / (j[p - first] * own.capacity(pressure[p]));
        sum += set.mass_of(p) * per_mass * part * mean * grown;
        last[p] = j[p - first];
      }
    };
    // The same with alpha : d(strain) for alpha d(ln J), in the mean of the volume before and after.
    const auto press_by_rows = [&](int first, int end, double& sum) {
      double j[kGainGroup];
      find_volume_ratios(set, parts_.geometry, first, end, j);
      const double* by = set.brought[squeezed_[s]].values.data();
      for (int p = first; p < end; ++p) {
        const double mean = pressure[p] + 0.5 * by[p] / own.capacity(pressure[p]);
        sum += set.mass_of(p) * per_mass * mean * by[p] * 0.5 * (j[p - first] + last[p]);
        push[p] = part * pressure[p] * j[p - first] * per_mass;
        last[p] = j[p - first];
      }
    };
    const bool rows = !is_isotropic(own.biot);
    work_ = rows ? sum_groups("pore water: pressure", set, parts_.threads, sums_, work_, press_by_rows)
                 : sum_groups("pore water: pressure", set, parts_.threads, sums_, work_, press);
    pushes_[s] = {push};
  }
  if (averaged_) average();
  radial_ = 0.0;
  for (std::size_t f = 0; f < parts_.fields.size(); ++f) {
    Grid& grid = *parts_.fields[f];
    const int nodes = grid.layout.nodes_per_block();
    const auto add = [&](const NodalField& from, int components, int to) {
      for_blocks("pore water: force", grid, parts_.threads, [&](int b) {
        for (int i = 0; i < components * nodes; ++i) grid.force.block(b)[to * nodes + i] += from.block(b)[i];
      });
    };
    if (isotropic_) {
      transfer_->spread_gradient_sum(static_cast<int>(f), pushes_, ScalarTransfer::Weight::mass, force_);
      add(force_, dim, 0);
    }
    for (int k = 0; k < dim && !isotropic_; ++k) {
      for (std::size_t s = 0; s < parts_.sets.size(); ++s) push_rows(static_cast<int>(s), k);
      transfer_->spread_gradient(static_cast<int>(f), by_axis_, ScalarTransfer::Weight::mass, part_);
      add(part_, 1, k);
    }
    if (!rings) continue;
    // The hoop direction pushes outwards: T_ip alone.
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) push_hoop(static_cast<int>(s));
    transfer_->spread_gradient(static_cast<int>(f), by_axis_, ScalarTransfer::Weight::mass, part_);
    add(part_, 1, 0);
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < nodes && grid.counts(b); ++n) radial_ += part_.at(b, 0, n) * context.dt;
    }
  }
}

void PoreWater::add_forces(const RestingBlock& block, BlockForces& forces) {
  const int dim = parts_.fields.front()->layout.dim(), at = block.first_owner + block.owner;
  const auto each_set = [&](auto&& visit) {
    for (std::size_t s = 0; s < parts_.sets.size(); ++s) {
      const std::vector<std::uint32_t>& begin = parts_.sets[s].begin;
      visit(static_cast<int>(s), static_cast<int>(begin[at]), static_cast<int>(begin[at + 1]));
    }
  };
  const auto spread = [&](int axis) {
    transfer_->spread_gradient_of_block(block.field, block.owner, by_axis_, ScalarTransfer::Weight::mass, one_around_);
    add_around(one_around_, forces, axis);
  };
  if (isotropic_) {
    each_set([&](int s, int, int) { pushes_[s] = {push_[s][0].data()}; });
    transfer_->spread_gradient_of_block(block.field, block.owner, pushes_, ScalarTransfer::Weight::mass, around_);
    add_around(around_, forces);
  }
  for (int k = 0; k < dim && !isotropic_; ++k) {
    each_set([&](int s, int first, int end) {
      push_rows(s, k, first, end);
      for (int c = 0; c < 3; ++c) by_axis_[s][c] = c < dim ? push_[s][c].data() : nullptr;
    });
    spread(k);
  }
  if (!axisymmetric(parts_.geometry)) return;
  each_set([&](int s, int first, int end) {
    std::fill(push_[s][1].begin() + first, push_[s][1].begin() + end, 0.0);
    push_hoop(s, first, end);
    by_axis_[s] = {push_[s][1].data(), push_[s][1].data(), push_[s][isotropic_ ? 0 : 2].data()};
  });
  spread(0);
}

double PoreWater::stiffness(int set) const {
  const TransportMaterial& own = pressure_.material(set);
  const Symmetric3<double>& b = own.biot;
  const double alpha = std::max({b.xx, b.yy, b.zz}) + std::abs(b.yz) + std::abs(b.xz) + std::abs(b.xy);
  return alpha * alpha / own.capacity.least();
}

double PoreWater::undrained_speed(int set, double drained) const {
  return std::sqrt(drained * drained + stiffness(set) / parts_.densities[set]);
}

void PoreWater::serialise(StateArchive& archive) { archive.sum("work", work_); }

}  // namespace mpm
