// PETSc and MPI with the library's errors in place of codes, and objects that free what they hold. Private to this
// folder.
#pragma once

#include <petscsf.h>

#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// @throws RanksError with PETSc's own words, if the code is that of an error
void check(PetscErrorCode code);
/// The same of MPI.
void check_mpi(int code);

/// Starts MPI and PETSc, and ends them.
class PetscSession {
 public:
  PetscSession();
  ~PetscSession();
  PetscSession(const PetscSession&) = delete;
  PetscSession& operator=(const PetscSession&) = delete;

  MPI_Comm all() const { return all_; }    ///< all ranks; errors come back as codes
  MPI_Comm ends() const { return ends_; }  ///< the same, apart from all that goes on between them

 private:
  bool own_mpi_ = false;  ///< the program had not started it before
  MPI_Comm all_ = MPI_COMM_NULL, ends_ = MPI_COMM_NULL;
};

/// Table of which rank reads which row of which other one.
class StarForest {
 public:
  explicit StarForest(MPI_Comm all) { check(PetscSFCreate(all, &forest_)); }
  ~StarForest() { PetscSFDestroy(&forest_); }
  StarForest(const StarForest&) = delete;
  StarForest& operator=(const StarForest&) = delete;

  /// `rows`: of this rank; `read`: the rows that it reads, one after another. Collective.
  void set_up(std::size_t rows, const std::vector<PetscSFNode>& read);
  PetscSF get() const { return forest_; }

 private:
  PetscSF forest_ = nullptr;
};

/// So many numbers, or bytes, as one.
class Together {
 public:
  Together(int count, MPI_Datatype of) {
    check_mpi(MPI_Type_contiguous(count, of, &type_));
    check_mpi(MPI_Type_commit(&type_));
  }
  ~Together() { MPI_Type_free(&type_); }
  Together(const Together&) = delete;
  Together& operator=(const Together&) = delete;

  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// A number of rows or their index as PETSc writes it. @throws RanksError if it does not fit
PetscInt petsc_index(std::uint64_t number);

}  // namespace mpm
