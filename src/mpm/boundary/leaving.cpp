#include "mpm/boundary/leaving.hpp"

#include <fmt/core.h>

#include <cmath>

#include "mpm/ranks/lists.hpp"

namespace mpm {

Leaving::Returned Leaving::put_back_own() {
  constexpr double kInside = 1e-3;  // part of a cell by which a particle is put inside the edge
  Returned returned;
  for (ParticleSet& set : sets_) {
    for (int p = 0; p < set.size(); ++p) {
      bool outside = false;
      for (int k = 0; k < layout_.dim(); ++k) {
        const double cells = layout_.in_cells(k, set.x[k][p]);
        if (cells >= set.lowest[k] && cells <= set.highest[k]) continue;
        if (!std::isfinite(cells) || !std::isfinite(set.v[k][p])) {
          returned.all = false;
          return returned;
        }
        outside = true;
        const double side = cells < set.lowest[k] ? -1.0 : 1.0;
        const double inside = side < 0.0 ? set.lowest[k] + kInside : set.highest[k] - kInside;
        set.x[k][p] = layout_.origin(k) + inside * layout_.cell(k);
        const double outward = side * set.v[k][p];
        if (!(outward > 0.0)) continue;
        returned.given[layout_.axis(k)] -= side * outward * set.mass_of(p);
        set.v[k].set(p, 0.0);
        returned.taken += 0.5 * set.mass_of(p) * outward * outward;
      }
      if (!outside || has_left(set.id[p])) continue;
      returned.first.push_back(set.id[p]);
      returned.all = count_ + returned.first.size() <= limit_;
      if (!returned.all) return returned;
    }
  }
  return returned;
}

void Leaving::share(Returned& returned) {
  returned.first = gather_list(*ranks_, returned.first);
  returned.all = !ranks_->any(!returned.all) && count_ + returned.first.size() <= limit_;
  ranks_->sum(returned.given.data(), 3);
  returned.taken = ranks_->sum(returned.taken);
}

bool Leaving::put_back() {
  Returned returned = put_back_own();
  if (ranks_ != nullptr) share(returned);
  for (const std::uint32_t id : returned.first) {
    if (left_.size() <= id) left_.resize(id + 1, 0);
    left_[id] = 1;
  }
  count_ += returned.first.size();
  account_.add(returned.given);
  taken_ += returned.taken;
  return returned.all;
}

bool Leaving::count(const std::vector<std::uint32_t>& ids, const Vec3& given, double taken) {
  for (const std::uint32_t id : ids) {
    if (has_left(id)) continue;
    if (left_.size() <= id) left_.resize(id + 1, 0);
    left_[id] = 1;
    ++count_;
  }
  account_.add(given);
  taken_ += taken;
  return count_ <= limit_;
}

std::optional<OutsideReason> Leaving::why_outside(const GridLayout&, const ParticleSet&, int) const {
  if (count_ <= limit_) return std::nullopt;
  return too_many();
}

OutsideReason Leaving::too_many() const {
  return {fmt::format("more than {} particles have left the grid (grid.leave.limit)", limit_),
          "enlarge grid.min/grid.max, close that face with a wall in 'boundaries', raise the limit, or lower "
          "time.cfl if the run blew up"};
}

}  // namespace mpm
