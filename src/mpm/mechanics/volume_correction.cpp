#include "mpm/mechanics/volume_correction.hpp"

#include <algorithm>

#include "mpm/grid/for_nodes.hpp"
#include "mpm/kernel/volume_rule.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/particles/for_particles.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {

VolumeCorrection::VolumeCorrection(std::vector<Body> bodies, GeometryKind geometry, ShapeKind shape, int threads,
                                   std::unique_ptr<ScalarTransfer> transfer, double cell)
    : bodies_(std::move(bodies)),
      geometry_(geometry),
      shape_(shape),
      threads_(threads),
      transfer_(std::move(transfer)),
      cell_(cell),
      numbers_(bodies_.size()),
      one_(1, nodes_of_block(dimensions(geometry))) {}

void VolumeCorrection::make_room() {
  for (std::size_t s = 0; s < bodies_.size(); ++s) {
    const std::size_t size = bodies_[s].set->id.size();
    Numbers& of = numbers_[s];
    const auto room = [&](PaddedArray<double>& array) {
      if (array.size() != size) array.assign(size, 0.0);
    };
    if (of.volume.size() != size)
      of.volume.assign(size, 1.0 / bodies_[s].density());  // value that those of fluids keep
    if (!bodies_[s].liquid()) continue;
    for (PaddedArray<double>* array : {&of.fullness, &of.full, &of.squares}) room(*array);
    for (int k = 0; k < dimensions(geometry_); ++k) room(of.slope[k]);
    if (axisymmetric(geometry_)) room(of.slope[2]);
    sums_.reserve(size);
  }
}

template <class Geometry>
void VolumeCorrection::find_volumes() {
  for (std::size_t s = 0; s < bodies_.size(); ++s) {
    const Body& body = bodies_[s];
    PaddedArray<double>& volume = numbers_[s].volume;
    const double start = 1.0 / body.density();
    if (body.liquid()) continue;
    for_particles("volume correction: volumes", *body.set, threads_,
                  [&](int p) { volume[p] = start * determinant(Geometry::load_matrix(body.set->f, p)); });
  }
}

double VolumeCorrection::share_along(const Grid& grid, int axis, int node) const {
  const GridLayout& layout = grid.layout;
  if (layout.periodic(axis)) return 1.0;
  const int last = layout.last_node(axis), from_face = std::min(node, last - node);
  if (axis == 0 && axisymmetric(geometry_)) {
    if (from_face < 0) return 0.0;
    // Integral of r times the hat function over a cell's half, in cells.
    const double radius = node + layout.origin(0) * layout.inverse_cell(0);
    const double inner = node > 0 ? radius / 2 - 1.0 / 6.0 : 0.0, outer = node < last ? radius / 2 + 1.0 / 6.0 : 0.0;
    return kTurn * layout.cell(0) * (inner + outer);
  }
  const double beyond = traits_of(shape_).beyond_next;
  const bool folds = grid.has_wall[2 * axis + (node > last - node ? 1 : 0)];
  return VolumeRule::share(from_face, folds, beyond);
}

double VolumeCorrection::share(const Grid& grid, const std::array<int, 3>& node) const {
  double share = 1.0;
  for (int k = 0; k < grid.layout.dim(); ++k) share *= share_along(grid, k, node[k]);
  return share;
}

void VolumeCorrection::find_fullness(const Fields& fields) {
  const int count = static_cast<int>(fields.size()), nodes = fields.front()->layout.nodes_per_block();
  while (static_cast<int>(volume_.size()) < count) {
    volume_.emplace_back(1, nodes);
    fullness_.emplace_back(1, nodes);
  }
  given_.assign(bodies_.size(), {});
  for (std::size_t s = 0; s < bodies_.size(); ++s) given_[s][0] = numbers_[s].volume.data();
  for (int f = 0; f < count; ++f) transfer_->spread(f, given_, ScalarTransfer::Weight::mass, volume_[f]);
  for (int f = 0; f < count; ++f) {
    const BlockTable& blocks = fields[f]->blocks;
    fullness_[f].resize(blocks.size());
    for_blocks("volume correction: fullness of nodes", *fields[f], threads_, [&](int b) {
      double* held = fullness_[f].block(b);
      std::copy_n(volume_[f].block(b), nodes, held);
      for (int g = 0; g < count; ++g) {
        const int there = g == f ? -1 : fields[g]->blocks.find(blocks.key(b));
        for (int n = 0; n < nodes && there >= 0; ++n) held[n] += volume_[g].block(there)[n];
      }
      for (int n = 0; n < nodes; ++n) {
        const double room = share(*fields[f], fields[f]->layout.node(blocks.block(b), n));
        held[n] = VolumeRule::fullness(held[n], room, cell_);
      }
    });
  }
}

