#include "thread_communicator.hpp"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace mpm {
namespace {

/// Thrown where others will not come any more.
struct Released {};

/// Place where ranks show each other what they have.
class Meeting {
 public:
  explicit Meeting(int size) : shown_(static_cast<std::size_t>(size)) {}

  int size() const { return static_cast<int>(shown_.size()); }
  /// read(rank, data) for all ranks, when all have come; `data` is what that rank has shown. Returns when all have
  /// read.
  template <class Read>
  void show(int rank, const std::string& call, const void* data, Read&& read) {
    shown_[static_cast<std::size_t>(rank)] = {call, data};
    wait();
    for (const Shown& other : shown_) {
      if (other.call != call) throw RanksError("ranks call '" + call + "' and '" + other.call + "' at the same time");
    }
    for (int from = 0; from < size(); ++from) read(from, shown_[static_cast<std::size_t>(from)].data);
    wait();
  }
  /// A rank that comes no more.
  void leave() {
    const std::lock_guard<std::mutex> lock(mutex_);
    left_ = true;
    changed_.notify_all();
  }

 private:
  struct Shown {
    std::string call;
    const void* data = nullptr;
  };

  void wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::uint64_t turn = turn_;
    if (++arrived_ == size()) {
      arrived_ = 0;
      ++turn_;
      changed_.notify_all();
      return;
    }
    changed_.wait(lock, [&] { return turn_ != turn || left_; });
    if (turn_ == turn) throw Released();
  }

  std::vector<Shown> shown_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int arrived_ = 0;
  std::uint64_t turn_ = 0;
  bool left_ = false;
};

class ThreadCopies final : public Communicator::Copies {
 public:
  ThreadCopies(Meeting& meeting, int rank, int plan, std::vector<Communicator::Source> sources)
      : meeting_(meeting), rank_(rank), plan_(plan), sources_(std::move(sources)) {}

  void begin(const double* from, double* to, int numbers) override {
    if (begun_) throw RanksError("copies begin again before they have ended");
    begun_ = true;
    from_ = from;
    to_ = to;
    numbers_ = numbers;
    // Whoever reads them before end() sees it.
    std::fill_n(to, sources_.size() * numbers, std::numeric_limits<double>::quiet_NaN());
  }
  void end(const double* from, double* to, int numbers) override {
    if (!begun_ || from != from_ || to != to_ || numbers != numbers_) {
      throw RanksError("copies end with other arguments than they began with");
    }
    begun_ = false;
    const std::string call = "copies " + std::to_string(plan_) + " of " + std::to_string(numbers);
    meeting_.show(rank_, call, from, [&](int rank, const void* data) {
      const auto* rows = static_cast<const double*>(data);
      for (std::size_t i = 0; i < sources_.size(); ++i) {
        if (sources_[i].rank == rank) std::copy_n(rows + sources_[i].row * numbers, numbers, to + i * numbers);
      }
    });
  }

 private:
  Meeting& meeting_;
  const int rank_, plan_;
  const std::vector<Communicator::Source> sources_;
  bool begun_ = false;
  const double* from_ = nullptr;
  const double* to_ = nullptr;
  int numbers_ = 0;
};

class ThreadCommunicator final : public Communicator {
 public:
  ThreadCommunicator(Meeting& meeting, int rank) : meeting_(meeting), rank_(rank) {}

  int rank() const override { return rank_; }
  int size() const override { return meeting_.size(); }

  void sum(double* numbers, int count) override {
    std::vector<double> totals(static_cast<std::size_t>(count), 0.0);
    meeting_.show(rank_, "sum of " + std::to_string(count), numbers, [&](int, const void* data) {
      for (int i = 0; i < count; ++i) totals[i] += static_cast<const double*>(data)[i];
    });
    std::copy(totals.begin(), totals.end(), numbers);
  }

  void largest(double* numbers, int count) override {
    std::vector<double> most(static_cast<std::size_t>(count), -std::numeric_limits<double>::infinity());
    meeting_.show(rank_, "largest of " + std::to_string(count), numbers, [&](int, const void* data) {
      for (int i = 0; i < count; ++i) {
        const double number = static_cast<const double*>(data)[i];
        if (std::isnan(number) || number > most[i]) most[i] = number;  // nothing is above what is not a number
      }
    });
    std::copy(most.begin(), most.end(), numbers);
  }

  std::vector<Bytes> gather(const Bytes& own) override {
    std::vector<Bytes> all;
    meeting_.show(rank_, "gather", &own,
                  [&](int, const void* data) { all.push_back(*static_cast<const Bytes*>(data)); });
    return all;
  }

  std::vector<Parcel> deliver(const std::vector<Parcel>& parcels) override {
    std::vector<int> to;
    for (const Parcel& parcel : parcels) to.push_back(parcel.rank);
    std::sort(to.begin(), to.end());
    if (std::adjacent_find(to.begin(), to.end()) != to.end() || std::binary_search(to.begin(), to.end(), rank_) ||
        (!to.empty() && (to.front() < 0 || to.back() >= size()))) {
      throw RanksError("parcels go to other ranks, one to each at most");
    }
    std::vector<Parcel> arrived;
    meeting_.show(rank_, "deliver", &parcels, [&](int from, const void* data) {
      for (const Parcel& parcel : *static_cast<const std::vector<Parcel>*>(data)) {
        if (parcel.rank == rank_) arrived.push_back({from, parcel.bytes});
      }
    });
    return arrived;
  }

  void place(const std::vector<double>& own, const std::vector<std::uint64_t>& places, double* to,
             std::size_t size) override {
    if (own.size() != places.size()) throw RanksError("place: not as many places as values");
    const std::pair<const std::vector<double>&, const std::vector<std::uint64_t>&> both(own, places);
    bool beyond = false;
    meeting_.show(rank_, "place", &both, [&](int, const void* data) {
      const auto& [values, at] = *static_cast<const decltype(both)*>(data);
      for (std::size_t i = 0; i < at.size() && first(); ++i) {
        beyond = beyond || at[i] >= size;
        if (at[i] < size) to[at[i]] = values[i];
      }
    });
    if (beyond) throw RanksError("place: a place beyond the end");
  }

  std::unique_ptr<Copies> make_copies(int rows, const std::vector<Source>& sources) override {
    std::vector<int> all;
    meeting_.show(rank_, "make_copies", &rows,
                  [&](int, const void* data) { all.push_back(*static_cast<const int*>(data)); });
    for (const Source& source : sources) {
      if (source.row < 0 || source.row >= all.at(static_cast<std::size_t>(source.rank))) {
        throw RanksError("copies of a row that is not there");
      }
    }
    return std::make_unique<ThreadCopies>(meeting_, rank_, plans_++, sources);
  }

 private:
  Meeting& meeting_;
  const int rank_;
  int plans_ = 0;
};

}  // namespace

void run_ranks(int count, const std::function<void(Communicator&)>& work) {
  Meeting meeting(count);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(count));
  std::vector<char> released(errors.size(), 0);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank) {
    threads.emplace_back([&, rank] {
      try {
        ThreadCommunicator ranks(meeting, rank);
        work(ranks);
      } catch (const Released&) {
        released[rank] = 1;
      } catch (...) {
        errors[rank] = std::current_exception();
      }
      meeting.leave();
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
  if (std::find(released.begin(), released.end(), 1) != released.end()) {
    throw RanksError("a rank has ended while others wait for it");
  }
}

}  // namespace mpm
