#include "mpm/mechanics/face_tractions.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace mpm {

FaceTractions::FaceTractions(const FaceSettings& settings, Fields& fields, const std::vector<ParticleSet>& sets,
                             std::vector<TractionTerm> terms, double gravity)
    : fields_(fields),
      sets_(sets),
      faces_(settings, fields, sets),
      terms_(std::move(terms)),
      halo_(settings.halo),
      nodal_(faces_.layout().dim(), faces_.layout().nodes_per_block()),
      weight_(gravity) {
  const int dim = dimensions(settings.geometry);
  std::size_t corners = 0;
  places_.resize(terms_.size());
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    places_[i].resize(terms_[i].particles.size());
    corners += terms_[i].particles.size() << (dim - 1);
  }
  loads_.reserve(corners << dim);
  for (const TractionTerm& term : terms_) {
    std::vector<char>& bears = bears_.emplace_back();
    const auto by_time = [](const Function& f) { return f.uses_time(); };
    if (std::none_of(term.value.begin(), term.value.end(), by_time)) continue;
    for (const std::uint32_t id : term.particles) {
      if (id >= bears.size()) bears.resize(id + 1, 0);
      bears[id] = 1;
    }
  }
  account_.name = "traction";
}

void FaceTractions::look_for_particles() {
  int found = -1;  // the set that place_of_ is of
  any_chooses_ = false;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const ParticleSet& set = sets_[terms_[i].set];
    if (terms_[i].set != found) {
      find_places(set, place_of_);
      found = terms_[i].set;
    }
    for (std::size_t n = 0; n < places_[i].size(); ++n) {
      const std::uint32_t id = terms_[i].particles[n];
      places_[i][n] = id < place_of_.size() ? place_of_[id] : -1;
      any_chooses_ = any_chooses_ || (places_[i][n] >= 0 && set.chooses && set.side[places_[i][n]] != 0);
    }
  }
}

Vec3 FaceTractions::value_at(const TractionTerm& term, const FaceParts& parts, int p, double time, double half) const {
  const GridLayout& layout = faces_.layout();
  const ParticleSet& set = sets_[term.set];
  Vec3 place = Vec3::Zero(), start = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    const int axis = layout.axis(k);
    place[axis] = parts.middle[k] + half * set.v[k][p];
    if (set.start_x.empty()) continue;
    start[axis] = set.start_x[k][p] + (k == term.face.axis ? term.face.side() * set.half[k] * layout.cell(k) : 0.0);
  }
  std::array<double, 3> given{};
  for (int i = 0; i < 3; ++i) {
    try {
      given[i] = term.value[i](time, place, start);
    } catch (const FunctionError& error) {
      throw LoadError(fmt::format("traction on '{}' at particle {}: {}", set.name, set.id[p], error.what()));
    }
  }
  Vec3 traction = Vec3::Zero();
  for (int k = 0; k < layout.dim(); ++k) {
    const int axis = layout.axis(k);
    traction[axis] = term.follows
                         ? -given[0] * parts.outward[k] + given[1] * parts.along[0][k] + given[2] * parts.along[1][k]
                         : given[axis];
  }
  return traction;
}

void FaceTractions::spread(int set, int p, const PlacedDomain::Vector& at, const Vec3& force) {
  const NodeShares shares = faces_.shares(set, p, at);
  if (shares.count == 0) {
    throw LoadError(fmt::format(
        "traction on '{}': a corner of particle {} lies where no material is on the grid; the particle is stretched "
        "too far: use a coarser grid.cell, or a smaller load",
        sets_[set].name, sets_[set].id[p]));
  }
  for (int i = 0; i < shares.count; ++i) {
    loads_.push_back({set, p, shares.field[i], shares.node[i], force * shares.share[i]});
  }
}

