#include "mpm_gpu/leaving.hpp"

namespace mpm_gpu {

template <class T>
PutsBack<T>::PutsBack(mpm::Leaving* leaving, std::uint64_t limit, long particles, const mpm::GridLayout& layout,
                      const Passes<T>& passes)
    : layout_(layout),
      own_(leaving != nullptr ? nullptr : std::make_unique<mpm::Leaving>(limit, no_sets_, layout_, nullptr)),
      leaving_(leaving != nullptr ? *leaving : *own_),
      passes_(passes) {
  numbers_.fit((1 + layout.dim()) * particles);
  fault_.fit(particles);
  id_.fit(particles);
  total_.make_room(particles);
  taken_.make_room(particles);
}

template <class T>
bool PutsBack<T>::put_back(Executor& run, const Step<T>& step) {
  const long count = step.particles.count;
  passes_.put_back(run, step, numbers_.data());
  taken_.add(run, "gpu: accounts", numbers_.data(), count, 1);
  total_.add(run, "gpu: accounts", numbers_.data() + count, count, layout_.dim());
  copy_faults(run, step.particles.fault, step.particles.id, count, fault_.data(), id_.data());
  fault_here_ = fault_.download();
  id_here_ = id_.download();
  returned_.clear();
  for (std::size_t p = 0; p < fault_here_.size(); ++p) {
    if ((fault_here_[p] & kOutside) != 0) return false;
    if ((fault_here_[p] & kReturned) != 0) returned_.push_back(id_here_[p]);
  }
  const Total::Sum sum = total_.take();
  mpm::Vec3 given = mpm::Vec3::Zero();
  for (int k = 0; k < layout_.dim(); ++k) given[layout_.axis(k)] = sum.of[static_cast<std::size_t>(k)];
  if (leaving_.count(returned_, given, taken_.take().of[0])) return true;
  const mpm::OutsideReason reason = leaving_.too_many();
  throw mpm::ModuleError(reason.what + ": " + reason.remedy);
}

template class PutsBack<double>;
template class PutsBack<float>;

}  // namespace mpm_gpu
