#include "mpm_gpu/put_around.hpp"

namespace mpm_gpu {

void PutAround::fit(long particles) {
  if (!any()) return;
  for (int k = 0; k < dim_; ++k) {
    if (grid_.period[k] > 0) turns_[static_cast<std::size_t>(k)].fit(particles);
  }
  room_.fit(particles);
  sums_.fit(Executor::groups_of(particles));
}

template <class T>
void PutAround::put(Executor& run, const std::array<double*, 3>& places, const T* mass,
                    const std::vector<SetView>& sets) {
  struct Kernel {
    GridView grid;
    double* x[3];
    std::int16_t* turns[3];
    int dim;
    const T* mass;
    double same_mass;
    std::uint32_t first;
    constexpr Count operator()(long i) const {
      Count count;
      for (int k = 0; k < dim; ++k) {
        const int period = grid.period[k];
        if (period == 0) continue;
        double& place = x[k][first + i];
        const int node = nearest_node(in_cells(grid, k, place)), lengths = node < 0 ? 1 : node >= period ? -1 : 0;
        if (lengths == 0) continue;
        place += lengths * (period / grid.inverse_cell[k]);
        turns[k][first + i] = static_cast<std::int16_t>(turns[k][first + i] + lengths);
        count.lengths[k] += lengths * (mass == nullptr ? same_mass : static_cast<double>(mass[first + i]));
      }
      return count;
    }
  };
  for (const SetView& set : sets) {
    const Kernel kernel{grid_,
                        {places[0], places[1], places[2]},
                        {turns_[0].data(), turns_[1].data(), turns_[2].data()},
                        dim_,
                        mass,
                        set.mass,
                        set.first};
    const Count all = run.reduce<Count>("gpu: back in the period", set.count, kernel, sums_);
    for (int k = 0; k < dim_; ++k) {
      carried_[static_cast<std::size_t>(k)] += all.lengths[k] * grid_.period[k] / grid_.inverse_cell[k];
    }
  }
}

template void PutAround::put(Executor&, const std::array<double*, 3>&, const double*, const std::vector<SetView>&);
template void PutAround::put(Executor&, const std::array<double*, 3>&, const float*, const std::vector<SetView>&);

void PutAround::clear_turns(Executor& run) {
  for (Buffer<std::int16_t>& one : turns_) {
    std::int16_t* turns = one.data();
    run.for_each("gpu: back in the period", one.size(), [=](long i) { turns[i] = 0; });
  }
}

std::size_t PutAround::bytes() const {
  std::size_t sum = room_.bytes() + sums_.bytes();
  for (const Buffer<std::int16_t>& one : turns_) sum += one.bytes();
  return sum;
}

}  // namespace mpm_gpu
