// The processes that compute one run together, each with a part of its material, and what they tell each other. In the
// words of MPI each of them is a rank.
//
// Every function is collective: all ranks call it, in the same order. What is summed is summed in the order of ranks,
// so all ranks get the same bits, and a run on as many ranks as before repeats to the bit. The library knows this
// interface alone; mpm_ranks/petsc_communicator.hpp, which only a build with MPI has, implements it on PETSc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "mpm/math/error.hpp"

namespace mpm {

/// A run that cannot be computed on several ranks, or ranks that cannot go on together. what() says why.
class RanksError : public Error {
 public:
  using Error::Error;
};

class Communicator {
 public:
  using Bytes = std::vector<std::byte>;
  /// Data that one rank sends to another.
  struct Parcel {
    int rank;  ///< to whom, or from whom
    Bytes bytes;
  };
  /// A row of numbers that another rank has.
  struct Source {
    int rank;
    int row;  ///< in that rank's array
  };
  /// Copies of rows of other ranks, made again and again by one plan.
  class Copies {
   public:
    virtual ~Copies() = default;
    /// Begins to copy rows of `numbers` doubles: the sources' rows of each rank's `from` into `to`, one after another.
    /// Neither these rows nor `to` may be changed before end(), which gets the same arguments.
    virtual void begin(const double* from, double* to, int numbers) = 0;
    virtual void end(const double* from, double* to, int numbers) = 0;
  };

  virtual ~Communicator() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Number of ranks that share this one's machine, and so its memory, it among them.
  virtual int on_this_machine() const { return size(); }
  bool first() const { return rank() == 0; }

  /// Replaces each of `count` numbers by its sum over all ranks.
  virtual void sum(double* numbers, int count) = 0;
  /// Replaces each of `count` numbers by the largest of all ranks; not a number if it is not a number on any.
  virtual void largest(double* numbers, int count) = 0;
  /// Returns what each rank gives, by rank, on all ranks.
  virtual std::vector<Bytes> gather(const Bytes& own) = 0;
  /// Returns what the first rank gives; of the others nothing is read. They may have to wait for long, until somebody
  /// asks the first one for something, and leave their processors to others meanwhile.
  virtual Bytes of_first(const Bytes& own) { return gather(first() ? own : Bytes()).front(); }
  /// Hands over parcels to other ranks. Returns those for this rank, in the order of the senders.
  virtual std::vector<Parcel> deliver(const std::vector<Parcel>& parcels) = 0;
  /// On the first rank to[places[i]] becomes own[i] of every rank; `to` is not read on the others.
  virtual void place(const std::vector<double>& own, const std::vector<std::uint64_t>& places, double* to,
                     std::size_t size) = 0;
  /// `rows`: how many rows this rank's arrays have; `sources`: the rows that it wants to have copies of.
  virtual std::unique_ptr<Copies> make_copies(int rows, const std::vector<Source>& sources) = 0;

  bool any(bool own) {
    double flag = own ? 1.0 : 0.0;
    largest(&flag, 1);
    return flag > 0.0;
  }
  double sum(double own) {
    sum(&own, 1);
    return own;
  }
};

}  // namespace mpm
