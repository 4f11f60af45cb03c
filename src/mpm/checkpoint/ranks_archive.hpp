// The checkpoint of a run over several ranks: one file, in which an array is that of all ranks, one after another, and
// "parts/<name>" says how much of it each has. As many ranks read their own again and go on to the bit; any other
// number, one process too, merges them (StateArchive::Merge). A file that one process wrote is one of one rank.
//
// All ranks write into the file at once, each the chunks that begin in its part of an array; what of its numbers lies
// in the chunk before goes to the rank that has that one. The first rank makes the arrays, and writes what is the same
// on all and what is one chunk. Private to this folder.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "chunk_writer.hpp"
#include "hdf5_archive.hpp"
#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// Collective.
class RanksWriter final : public StateArchive {
 public:
  RanksWriter(Communicator& ranks, const std::string& path);
  bool reading() const override { return false; }
  /// All is with the system then. @throws CheckpointError on all ranks
  void close();

 protected:
  void values(const std::string& name, Number number, void* data, std::size_t count) override;
  std::size_t stored(const std::string&) override { return 0; }

 private:
  /// Does it unless something has failed here before.
  template <class Do>
  void attempt(Do&& act);
  /// The same on the first rank alone.
  template <class Do>
  void on_first(Do&& act);
  void write_chunks(const std::string& name, Number number, const std::vector<std::uint64_t>& parts, const void* data);

  Communicator& ranks_;
  std::unique_ptr<Hdf5Writer> file_;     ///< file of the first rank
  std::unique_ptr<ChunkWriter> chunks_;  ///< into the same file
  std::string failure_;                  ///< failure of this rank
  std::vector<std::byte> chunk_;         ///< that is put together of parts
};

class RanksReader final : public StateArchive {
 public:
  /// `ranks`: null for one process. @throws CheckpointError as Hdf5Reader
  RanksReader(const Communicator* ranks, const std::string& path);
  bool reading() const override { return true; }
  bool merging() const override { return there_ != here_; }

 protected:
  void values(const std::string& name, Number number, void* data, std::size_t count) override;
  std::size_t stored(const std::string& name) override;

 private:
  /// Parts of an array that each rank has.
  std::vector<std::uint64_t> parts_of(const std::string& name);
  /// First number of this rank in what is shared out, and how many it gets.
  std::pair<std::uint64_t, std::uint64_t> share_of(const std::vector<std::uint64_t>& parts) const;

  Hdf5Reader file_;
  int rank_, here_, there_;  ///< `here_` ranks read what `there_` have written
};

}  // namespace mpm
