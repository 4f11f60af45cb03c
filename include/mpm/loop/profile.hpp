// Wall time of a run by the names of what works: loops (loop/loop.hpp), modules, sorting, output. A part that is begun
// within another is taken off it, so that the rows add up to the whole.
//
// A profile is that of a thread, the one that steps, while it is in use there; without one a part costs a call. What
// that thread waits for others in a parallel loop counts with the loop.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace mpm {

class TimeProfile {
 public:
  struct Row {
    std::string name;
    double seconds = 0.0;     ///< without parts that were begun within
    std::uint64_t calls = 0;  ///< without those from a part of the same name
  };

  /// Makes `profile`, which may be null, that of this thread, from its construction to its end.
  class Use {
   public:
    explicit Use(TimeProfile* profile);
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;
    ~Use();

   private:
    TimeProfile* before_;
  };

  /// A part, from its construction to its end.
  class Part {
   public:
    /// `name`: of a row, a new one or one that is there; or a function that returns it, which is asked with a profile
    /// alone.
    template <class Name>
    explicit Part(const Name& name) : profile_(current()) {
      if (profile_ == nullptr) return;
      if constexpr (std::is_invocable_v<Name>) {
        profile_->begin(name());
      } else {
        profile_->begin(name);
      }
    }
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    ~Part() {
      if (profile_ != nullptr) profile_->end();
    }

   private:
    TimeProfile* profile_;
  };

  /// In the order in which they were first begun.
  const std::vector<Row>& rows() const { return rows_; }
  /// Time of all rows [s].
  double seconds() const;
  /// Table of name, seconds, share of `whole` [s] and calls, the longest first; what no row has comes last.
  std::string table(double whole) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Open {
    std::size_t row;
    Clock::time_point since;
    double within = 0.0;  ///< time of parts that were begun and have ended within [s]
  };
  /// Profile in use on this thread, or null.
  static TimeProfile* current();
  void begin(const std::string& name);
  void end();

  std::vector<Row> rows_;
  std::vector<Open> open_;
};

/// Does `work` as a part of the profile in use, if there is one.
template <class Work>
decltype(auto) timed(const char* name, Work&& work) {
  const TimeProfile::Part part(name);
  return work();
}

}  // namespace mpm
