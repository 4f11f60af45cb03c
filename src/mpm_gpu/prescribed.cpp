#include "mpm_gpu/prescribed.hpp"

#include <utility>

namespace mpm_gpu {
namespace {

template <class Number>
void upload(Buffer<Number>& to, const std::vector<Number>& from) {
  to.grow(static_cast<long>(from.size()));
  to.upload(from);
}

}  // namespace

template <class T>
Prescribed<T>::Prescribed(mpm::VelocityConditions* conditions, const std::vector<mpm::ConditionDefinition>& definitions,
                          const mpm::GridLayout& layout, const Passes<T>& passes)
    : own_(conditions != nullptr
               ? nullptr
               : std::make_unique<mpm::VelocityConditions>(definitions, std::vector<mpm::HeldFace>{}, layout)),
      conditions_(conditions != nullptr ? *conditions : *own_),
      layout_(layout),
      passes_(passes),
      impulse_(static_cast<std::size_t>(conditions_.count())) {}

template <class T>
void Prescribed<T>::make_room(Executor&, long nodes) {
  const long blocks = nodes / layout_.nodes_per_block();
  key_.fit(blocks);
  keys_.reserve(static_cast<std::size_t>(blocks));
  blocks_.reserve(static_cast<std::size_t>(blocks));
  sorts_ = -1;
}

template <class T>
void Prescribed<T>::begin_step(Executor& run, Step<T>& step, double start, long sorts) {
  moved_ = false;
  conditions_.begin_step(start, step.settings.dt);
  const bool sorted = sorts != std::exchange(sorts_, sorts);
  if (sorted) find_blocks(run, step);
  const bool found = sorted || conditions_.moving();
  if (found) conditions_.find_nodes(blocks_);
  if (found || conditions_.changing()) conditions_.find_velocities(start, step.settings.dt);
  if (found) upload_nodes();
  if (found || conditions_.changing()) upload_velocities();
}

template <class T>
void Prescribed<T>::find_blocks(Executor& run, const Step<T>& step) {
  copy_keys(run, step.nodes, key_.data());
  keys_.resize(static_cast<std::size_t>(step.nodes.blocks));
  key_.download(keys_.data(), step.nodes.blocks);
  blocks_.clear();
  for (const std::uint64_t key : keys_) blocks_.push_back(host_block(step.grid, layout_.dim(), key));
}

template <class T>
void Prescribed<T>::upload_nodes() {
  const std::vector<mpm::VelocityConditions::Held>& held = conditions_.held();
  const std::vector<mpm::VelocityConditions::Part>& parts = conditions_.parts();
  node_here_.clear();
  first_here_.clear();
  direction_here_.clear();
  for (std::size_t e = 0; e < held.size(); ++e) {
    if (e == 0 || !(held[e].ref == held[e - 1].ref)) {
      node_here_.push_back(
          static_cast<std::uint32_t>(held[e].ref.block * layout_.nodes_per_block() + held[e].ref.node));
      first_here_.push_back(static_cast<std::uint32_t>(e));
    }
    for (int k = 0; k < layout_.dim(); ++k) direction_here_.push_back(held[e].direction[layout_.axis(k)]);
  }
  first_here_.push_back(static_cast<std::uint32_t>(held.size()));
  nodes_ = static_cast<long>(node_here_.size());
  entries_ = static_cast<long>(held.size());
  entry_here_.clear();
  factor_here_.clear();
  begin_.assign(1, 0);
  for (int c = 0; c < conditions_.count(); ++c) {
    for (std::size_t e = 0; e < held.size(); ++e) {
      for (int i = held[e].first; i < held[e].first + held[e].count; ++i) {
        const mpm::VelocityConditions::Part& part = parts[static_cast<std::size_t>(i)];
        if (part.condition != c) continue;
        entry_here_.push_back(static_cast<std::uint32_t>(e));
        factor_here_.push_back(part.sign / held[e].count);
      }
    }
    begin_.push_back(static_cast<long>(entry_here_.size()));
    impulse_[static_cast<std::size_t>(c)].make_room(begin_.back() - begin_[static_cast<std::size_t>(c)]);
  }
  upload(node_, node_here_);
  upload(first_, first_here_);
  upload(direction_, direction_here_);
  upload(entry_, entry_here_);
  upload(factor_, factor_here_);
  for (Buffer<double>* room : {&given_, &work_}) room->grow(entries_);
  share_.grow(begin_.back());
  works_.make_room(entries_);
}

template <class T>
void Prescribed<T>::upload_velocities() {
  start_here_.clear();
  end_here_.clear();
  for (const mpm::VelocityConditions::Held& held : conditions_.held()) {
    start_here_.push_back(held.start);
    end_here_.push_back(held.end);
  }
  upload(start_, start_here_);
  upload(end_, end_here_);
}

template <class T>
HeldView Prescribed<T>::view() {
  return {nodes_, entries_, node_.data(), first_.data(), direction_.data(), start_.data(), end_.data(), given_.data()};
}

template <class T>
void Prescribed<T>::act(mpm::Hook hook, Executor& run, const Step<T>& step) {
  const auto hold = [&](HeldPart part) { passes_.hold(run, step, view(), part); };
  switch (hook) {
    case mpm::Hook::before_strain:
      return hold(moved_ ? HeldPart::strain_at_end : HeldPart::strain_at_start);
    case mpm::Hook::momentum_updated:
      moved_ = true;
      return hold(HeldPart::motion);
    case mpm::Hook::velocity_found:
      return hold(HeldPart::first_increment);
    case mpm::Hook::increment_found:
      return hold(HeldPart::increment);
    case mpm::Hook::grid_advanced:
      add_up(run);
      return conditions_.end_step(step.settings.dt);
    default:
      return;
  }
}

template <class T>
void Prescribed<T>::add_up(Executor& run) {
  const HeldView held = view();
  find_held_work(run, held, work_.data());
  works_.add(run, "gpu: accounts", work_.data(), entries_, 1);
  find_held_shares(run, held, entry_.data(), factor_.data(), share_.data(), begin_.back());
  for (std::size_t c = 0; c < impulse_.size(); ++c) {
    impulse_[c].add(run, "gpu: accounts", share_.data() + begin_[c], begin_[c + 1] - begin_[c], 1);
  }
}

template <class T>
void Prescribed<T>::tell_modules() {
  for (std::size_t c = 0; c < impulse_.size(); ++c) {
    const Total::Sum given = impulse_[c].take();
    conditions_.count(static_cast<int>(c), given.of[0], given.exchanged);
  }
  conditions_.count_work(works_.take().of[0]);
}

template <class T>
std::size_t Prescribed<T>::bytes() const {
  std::size_t sum = key_.bytes() + node_.bytes() + first_.bytes() + entry_.bytes() + works_.bytes();
  for (const auto* one : {&direction_, &start_, &end_, &given_, &work_, &factor_, &share_}) sum += one->bytes();
  for (const Total& one : impulse_) sum += one.bytes();
  return sum;
}

template class Prescribed<double>;
template class Prescribed<float>;

}  // namespace mpm_gpu
