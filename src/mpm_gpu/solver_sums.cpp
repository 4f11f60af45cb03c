// The part of a run that reports and limits ask for: sums over particles, the fastest one, memory in use.
#include <limits>

#include "mpm_gpu/solver.hpp"

namespace mpm_gpu {

template <class T>
typename Solver<T>::Fastest Solver<T>::fastest(int set, double cell) {
  const SetView& of = sets_[static_cast<std::size_t>(set)];
  double* rates = place_room_.data();
  rate_passes_[static_cast<std::size_t>(set)](run_, view(0.0), set, laws_[static_cast<std::size_t>(set)].data(), cell,
                                              rates);
  const long first = of.first;
  const Faster found = run_.reduce<Faster>(
      "gpu: limit of the time step", of.count,
      [=](long i) {
        constexpr double kEndless = std::numeric_limits<double>::infinity();
        const double rate = rates[first + i];
        return Faster{rate <= kEndless ? rate : kEndless, rate, static_cast<std::uint32_t>(first + i)};
      },
      of_faster_);
  Fastest fastest{found.rate, {}};
  for (int k = 0; k < dim_; ++k) fastest.place[static_cast<std::size_t>(k)] = store_.x[k].get(found.particle);
  return fastest;
}

template <class T>
Totals Solver<T>::totals(int number) {
  const auto set = static_cast<std::size_t>(number);
  Totals totals = totals_passes_[set](run_, view(0.0), number, laws_[set].data(), of_totals_);
  const double mass = store_.mass.size() > 0 ? 1.0 : sets_[set].mass;
  for (double* sum : {&totals.kinetic, &totals.elastic, &totals.plastic, &totals.carried}) *sum *= mass;
  for (int k = 0; k < 3; ++k) {
    totals.momentum[k] *= mass;
    totals.place[k] *= mass;
  }
  return totals;
}

template <class T>
std::array<double, 3> Solver<T>::momentum() {
  std::array<double, 3> sum{};
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    const Totals of_set = totals(static_cast<int>(s));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += of_set.momentum[k];
  }
  return sum;
}

template <class T>
std::size_t Solver<T>::particle_bytes() {
  std::size_t sum =
      node_.bytes() + id_room_.bytes() + fault_.bytes() + taken_.bytes() + place_room_.bytes() + room_.bytes();
  store_.each([&](const auto& buffer) { sum += buffer.bytes(); });
  for (const Buffer<T>& one : gradient_) sum += one.bytes();
  for (const Buffer<T>& one : domain_) sum += one.bytes();
  for (const Buffer<double>& one : next_x_) sum += one.bytes();
  return sum;
}

template <class T>
std::size_t Solver<T>::bytes() {
  std::size_t sum = particle_bytes() + cells_.bytes() + holds_.bytes() + around_.bytes() + of_nodes_.bytes() +
                    of_particles_.bytes() + of_counted_.bytes();
  for (const auto* field : {&mass_, &nodal_[0], &nodal_[1], &nodal_[2], &increment_, &held_, &held_more_, &left_,
                            &averaged_, &moved_[0], &moved_[1]})
    sum += field->bytes();
  for (const auto& stage : stages_) sum += stage->bytes();
  return sum + of_totals_.bytes() + of_faster_.bytes();
}

#define MPM_SUMS_OF_RUN(T)                                              \
  template Solver<T>::Fastest Solver<T>::fastest(int set, double cell); \
  template Totals Solver<T>::totals(int number);                        \
  template std::array<double, 3> Solver<T>::momentum();                 \
  template std::size_t Solver<T>::particle_bytes();                     \
  template std::size_t Solver<T>::bytes();
MPM_SUMS_OF_RUN(double)
MPM_SUMS_OF_RUN(float)
#undef MPM_SUMS_OF_RUN

}  // namespace mpm_gpu
