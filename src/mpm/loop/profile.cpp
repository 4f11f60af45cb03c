#include "mpm/loop/profile.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace mpm {
namespace {

thread_local TimeProfile* in_use = nullptr;

}  // namespace

TimeProfile* TimeProfile::current() { return in_use; }

TimeProfile::Use::Use(TimeProfile* profile) : before_(std::exchange(in_use, profile)) {}

TimeProfile::Use::~Use() { in_use = before_; }

void TimeProfile::begin(const std::string& name) {
  const auto found = std::find_if(rows_.begin(), rows_.end(), [&](const Row& row) { return row.name == name; });
  const auto row = static_cast<std::size_t>(found - rows_.begin());
  if (found == rows_.end()) rows_.push_back({name, 0.0, 0});
  if (open_.empty() || open_.back().row != row) ++rows_[row].calls;
  open_.push_back({row, Clock::now()});
}

void TimeProfile::end() {
  const Open ended = open_.back();
  open_.pop_back();
  const double seconds = std::chrono::duration<double>(Clock::now() - ended.since).count();
  rows_[ended.row].seconds += seconds - ended.within;
  if (!open_.empty()) open_.back().within += seconds;
}

double TimeProfile::seconds() const {
  double sum = 0.0;
  for (const Row& row : rows_) sum += row.seconds;
  return sum;
}

std::string TimeProfile::table(double whole) const {
  std::vector<Row> rows = rows_;
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.seconds > b.seconds; });
  rows.push_back({"else", std::max(whole - seconds(), 0.0), 1});
  std::string text = fmt::format("{:<44}{:>10}{:>8}{:>10}\n", "part", "seconds", "share", "calls");
  for (const Row& row : rows) {
    text += fmt::format("{:<44}{:>10.4f}{:>6.1f} %{:>10}\n", row.name, row.seconds,
                        whole > 0.0 ? 100.0 * row.seconds / whole : 0.0, row.calls);
  }
  return text;
}

}  // namespace mpm
