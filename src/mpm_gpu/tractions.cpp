#include "mpm_gpu/tractions.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "mpm_gpu/error.hpp"

namespace mpm_gpu {

template <class T>
Tractions<T>::Tractions(mpm::FaceTractions& stage, const std::vector<mpm::ParticleSet>& sets,
                        const mpm::GridLayout& layout, double across, const Passes<T>& passes)
    : stage_(stage), layout_(layout), passes_(passes) {
  const std::vector<mpm::TractionTerm>& terms = stage.terms();
  if (terms.size() > kMost)
    throw GpuError(fmt::format("gpu: more than {} tractions at once: run it with --device cpu", kMost));
  std::size_t ids = 0;
  for (const mpm::ParticleSet& set : sets) {
    ids = std::max(ids, static_cast<std::size_t>(set.first_id) + static_cast<std::size_t>(set.size()));
  }
  std::vector<std::uint32_t> acts(ids);
  std::vector<std::uint8_t> awake(ids);
  for (const mpm::ParticleSet& set : sets) {
    for (int p = 0; p < set.awake(); ++p) awake[set.id[p]] = 1;
  }
  std::vector<int> faces;
  for (const mpm::TractionTerm& term : terms) {
    const mpm::ParticleSet& set = sets[static_cast<std::size_t>(term.set)];
    double area = across;
    for (int k = 0; k < layout.dim(); ++k) area *= k == term.face.axis ? 1.0 : 2.0 * set.half[k] * layout.cell(k);
    const std::uint32_t bit = 1U << areas_.size();
    double count = 0.0;
    for (const std::uint32_t particle : term.particles) {
      acts[set.first_id + particle] |= bit;
      count += awake[set.first_id + particle];
    }
    faces.push_back(2 * term.face.axis + (term.face.upper ? 1 : 0));
    areas_.push_back(area);
    counts_.push_back(count);
    titles_.push_back(fmt::format("traction on '{}'", set.name));
  }
  acts_.fit(static_cast<long>(acts.size()));
  acts_.upload(acts);
  face_.fit(static_cast<long>(faces.size()));
  face_.upload(faces);
  const std::size_t values = terms.size() * static_cast<std::size_t>(layout.dim());
  force_.fit(static_cast<long>(values));
  for (std::vector<double>* list : {&now_, &next_}) list->reserve(values);
}

template <class T>
void Tractions<T>::begin_step(double start, double dt) {
  next_.clear();
  mpm::Vec3 impulse = mpm::Vec3::Zero();
  for (std::size_t t = 0; t < areas_.size(); ++t) {
    for (int k = 0; k < layout_.dim(); ++k) {
      const int axis = layout_.axis(k);
      try {
        next_.push_back(areas_[t] * stage_.terms()[t].value[static_cast<std::size_t>(axis)](start + 0.5 * dt));
      } catch (const mpm::FunctionError& error) {
        throw mpm::LoadError(fmt::format("{}, along {}: {}", titles_[t], "xyz"[axis], error.what()));
      }
      impulse[axis] += counts_[t] * next_.back() * dt;
    }
  }
  given_.add(impulse);
  if (next_ == now_) return;
  now_.swap(next_);
  force_.upload(now_);
}

template <class T>
void Tractions<T>::act(Executor& run, const Step<T>& step, bool adds) {
  passes_.traction(run, step, {static_cast<long>(areas_.size()), acts_.data(), face_.data(), force_.data()}, adds);
}

template <class T>
void Tractions<T>::tell_modules(double work) {
  stage_.count(given_, work);
  given_ = {};
}

template class Tractions<double>;
template class Tractions<float>;

}  // namespace mpm_gpu
