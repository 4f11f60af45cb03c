// Ranks on PETSc over MPI. Copies, parcels and what is placed go through PetscSF, which finds out who waits for whom,
// packs and sends; PetscCommBuildTwoSided tells ranks what comes to them. Sums are gathered and added in the order of
// ranks. A build without MPI does not have this class. Source: Zhang et al. (2022), The PetscSF scalable communication
// layer, IEEE Trans. Parallel Distrib. Syst. 33, 842-853. Weak: an exchange cannot be larger than PETSc's 32-bit
// indices number: 512 GiB in parcels, 2 GiB in a gather.
#pragma once

#include "mpm_ranks/make_ranks.hpp"

namespace mpm {

class PetscCommunicator final : public Communicator {
 public:
  /// Starts MPI, unless the program has, and PETSc, without options and signal handlers; the destructor ends both.
  /// There is one such object at a time, and none after it has gone. @throws RanksError
  PetscCommunicator();
  ~PetscCommunicator() override;
  PetscCommunicator(const PetscCommunicator&) = delete;
  PetscCommunicator& operator=(const PetscCommunicator&) = delete;

  int rank() const override;
  int size() const override;
  int on_this_machine() const override;
  using Communicator::sum;
  void sum(double* numbers, int count) override;
  void largest(double* numbers, int count) override;
  std::vector<Bytes> gather(const Bytes& own) override;
  Bytes of_first(const Bytes& own) override;
  std::vector<Parcel> deliver(const std::vector<Parcel>& parcels) override;
  void place(const std::vector<double>& own, const std::vector<std::uint64_t>& places, double* to,
             std::size_t size) override;
  std::unique_ptr<Copies> make_copies(int rows, const std::vector<Source>& sources) override;

  const Traffic& sent() const;
  /// True if all ranks call this within so long [s]; whatever else they do in the meantime.
  bool all_come(double seconds) const;
  /// Number of threads that it may take beside the ranks on the same machine.
  int threads() const;

 private:
  struct State;
  class ForestCopies;
  std::shared_ptr<State> state_;  ///< copies have it, too: PETSc ends after the last of them
};

}  // namespace mpm