template <class Number>
const ScalarTransfer::Taken& VolumeCorrection::fluids_take(Number&& number) {
  takers_.assign(bodies_.size(), {});
  for (std::size_t s = 0; s < bodies_.size(); ++s) {
    if (bodies_[s].liquid()) number(numbers_[s], takers_[s]);
  }
  return takers_;
}

void VolumeCorrection::gather(Fields& fields) {
  const int nodes = fields.front()->layout.nodes_per_block(), dim = fields.front()->layout.dim();
  for (std::size_t f = 0; f < fields.size(); ++f) {
    transfer_->gather(static_cast<int>(f), fullness_[f],
                      fluids_take([](Numbers& of, auto& to) { to[0] = of.fullness.data(); }));
  }
  for (std::size_t f = 0; f < fields.size(); ++f) {
    for_all("volume correction: fullness of nodes", threads_, static_cast<int>(fullness_[f].size()),
            [full = fullness_[f].data()](int i) { full[i] = VolumeRule::full(full[i]); });
    transfer_->gather(static_cast<int>(f), fullness_[f],
                      fluids_take([](Numbers& of, auto& to) { to[0] = of.full.data(); }));
  }
  for (int c = 0; c < dim; ++c) {
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const Grid& grid = *fields[f];
      one_.resize(grid.blocks.size());
      for_blocks("volume correction: slopes of velocity", grid, threads_,
                 [&](int b) { std::copy_n(grid.velocity.block(b) + c * nodes, nodes, one_.block(b)); });
      transfer_->gradient(static_cast<int>(f), one_, fluids_take([&](Numbers& of, auto& to) {
                            for (int k = 0; k < dim; ++k) to[k] = of.slope[k].data();
                          }));
    }
    for (std::size_t s = 0; s < bodies_.size(); ++s) {
      Numbers& of = numbers_[s];
      if (!bodies_[s].liquid()) continue;
      for_particles("volume correction: slopes of velocity", *bodies_[s].set, threads_, [&](int p) {
        double sum = c == 0 ? 0.0 : of.squares[p];
        for (int k = 0; k < dim; ++k) sum += of.slope[k][p] * of.slope[k][p];
        of.squares[p] = sum;
      });
    }
  }
}

template <class Geometry, class Liquid>
double VolumeCorrection::correct(const Liquid& law, const Body& body, const Numbers& of, double waited) {
  ParticleSet& set = *body.set;
  return sums_.over("volume correction: dilatation", set.awake(), threads_, [&](std::size_t i, double& lost) {
    const int p = static_cast<int>(i);
    const auto f = Geometry::load_matrix(set.f, p);
    const double j = determinant(f);
    double corrected = j;
    if (!VolumeRule::relax(of.fullness[p], of.full[p], of.squares[p], waited, corrected)) return;
    const auto now = Geometry::dilatation(corrected);
    std::array<double, Geometry::kMatrix> components;
    std::array<double*, Geometry::kMatrix> places;
    for (int c = 0; c < Geometry::kMatrix; ++c) places[c] = &components[c];
    Geometry::store_matrix(now, places, 0);
    for (int c = 0; c < Geometry::kMatrix; ++c) set.f[c].set(p, components[c]);
    const auto tau = Geometry::load_symmetric(set.tau, p);
    lost += set.mass_of(p) * (law.elastic_energy(f, tau, j) - law.elastic_energy(now, tau, corrected));
  });
}

void VolumeCorrection::momentum_gathered(StepContext& context) {
  const double waited = clock_.advance(context.dt);
  const bool acts = waited > 0.0, first = volume_.empty();
  // The first step of a run, whatever its number, makes room for what the others need: these do not allocate.
  if (!acts && !first) return;
  make_room();
  with_geometry(geometry_, [&](auto kind) {
    using Geometry = decltype(kind);
    find_volumes<Geometry>();
    find_fullness(context.fields);
    gather(context.fields);
    for (std::size_t s = 0; s < bodies_.size() && acts; ++s) {
      std::visit(
          [&](const auto& law) {
            if constexpr (kTraitsOf<std::decay_t<decltype(law)>>.matter == Matter::liquid)
              taken_ += correct<Geometry>(law, bodies_[s], numbers_[s], waited);
          },
          *bodies_[s].law);
    }
  });
}

}  // namespace mpm
