#include "mpm_gpu/near_copies.hpp"

#include "mpm_gpu/faces.hpp"
#include "mpm_gpu/passes.hpp"
#include "mpm_gpu/walls.hpp"

namespace mpm_gpu {

template <class T>
void NearCopies<T>::download_keys(Executor& run, const NodeView& nodes, std::vector<std::uint64_t>& keys) {
  key_room_.grow(nodes.blocks);
  copy_keys(run, nodes, key_room_.data());
  keys.resize(static_cast<std::size_t>(nodes.blocks));
  key_room_.download(keys.data(), nodes.blocks);
}

template <class T>
void NearCopies<T>::download_ranges(Executor& run, const Step<T>& step, const std::vector<std::int32_t>& blocks,
                                    std::vector<std::uint32_t>& ranges) {
  const long near = static_cast<long>(blocks.size()), per_block = per_block_, all = step.nodes.nodes;
  const long rows = step.set_count * near * per_block;
  ranges.resize(static_cast<std::size_t>(2 * rows));
  block_.grow(near);
  block_.upload(blocks);
  whole_room_.grow(2 * rows);
  const std::int32_t* block = block_.data();
  const std::uint32_t *begin = step.nodes.begin, *end = step.nodes.end;
  std::uint32_t* to = whole_room_.data();
  run.for_each("gpu: nodes near bodies", rows, [=](long i) {
    const long set = i / (near * per_block), of_set = i % (near * per_block);
    const long from = set * all + block[of_set / per_block] * per_block + of_set % per_block;
    to[i] = begin[from];
    to[rows + i] = end[from];
  });
  whole_room_.download(ranges.data(), 2 * rows);
}

template <class T>
void NearCopies<T>::take_blocks(Executor& run, const NodeView& nodes, const std::vector<std::int32_t>& blocks,
                                bool mark) {
  blocks_ = static_cast<long>(blocks.size());
  block_.grow(blocks_);
  block_.upload(blocks);
  if (!mark) return;
  marks_.grow(nodes.nodes);
  std::uint8_t* marks = marks_.data();
  run.for_each("gpu: nodes near bodies", nodes.nodes, [=](long i) { marks[i] = 0; });
  each_node(run, [=](long node, long, long) { marks[node] = 1; });
}

template <class T>
void NearCopies<T>::take_particles(Executor& run, const Step<T>& step, const std::vector<std::uint32_t>& particles,
                                   std::vector<std::uint32_t>& ids, std::vector<double>& surface) {
  particles_ = static_cast<long>(particles.size());
  particle_.grow(particles_);
  particle_.upload(particles);
  whole_room_.grow(particles_);
  const std::uint32_t *particle = particle_.data(), *from = step.particles.id;
  std::uint32_t* to = whole_room_.data();
  run.for_each("gpu: particles near bodies", particles_, [=](long i) { to[i] = from[particle[i]]; });
  ids.resize(particles.size());
  whole_room_.download(ids.data(), particles_);
  const T* reach = step.particles.surface;
  if (reach == nullptr) return;
  room_.grow(particles_);
  double* room = room_.data();
  run.for_each("gpu: particles near bodies", particles_,
               [=](long i) { room[i] = static_cast<double>(reach[particle[i]]); });
  surface.resize(particles.size());
  room_.download(surface.data(), particles_);
}

template <class T>
template <class Kernel>
void NearCopies<T>::each_node(Executor& run, const Kernel& kernel) {
  const long per_block = per_block_;
  const int dim = dim_;
  const std::int32_t* block = block_.data();
  run.for_each("gpu: nodes near bodies", count(), [=](long i) {
    const long b = i / per_block, n = i % per_block;
    kernel(block[b] * per_block + n, b * dim * per_block + n, per_block);
  });
}

template <class T>
void NearCopies<T>::gather(Executor& run, const NodeView& nodes, const double* from, int components) {
  room_.grow(count() * components);
  double* room = room_.data();
  const std::int32_t* block = block_.data();
  const long per_block = per_block_, all = nodes.nodes;
  run.for_each("gpu: nodes near bodies", count() * components, [=](long i) {
    const long b = i / (per_block * components), c = i / per_block % components, n = i % per_block;
    room[i] = from[c * all + block[b] * per_block + n];
  });
}

template <class T>
void NearCopies<T>::download(Executor& run, const NodeView& nodes, const double* from, int components, double* to) {
  gather(run, nodes, from, components);
  room_.download(to, count() * components);
}

template <class T>
void NearCopies<T>::download_soon(Executor& run, const NodeView& nodes, const double* from, int components,
                                  double* to) {
  gather(run, nodes, from, components);
  room_.download_soon(to, count() * components);
}

template <class T>
void NearCopies<T>::download_particles(Executor& run, const Step<T>& step, int components, std::vector<double>& to) {
  const int dim = dim_, rows = 2 * dim + components;
  const long count = particles_;
  room_.grow(count * rows);
  double* room = room_.data();
  const std::uint32_t* particle = particle_.data();
  const ParticleView<T> particles = step.particles;
  run.for_each("gpu: particles near bodies", count, [=](long i) {
    const long p = particle[i];
    for (int k = 0; k < dim; ++k) {
      room[k * count + i] = particles.x[k][p];
      room[(dim + k) * count + i] = static_cast<double>(particles.v[k][p]);
    }
    for (int c = 0; c < components; ++c) room[(2 * dim + c) * count + i] = static_cast<double>(particles.f[c][p]);
  });
  to.resize(static_cast<std::size_t>(count * rows));
  room_.download(to.data(), count * rows);
}

template <class T>
void NearCopies<T>::upload_places(Executor& run, const Step<T>& step, const std::vector<double>& from) {
  const int dim = dim_;
  const long count = particles_;
  room_.grow(count * dim);
  room_.upload(from.data(), count * dim);
  const double* room = room_.data();
  const std::uint32_t* particle = particle_.data();
  const ParticleView<T> particles = step.particles;
  run.for_each("gpu: particles near bodies", count, [=](long i) {
    for (int k = 0; k < dim; ++k) particles.x[k][particle[i]] = room[k * count + i];
  });
}

template <class T>
template <int Dim, class Kernel>
void NearCopies<T>::each_returned(Executor& run, const Step<T>& step, const Kernel& kernel) {
  const GridView grid = step.grid;
  const std::uint64_t* keys = step.nodes.key;
  const double* room = room_.data();
  each_node(run, [=](long node, long at, long stride) {
    int number[3];
    number_of_node(grid, Dim, keys, node, number);
    double given[Dim];
    for (int c = 0; c < Dim; ++c) given[c] = room[at + c * stride];
    kernel(node, number, given, at);
  });
}

template <class T>
template <int Dim>
void NearCopies<T>::take_for_strain(Executor& run, const Step<T>& step) {
  const NodeView nodes = step.nodes;
  const GridView grid = step.grid;
  const bool again = walls_again_;
  each_returned<Dim>(run, step, [=](long node, const int* number, double(&v)[Dim], long) {
    for (int c = 0; again && c < Dim; ++c) {
      const long to = c * nodes.nodes + node;
      nodes.moved[to] = v[c] - nodes.velocity[to];
    }
    if (again) hold_again_for_strain<Dim>(grid, nodes, node, number, v);
    for (int c = 0; c < Dim; ++c) nodes.velocity[c * nodes.nodes + node] = v[c];
  });
}

template <class T>
template <int Dim>
void NearCopies<T>::take_at_end(Executor& run, const Step<T>& step) {
  const NodeView nodes = step.nodes;
  const GridView grid = step.grid;
  const double *acceleration = other_room_.data(), dt = step.settings.dt;
  const long stride = per_block_;
  const bool again = walls_again_;
  each_returned<Dim>(run, step, [=](long node, const int* number, double(&v)[Dim], long at) {
    double given[Dim];
    for (int c = 0; c < Dim; ++c) given[c] = v[c];
    if (again) hold_again_at_end<Dim>(grid, nodes, node, number, nodes.mass[node], v);
    for (int c = 0; c < Dim; ++c) {
      const long to = c * nodes.nodes + node;
      nodes.velocity[to] = v[c];
      nodes.acceleration[to] = acceleration[at + c * stride] + (v[c] - given[c]) / dt;
    }
  });
}

template <class T>
template <int Dim>
void NearCopies<T>::take_first_increment(Executor& run, const Step<T>& step) {
  const NodeView nodes = step.nodes;
  const GridView grid = step.grid;
  const bool again = walls_again_;
  each_returned<Dim>(run, step, [=](long node, const int* number, double(&v)[Dim], long) {
    if (again) hold_increment_again<Dim>(grid, nodes, node, number, 0.0, v);
    for (int c = 0; c < Dim; ++c) nodes.increment[c * nodes.nodes + node] = v[c];
  });
}

template <class T>
template <int Dim>
void NearCopies<T>::take_increment(Executor& run, const Step<T>& step) {
  const NodeView nodes = step.nodes;
  const GridView grid = step.grid;
  const bool mixed = nodes.work != nullptr;  // particles take this over as they gain an acceleration
  const double dt = step.settings.dt;
  const bool again = walls_again_;
  each_returned<Dim>(run, step, [=](long node, const int* number, double(&v)[Dim], long) {
    if (again) hold_increment_again<Dim>(grid, nodes, node, number, nodes.mass[node], v);
    for (int c = 0; c < Dim; ++c) {
      const long to = c * nodes.nodes + node;
      nodes.velocity[to] += v[c] - nodes.increment[to];
      if (mixed) nodes.acceleration[to] += (v[c] - nodes.increment[to]) / dt;
      nodes.increment[to] = v[c];
    }
  });
}

template <class T>
void NearCopies<T>::upload(Buffer<double>& room, const double* from) {
  room.grow(count() * dim_);
  room.upload(from, count() * dim_);
}

template <class T>
void NearCopies<T>::upload_for_strain(Executor& run, const Step<T>& step, const double* velocity) {
  upload(room_, velocity);
  dim_ == 3 ? take_for_strain<3>(run, step) : take_for_strain<2>(run, step);
}

template <class T>
void NearCopies<T>::upload_at_end(Executor& run, const Step<T>& step, const double* velocity,
                                  const double* acceleration) {
  upload(room_, velocity);
  upload(other_room_, acceleration);
  dim_ == 3 ? take_at_end<3>(run, step) : take_at_end<2>(run, step);
}

template <class T>
void NearCopies<T>::upload_first_increment(Executor& run, const Step<T>& step, const double* increment) {
  upload(room_, increment);
  dim_ == 3 ? take_first_increment<3>(run, step) : take_first_increment<2>(run, step);
}

template <class T>
void NearCopies<T>::upload_increment(Executor& run, const Step<T>& step, const double* increment) {
  upload(room_, increment);
  dim_ == 3 ? take_increment<3>(run, step) : take_increment<2>(run, step);
}

template class NearCopies<double>;
template class NearCopies<float>;

}  // namespace mpm_gpu
