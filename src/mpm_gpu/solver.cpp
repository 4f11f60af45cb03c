#include "mpm_gpu/solver.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>

namespace mpm_gpu {
namespace {

bool rubs(const GridView& grid, int dim) {
  return std::any_of(grid.faces, grid.faces + 2 * dim, [](Face face) { return face == Face::frictional; });
}
bool any_wall(const GridView& grid, int dim) {
  return std::any_of(grid.faces, grid.faces + 2 * dim, [](Face face) { return face != Face::open; });
}

}  // namespace

template <class T>
Solver<T>::Solver(const GridView& grid, int dim, const Method& method, std::vector<SetView> sets,
                  std::vector<LawOfSet> laws, ParticleStore<T> particles, Executor executor)
    : grid_(grid),
      dim_(dim),
      method_(method),
      sets_(std::move(sets)),
      store_(std::move(particles)),
      run_(executor),
      passes_(&mpm_gpu::passes(dim, method.shape, T())),
      cells_(grid, dim),
      holds_(dim, rubs(grid, dim) || (method.update == Update::usf && any_wall(grid, dim))),
      around_(grid, dim),
      held_rows_(rubs(grid, dim) ? dim : 1) {
  for (const LawOfSet& law : laws) {
    law_passes_.push_back(law_pass(dim, law.index, T()));
    rate_passes_.push_back(rate_pass(dim, law.index, T()));
    totals_passes_.push_back(totals_pass(dim, law.index, T()));
    average_passes_.push_back(average_pass(dim, law.index, T()));
    if (law_passes_.back() == nullptr) {
      throw GpuError("gpu: a law of a user's program does not run there: run the scene on the processor");
    }
    laws_.emplace_back().fit(static_cast<long>(law.bytes));
    laws_.back().upload(static_cast<const unsigned char*>(law.law), static_cast<long>(law.bytes));
  }
  sets_there_.fit(static_cast<long>(sets_.size()));
  sets_there_.upload(sets_);
  for (const SetView& set : sets_) count_ += set.count;
  for (int c = 0; c < dim * dim; ++c) gradient_[c].fit(count_);
  for (int k = 0; k < dim && strains_last(); ++k) next_x_[k].fit(count_);
  for (int k = 0; k < dim && passes_->domains != nullptr; ++k) domain_[k].fit(count_);
  node_.fit(count_);
  id_room_.fit(count_);
  fault_.fit(count_);
  taken_.fit(count_ * taken_numbers(method.counting, dim));
  place_room_.fit(count_);
  room_.fit(count_);
  of_particles_.fit(Executor::groups_of(count_));
  if (method.counting != Counting::nothing) of_counted_.fit(Executor::groups_of(count_));
  of_totals_.fit(Executor::groups_of(count_));
  of_faster_.fit(Executor::groups_of(count_));
  around_.fit(count_);
  const Impulses none;
  impulses_there_.fit(1);
  impulses_there_.upload(&none, 1);
  make_room();
}

template <class T>
void Solver<T>::make_room() {
  look();
  cells_.make_room(run_, places(), sets_);
  holds_.make_room(run_, cells_.room());
  mass_.fit(cells_.room());
  for (Buffer<double>& field : nodal_) field.fit(cells_.room() * dim_);
  held_.fit(cells_.room() * dim_ * held_rows_);
  if (held_rows_ > 1) left_.fit(cells_.room() * dim_);
  const bool increments = method_.order > 1 || method_.mixes;
  if (increments) increment_.fit(cells_.room() * dim_);
  if (increments || acts_again_) held_more_.fit(cells_.room() * dim_ * held_rows_);
  for (int end = 0; end < 2 && acts_again_; ++end) moved_[end].fit(cells_.room() * dim_);
  const bool averages = std::any_of(sets_.begin(), sets_.end(), [](const SetView& set) { return set.averages; });
  if (averages) averaged_.fit(cells_.room());
  of_nodes_.fit(Executor::groups_of(cells_.room()));
  for (auto& stage : stages_) stage->make_room(run_, cells_.room());
  must_sort_ = true;  // the table may have moved
}

template <class T>
void Solver<T>::add(std::unique_ptr<Stage<T>> stage) {
  stage->make_room(run_, cells_.room());
  stages_.push_back(std::move(stage));
}

template <class T>
void Solver<T>::let_walls_act_again() {
  acts_again_ = true;
  make_room();
}

template <class T>
void Solver<T>::sort(bool stay) {
  using Counts = CellTable::Counts;
  cells_.sort(run_, places(), sets_, stay ? Counts::room_for_all : Counts::waits_for);
  holds_.carry(run_, cells_.view(), stay);
  const std::uint32_t *order = cells_.order(), *node = cells_.node_of_particles();
  const auto permute = [&](auto& values, auto& room) {
    if (values.size() == 0) return;
    const auto* from = std::as_const(values).data();
    auto* to = room.data();
    run_.for_each("gpu: sort", count_, [=](long i) { to[i] = from[order[i]]; });
    run_.replace("gpu: sort", values, room, count_, stay);
  };
  for (auto& one : store_.x) permute(one, place_room_);
  for (auto& one : store_.v) permute(one, room_);
  for (auto& one : store_.f) permute(one, room_);
  for (auto& one : store_.tau) permute(one, room_);
  for (auto& one : store_.history) permute(one, room_);
  permute(store_.strain_before, place_room_);
  for (auto& one : store_.affine) permute(one, room_);
  permute(store_.mass, room_);
  permute(store_.surface, room_);
  permute(store_.id, id_room_);
  for (int k = 0; k < 3; ++k) permute(around_.turns(k), around_.room());
  std::uint32_t* to = node_.data();
  std::uint8_t* fault = fault_.data();
  run_.for_each("gpu: sort", count_, [=](long i) {
    to[i] = node[i];
    fault[i] = 0;  // each leads to a sort or ends the run
  });
  if (stay) {
    replayed_.sorted(run_, cells_.counts(), cells_.owners_room(), cells_.blocks_room());
  } else {
    ++sorts_;
  }
}

template <class T>
Step<T> Solver<T>::view(double dt) {
  Step<T> view{};
  view.grid = grid_;
  ParticleView<T>& particles = view.particles;
  particles.count = count_;
  for (int k = 0; k < 3; ++k) {
    particles.x[k] = store_.x[k].data();
    particles.next_x[k] = strains_last() ? next_x_[k].data() : particles.x[k];
    particles.v[k] = store_.v[k].data();
    particles.domain[k] = domain_[k].data();
  }
  for (int c = 0; c < 9; ++c) {
    particles.f[c] = store_.f[c].data();
    particles.affine[c] = store_.affine[c].data();
    particles.gradient[c] = gradient_[c].data();
  }
  for (int c = 0; c < 6; ++c) particles.tau[c] = store_.tau[c].data();
  for (int h = 0; h < kMostHistory; ++h) particles.history[h] = store_.history[h].data();
  particles.strain_before = store_.strain_before.data();
  particles.node = node_.data();
  particles.fault = fault_.data();
  particles.id = store_.id.data();
  particles.mass = store_.mass.data();
  particles.surface = store_.surface.data();
  particles.taken = taken_.data();
  view.nodes = cells_.view();
  view.nodes.mass = mass_.data();
  view.nodes.momentum = nodal_[0].data();
  view.nodes.velocity = nodal_[1].data();
  view.nodes.acceleration = nodal_[2].data();
  view.nodes.hold = holds_.data();
  view.nodes.increment = increment_.data();
  view.nodes.held_rows = held_rows_;
  view.nodes.held = held_.data();
  view.nodes.moved = moved_[0].data();
  view.nodes.held_more = held_more_.data();
  view.nodes.left = left_.data();
  view.nodes.averaged = averaged_.data();
  view.sets = sets_.data();
  view.sets_there = sets_there_.data();
  view.set_count = static_cast<int>(sets_.size());
  view.settings.dt = view.settings.strain_dt = dt;
  view.settings.flip = method_.flip;
  view.settings.from_start = method_.from_start;
  view.settings.terms = method_.terms;
  view.settings.increments = method_.order - 1;
  view.settings.part = 1.0;
  return view;
}

template <class T>
void Solver<T>::step(double dt, double start) {
  if (has_replayed_ != replays()) {
    look();
    has_replayed_ = !has_replayed_;
    if (has_replayed_) replayed_.begin(run_);
    recorded_dt_ = 0.0;
    must_sort_ = true;  // the table is another
  }
  if (has_replayed_) return replay(dt);
  if (must_sort_) sort(false);
  const Step<T> now = pass(dt, start, false);
  ++steps_;
  check(now, start);
  if (must_sort_ && around_.any()) {
    around_.put(run_, {store_.x[0].data(), store_.x[1].data(), store_.x[2].data()}, store_.mass.data(), sets_);
  }
}

template <class T>
Step<T> Solver<T>::pass(double dt, double start, bool stay) {
  Step<T> now = view(dt);
  for (auto& stage : stages_) stage->begin_step(run_, now, start, sorts_);
  const bool halves = method_.update == Update::usavg;
  if (passes_->domains != nullptr) passes_->domains(run_, now);
  momentum(now);
  average(now);
  act(mpm::Hook::momentum_gathered, now);
  if (method_.update == Update::usf || halves) {
    act(mpm::Hook::before_strain, now);
    strain(now, halves ? 0.5 * dt : dt);
  }
  act(mpm::Hook::forces_gathered, now);
  passes_->force[now.settings.driven](run_, now);
  act(mpm::Hook::momentum_updated, now);
  filter(now);
  act(mpm::Hook::grid_advanced, now);
  passes_->move[method_.motion][static_cast<int>(counting(now.settings))](run_, now);
  if (strains_last()) {
    Step<T> at_end = now;
    at_end.nodes.moved = moved_[1].data();
    at_end.nodes.momentum = now.nodes.acceleration;  // not needed any more; accounts need the momentum of the start
    momentum(at_end);
    act(mpm::Hook::before_strain, at_end);
    strain(now, halves ? 0.5 * dt : dt);
    for (int k = 0; k < dim_; ++k) run_.replace("gpu: velocity and place", store_.x[k], next_x_[k], count_, stay);
  }
  dim_ == 3 ? account<3>(dt) : account<2>(dt);
  return now;
}

template <class T>
bool Solver<T>::replays() const {
  const auto repeats = [](const auto& stage) { return stage->repeats(); };
  return may_replay_ && std::all_of(stages_.begin(), stages_.end(), repeats) && !around_.any() && count_ > 0 &&
         card::can_record();
}

template <class T>
void Solver<T>::replay(double dt) {
  if (must_sort_) sort(true);
  must_sort_ = false;
  if (dt != recorded_dt_ || cells_.generation() != recorded_generation_) {
    recording_ = run_.record([&] {
      replayed_.where_to_sort(run_, [&] { sort(true); });
      replayed_.where_it_goes_on(run_, [&] {
        const Counting counted = counting(pass(dt, 0.0, true).settings);
        sum_checks(counted);
        const bool counts = counted != Counting::nothing;
        replayed_.stepped(run_, counts ? &of_counted_.data()->faults : of_particles_.data(),
                          counts ? &of_counted_.data()->taken : nullptr, store_.id.data(),
                          {store_.x[0].data(), store_.x[1].data(), store_.x[2].data()});
      });
    });
    recorded_dt_ = dt;
    recorded_generation_ = cells_.generation();
  }
  run_.replay(recording_);
  counted_ = true;
  looked_ = false;
}

template <class T>
void Solver<T>::look() {
  if (looked_) return;
  const ReplayedSteps::Numbers numbers = replayed_.look(run_);
  looked_ = true;
  steps_ += numbers.steps;
  sorts_ += numbers.sorts;
  for (auto& stage : stages_) stage->count(numbers.taken);
  if (numbers.failure == ReplayedSteps::kNoRoom) cells_.require_room(numbers.owners, numbers.blocks);
  if (numbers.failure != 0) fail(numbers.failure, numbers.id, numbers.place, steps_ + 1);
}

template <class T>
void Solver<T>::fail(std::uint32_t fault, std::uint32_t id, const double* along, long step) const {
  std::string place;
  for (int k = 0; k < dim_; ++k) place += fmt::format("{}{:.6g}", k == 0 ? "" : ", ", along[k]);
  throw GpuError(
      fmt::format("gpu: particle {} at ({}) m {} in step {}: shorten the time step", id, place,
                  fault == kInverted ? "is turned inside out (J <= 0)" : "is outside the domain or not finite", step));
}

template <class T>
Counting Solver<T>::counting(const StepSettings& settings) const {
  if (settings.damped) return Counting::damping;
  const bool slips = method_.motion == mpm_kernel::kIncrement && settings.flip != 1.0;
  return slips && method_.counting != Counting::nothing ? Counting::slip : Counting::nothing;
}

template <class T>
void Solver<T>::average(const Step<T>& now) {
  for (std::size_t s = 0; s < sets_.size(); ++s) {
    if (!sets_[s].averages) continue;
    average_passes_[s](run_, now, static_cast<int>(s), laws_[s].data());
  }
}

template <class T>
void Solver<T>::strain(Step<T> now, double dt) {
  now.settings.strain_dt = dt;
  passes_->gradient(run_, now);
  for (std::size_t s = 0; s < sets_.size(); ++s) law_passes_[s](run_, now, static_cast<int>(s), laws_[s].data());
}

template <class T>
void Solver<T>::filter(Step<T> now) {
  if (now.settings.increments == 0) return;
  passes_->first_increment[method_.mixes](run_, now);
  act(mpm::Hook::velocity_found, now);
  for (int n = 0; n < now.settings.increments; ++n) {
    passes_->to_particles(run_, now);
    passes_->increment[method_.mixes](run_, now);
    act(mpm::Hook::increment_found, now);
    now.settings.part = 1.0;  // the next one is found from that part
  }
}

template <class T>
template <int Dim>
void Solver<T>::account(double dt) {
  constexpr double kStrainAtStart[] = {1.0, 0.0, 0.5, 0.0};  // in the order of Update
  const WallAccount<Dim> walls{grid_,
                               view(dt).nodes,
                               strains_last() ? nodal_[2].data() : nullptr,
                               moved_[1].data(),
                               dt,
                               kStrainAtStart[static_cast<int>(method_.update)]};
  if (walls.nodes.nodes == 0) return;  // all is asleep
  run_.reduce_there<SumsOfNodes>(
      "gpu: accounts", walls.nodes.nodes,
      [=](long i) {
        return SumsOfNode<Dim>{&walls, i, walls.nodes.mass[i] > walls.grid.least_mass};
      },
      of_nodes_);
  AddImpulses<Dim> add{of_nodes_.data(), impulses_there_.data(), {}, dt};
  for (int c = 0; c < Dim; ++c) add.gravity[c] = grid_.gravity[c];
  run_.for_each("gpu: accounts", 1, add);
  counted_ = true;
}

template <class T>
Impulses& Solver<T>::impulses() {
  look();
  if (!std::exchange(counted_, false)) return impulses_;
  impulses_ += impulses_there_.get(0);
  const Impulses none;
  impulses_there_.upload(&none, 1);
  return impulses_;
}

template <class T>
void Solver<T>::sum_checks(Counting counted) {
  const std::uint8_t* fault = fault_.data();
  const auto faults_of = [=](long i) { return Faults::of(fault[i], i); };
  if (counted == Counting::nothing) {
    run_.reduce_there("gpu: checks", count_, faults_of, of_particles_);
    return;
  }
  const double* taken = taken_.data();
  const int dim = dim_;
  const long count = count_;
  run_.reduce_there(
      "gpu: checks", count,
      [=](long i) {
        return OfCounted{faults_of(i), taken_by(taken, counted, dim, count, i)};
      },
      of_counted_);
}

template <class T>
void Solver<T>::check(const Step<T>& now, double start) {
  OfCounted sums;
  Faults& all = sums.faults;
  const Counting counted = counting(now.settings);
  if (count_ > 0) {
    sum_checks(counted);
    if (counted == Counting::nothing) {
      all = of_particles_.get(0);
    } else {
      sums = of_counted_.get(0);
    }
  }
  must_sort_ = all.left;
  const auto fail_by = [&](std::uint32_t fault, std::uint32_t p) {
    double place[3] = {};
    for (int k = 0; k < dim_; ++k) place[k] = store_.x[k].get(p);
    fail(fault, store_.id.get(p), place, steps_);
  };
  if (all.inverted != Faults::kNone) fail_by(kInverted, all.inverted);
  if (all.outside != Faults::kNone) {
    must_sort_ = true;
    const Step<T> ended = view(now.settings.dt);  // places have been swapped
    const auto puts_back = [&](auto& stage) { return stage->put_back(run_, ended); };
    if (std::any_of(stages_.begin(), stages_.end(), puts_back)) all.outside = Faults::kNone;
  }
  if (all.outside != Faults::kNone) fail_by(kOutside, all.outside);
  for (auto& stage : stages_) stage->end_step(run_, now, start, sums.taken);
}

template class Solver<double>;
template class Solver<float>;

}  // namespace mpm_gpu
