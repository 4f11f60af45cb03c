#include "mpm_gpu/home_blocks.hpp"

namespace mpm_gpu {

template <class T>
void HomeBlocks<T>::take(const std::vector<std::uint32_t>& home, const std::vector<std::int32_t>& first) {
  home_.grow(static_cast<long>(home.size()));
  home_.upload(home);
  first_.grow(static_cast<long>(first.size()));
  first_.upload(first);
}

template <class T>
bool HomeBlocks<T>::any_left(Executor& run, const Step<T>& step) {
  const ParticleView<T> particles = step.particles;
  const GridView grid = step.grid;
  const int dim = dim_;
  const double lowest = -reach_, highest = kEdge - 1 + reach_;
  const std::uint32_t* home = home_.data();
  const std::int32_t* first = first_.data();
  left_.grow(Executor::groups_of(particles.count));
  const Left left = run.reduce<Left>(
      "gpu: reach of blocks", particles.count,
      [=](long p) {
        Left one;
        const std::int32_t* from = first + home[particles.id[p]] * static_cast<std::uint32_t>(dim);
        for (int k = 0; k < dim; ++k) {
          const double along = in_cells(grid, k, particles.next_x[k][p]), cells = along - from[k];
          one.any = one.any || !(cells >= lowest && cells <= highest);
          const int node = nearest_node(along);
          one.any = one.any || around(grid, k, node) != node;
        }
        return one;
      },
      left_);
  return left.any;
}

template class HomeBlocks<double>;
template class HomeBlocks<float>;

}  // namespace mpm_gpu
