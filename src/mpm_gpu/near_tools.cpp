#include "mpm_gpu/near_tools.hpp"

#include <algorithm>

namespace mpm_gpu {
namespace {

constexpr double kMoved = 2.0;  ///< cells beyond the nodes of a block within which its particles are at a step's end

}  // namespace

template <class T>
NearTools<T>::NearTools(const mpm::OutOfTools& out, const mpm::SoilBodies& bodies, const mpm::GridLayout& layout)
    : out_(out), bodies_(bodies), layout_(layout), half_(0.0), copies_(layout.dim(), false) {
  for (int k = 0; k < layout.dim(); ++k) half_ = std::max(half_, (0.5 * (kEdge - 1) + kMoved) * layout.cell(k));
}

template <class T>
bool NearTools<T>::put_out(Executor& run, const Step<T>& step, const SoilMap<T>& map, const mpm::Grid& grid) {
  const std::size_t dim = static_cast<std::size_t>(layout_.dim());
  blocks_.clear();
  for (int b = 0; b < grid.blocks.size(); ++b) {
    const std::array<int, 3>& block = grid.blocks.block(b);
    const mpm::Vec3 low = layout_.node_position(block, 0),
                    high = layout_.node_position(block, layout_.nodes_per_block() - 1);
    if (out_.near(0.5 * (low + high), half_)) blocks_.push_back(map.blocks()[static_cast<std::size_t>(b)]);
  }
  if (blocks_.empty()) return false;
  copies_.download_ranges(run, step, blocks_, ranges_);
  particles_.clear();
  ends_.clear();
  const std::size_t rows = ranges_.size() / 2, of_set = rows / static_cast<std::size_t>(step.set_count);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::uint32_t p = ranges_[row]; p < ranges_[rows + row]; ++p) particles_.push_back(p);
    if ((row + 1) % of_set == 0) ends_.push_back(particles_.size());
  }
  copies_.take_particles(run, step, particles_, ids_, surfaces_);
  copies_.download_particles(run, step, 0, places_);
  const std::size_t count = particles_.size();
  bool any = false;
  for (std::size_t s = 0, p = 0; s < ends_.size(); ++s) {
    for (; p < ends_[s]; ++p) {
      double x[3] = {};
      for (std::size_t k = 0; k < dim; ++k) x[k] = places_[k * count + p];
      if (!out_.put(*bodies_.list[s].set, x)) continue;
      for (std::size_t k = 0; k < dim; ++k) places_[k * count + p] = x[k];
      any = true;
    }
  }
  if (any) copies_.upload_places(run, step, places_);
  return any;
}

template class NearTools<double>;
template class NearTools<float>;

}  // namespace mpm_gpu