Vec3 FaceTractions::find_loads(const StepContext& context) {
  const std::uint64_t generation =
      context.fields.front()->blocks.generation();  // generation of all fields: they are rebuilt together
  if (generation_ != generation || any_chooses_) {
    look_for_particles();
    generation_ = generation;
  }
  loads_.clear();
  const double half = 0.5 * context.dt;
  Vec3 impulse = Vec3::Zero();
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const TractionTerm& term = terms_[i];
    for (const int p : places_[i]) {
      if (p < 0 || p >= sets_[term.set].awake()) continue;
      const FaceParts parts = faces_.parts(term.set, p, term.face);
      const Vec3 traction = value_at(term, parts, p, context.start + half, half);
      impulse += traction * (parts.area * context.dt);
      for (int a = 0; a < parts.corners; ++a) {
        spread(term.set, p, parts.corner[a].at, traction * parts.corner[a].area);
      }
    }
  }
  return impulse;
}

void FaceTractions::forces_gathered(StepContext& context) {
  const Vec3 impulse = find_loads(context);
  if (halo_ == nullptr) {
    for (const NodalLoad& load : loads_) {
      Grid& grid = *fields_[load.field];
      add_nodal_vector(grid.force, grid.layout, load.node, load.force);
    }
  } else {
    for (std::size_t f = 0; f < fields_.size(); ++f) add_over_ranks(static_cast<int>(f));
  }
  account_.add(impulse);
}

bool FaceTractions::stirs(const RestingBlock& block, const RestTimes& times) {
  double change = 0.0, scale = 0.0;
  block.each(sets_, [&](std::size_t s, int p) {
    const ParticleSet& set = sets_[s];
    scale += set.mass_of(p) * weight_;
    const std::uint32_t id = set.id[p] - set.first_id;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      if (terms_[i].set != static_cast<int>(s) || id >= bears_[i].size() || bears_[i][id] == 0) continue;
      const FaceParts parts = faces_.parts_of_box(terms_[i].set, p, terms_[i].face);
      const Vec3 before = value_at(terms_[i], parts, p, times.before, 0.0);
      change += parts.area * (value_at(terms_[i], parts, p, times.now, 0.0) - before).norm();
      scale += parts.area * before.norm();
    }
  });
  return change > times.part * scale;
}

void FaceTractions::add_forces(const RestingBlock& block, BlockForces& forces) {
  const GridLayout& layout = faces_.layout();
  const int at = block.first_owner + block.owner;
  for (const NodalLoad& load : loads_) {
    const auto p = static_cast<std::uint32_t>(load.particle);
    const std::vector<std::uint32_t>& begin = sets_[load.set].begin;
    if (p < begin[at] || p >= begin[at + 1]) continue;
    const std::array<int, 3> node = layout.node(fields_[load.field]->blocks.block(load.node.block), load.node.node);
    int of_tile = 0;
    bool inside = true;
    for (int k = 0; k < layout.dim(); ++k) {
      const int along = node[k] - block.block[k] * kBlockEdge + BlockForces::kMargin;
      inside = inside && along >= 0 && along < BlockForces::kEdge;
      of_tile = of_tile * BlockForces::kEdge + along;
    }
    if (!inside) continue;
    for (int k = 0; k < layout.dim(); ++k) forces.force[k][of_tile] += static_cast<float>(load.force[layout.axis(k)]);
  }
}

void FaceTractions::add_over_ranks(int field) {
  Grid& grid = *fields_[field];
  nodal_.resize(grid.blocks.size());
  std::fill_n(nodal_.data(), nodal_.size(), 0.0);
  for (const NodalLoad& load : loads_) {
    if (load.field == field) add_nodal_vector(nodal_, grid.layout, load.node, load.force);
  }
  halo_->add(field, nodal_);
  for (std::size_t i = 0; i < nodal_.size(); ++i) grid.force.data()[i] += nodal_.data()[i];
}

void FaceTractions::momentum_updated(StepContext& context) {
  double power = 0.0;
  // The displacement of a particle in the step: v^{n+1} dt - a dt^2 / 2, GIMP notes (2.16).
  const double back = context.works_at_end ? 0.0 : 0.5 * context.dt;
  for (const NodalLoad& load : loads_) {
    const Grid& grid = *fields_[load.field];
    const Vec3 v = nodal_vector(grid.velocity, grid.layout, load.node);
    const Vec3 a = nodal_vector(grid.force, grid.layout, load.node);
    power += load.force.dot(v - back * a);
  }
  work_ += power * context.dt;
}

}  // namespace mpm
