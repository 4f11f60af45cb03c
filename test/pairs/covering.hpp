// Covering arrays of strength 2: few rows of choices, in which each allowed pair of choices of two factors stands at
// least once. Found greedily, row by row, as in AETG (Cohen, Dalal, Fredman & Patton 1997, IEEE Trans. Softw. Eng. 23).
// Weak: some rows more than the least number.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace mpm::pairs {

/// Number of the choice of each factor; 0 is the plain one.
using Row = std::vector<int>;

/// Pairs of choices that are allowed, and rows that hold them all.
class Covering {
 public:
  /// `choices`: of each factor. `allowed`: whether a row may be; it is asked for rows with one and two choices that are
  /// not plain, and for those that are put together from allowed pairs. `only`: a factor; pairs that are to be covered
  /// are those of its choices that are not plain. Without it all are.
  Covering(const std::vector<int>& choices, const std::function<bool(const Row&)>& allowed, int only = -1)
      : choices_(choices), allowed_(allowed) {
    for (const int own : choices_) {
      first_.push_back(all_);
      all_ += own;
    }
    state_.assign(static_cast<std::size_t>(all_) * all_, kRefused);
    each_pair([&](int a, int i, int b, int j) {
      Row row(choices_.size(), 0);
      row[a] = i;
      row[b] = j;
      const bool goes = allowed_(row);
      const bool counts = only < 0 || (a == only && i > 0) || (b == only && j > 0);
      set(a, i, b, j, !goes ? kRefused : counts ? kOpen : kCovered);
      if (counts) ++(goes ? together_ : refused_);
    });
    each_pair([&](int a, int i, int b, int j) {
      if (at(a, i, b, j) == kOpen) begin_row(a, i, b, j);
    });
  }

  const std::vector<Row>& rows() const { return rows_; }
  int together() const { return together_; }  ///< number of pairs that are allowed, of those to be covered
  int refused() const { return refused_; }
  /// visit(a, i, b, j): pairs that are allowed, but in no row that is.
  template <class Visit>
  void each_left(Visit&& visit) const {
    each_pair([&](int a, int i, int b, int j) {
      if (at(a, i, b, j) == kOpen) visit(a, i, b, j);
    });
  }

 private:
  enum State : unsigned char { kRefused, kOpen, kCovered };

  template <class Visit>
  void each_pair(Visit&& visit) const {
    const int factors = static_cast<int>(choices_.size());
    for (int a = 0; a < factors; ++a) {
      for (int b = a + 1; b < factors; ++b) {
        for (int i = 0; i < choices_[a]; ++i) {
          for (int j = 0; j < choices_[b]; ++j) visit(a, i, b, j);
        }
      }
    }
  }
  State at(int a, int i, int b, int j) const {
    return state_[static_cast<std::size_t>(first_[a] + i) * all_ + first_[b] + j];
  }
  void set(int a, int i, int b, int j, State state) {
    state_[static_cast<std::size_t>(first_[a] + i) * all_ + first_[b] + j] = state;
    state_[static_cast<std::size_t>(first_[b] + j) * all_ + first_[a] + i] = state;
  }

  /// Adds a row that holds the pair, and as many open pairs as choices taken one factor after another get.
  void begin_row(int a, int i, int b, int j) {
    Row row(choices_.size(), 0);
    row[a] = i;
    row[b] = j;
    std::vector<bool> chosen(choices_.size(), false);
    chosen[a] = chosen[b] = true;
    // Each row begins with another factor, so that none is always the last that may choose.
    const int factors = static_cast<int>(choices_.size());
    for (int k = 0; k < factors; ++k) {
      const int factor = (k + static_cast<int>(rows_.size())) % factors;
      if (chosen[factor]) continue;
      row[factor] = best_choice(row, chosen, factor);
      chosen[factor] = true;
    }
    int found = 0;
    for (int c = 0; c < factors; ++c) {
      for (int d = c + 1; d < factors; ++d) {
        if (at(c, row[c], d, row[d]) != kOpen) continue;
        set(c, row[c], d, row[d], kCovered);
        ++found;
      }
    }
    if (found > 0) rows_.push_back(row);
  }

  int best_choice(Row& row, const std::vector<bool>& chosen, int factor) const {
    std::vector<std::pair<int, int>> gains;  // (pairs gained, choice), of those that go with what is chosen
    for (int choice = 0; choice < choices_[factor]; ++choice) {
      int gain = 0;
      bool goes = true;
      for (std::size_t other = 0; other < chosen.size() && goes; ++other) {
        if (!chosen[other]) continue;
        const State state = at(factor, choice, static_cast<int>(other), row[other]);
        goes = state != kRefused;
        gain += state == kOpen ? 1 : 0;
      }
      if (goes) gains.push_back({-gain, choice});
    }
    std::sort(gains.begin(), gains.end());
    for (const auto& [gain, choice] : gains) {
      row[factor] = choice;
      if (allowed_(row)) return choice;
    }
    return 0;
  }

  std::vector<int> choices_, first_;
  std::function<bool(const Row&)> allowed_;
  int all_ = 0, together_ = 0, refused_ = 0;
  std::vector<State> state_;
  std::vector<Row> rows_;
};

}  // namespace mpm::pairs
