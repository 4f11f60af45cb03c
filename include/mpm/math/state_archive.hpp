// Serialises the state of a run by name: numbers and arrays of numbers, in groups. A class with state has one function,
// serialise(StateArchive&), that serves both to write and to read, so that the two cannot disagree. Values that are
// computed anew in every step are not stored.
//
//   void Thing::serialise(StateArchive& archive) {
//     archive.value("work", work_);
//     archive.rows("held", held_);
//     archive.column("held/node", held_, &Held::node);
//   }
//
// A run over several ranks (ranks/communicator.hpp) stores what each of them has. When it goes on with as many, each
// reads its own; with another number of them, Merge says what becomes of it: what is the same on all is a value, parts
// of a sum are stored by sum() and sum_column(), and lists are joined, or shared out (Share).
//
// Numbers are stored to the last bit. A derived class decides where they go (checkpoint/hdf5_archive.hpp). Weak:
// reading trusts the names; a class that stores other numbers than before needs a new version of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm {

class StateArchive {
 public:
  enum class Number : std::uint8_t { float32, float64, int32, int64, uint8, uint32, uint64 };
  /// Way to give the numbers of several ranks to another number of ranks that reads them.
  enum class Merge : std::uint8_t {
    same,   ///< all ranks have the same
    part,   ///< parts of sums: the first rank gets the sums, the others 0
    join,   ///< all get all, one after another
    count,  ///< number of what is joined: all get the sum
    share,  ///< each gets about as much as any other, in the order in which it is stored
  };

  StateArchive() = default;
  StateArchive(const StateArchive&) = delete;
  StateArchive& operator=(const StateArchive&) = delete;
  virtual ~StateArchive() = default;

  /// True while values are read from the archive, false while they are written to it.
  virtual bool reading() const = 0;
  /// True while what other ranks have written is merged: what says where numbers lie does not hold then.
  virtual bool merging() const { return false; }

  /// While a Group exists, all names are prefixed with "name/".
  class Group {
   public:
    Group(StateArchive& archive, const std::string& name) : archive_(archive), length_(archive.prefix_.size()) {
      archive.prefix_ += name + "/";
    }
    Group(const Group&) = delete;
    Group& operator=(const Group&) = delete;
    ~Group() { archive_.prefix_.resize(length_); }

   private:
    StateArchive& archive_;
    std::size_t length_;
  };

  /// While a Same exists, all that is serialised is the same on all ranks.
  class Same {
   public:
    explicit Same(StateArchive& archive, bool same = true) : archive_(archive), before_(archive.same_) {
      archive.same_ = before_ || same;
    }
    Same(const Same&) = delete;
    Same& operator=(const Same&) = delete;
    ~Same() { archive_.same_ = before_; }

   private:
    StateArchive& archive_;
    bool before_;
  };

  /// While a Share exists, lists are shared out among the ranks that read them, instead of being joined: whole rows, of
  /// so many numbers each.
  class Share {
   public:
    explicit Share(StateArchive& archive, std::size_t row = 1) : archive_(archive) {
      archive.shares_ = true;
      archive.share_row_ = row;
    }
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;
    ~Share() { archive_.shares_ = false; }

   private:
    StateArchive& archive_;
  };

  /// Serialises a number, bool, enumeration, vector or quaternion.
  template <class T>
  void value(const std::string& name, T& value) {
    column_of(name, 1, Merge::same, [&value](std::size_t) -> T& { return value; });
  }
  /// The same of a sum, of which every rank has a part.
  template <class T>
  void sum(const std::string& name, T& value) {
    column_of(name, 1, Merge::part, [&value](std::size_t) -> T& { return value; });
  }
  void value(const std::string& name, std::string& text) {
    merge_ = Merge::same;
    if (reading()) text.resize(stored(prefix_ + name));
    values(prefix_ + name, Number::uint8, text.data(), text.size());
  }
  /// Serialises an array of such values that has resize() and data(); an array of numbers is stored as it lies in
  /// memory. Reading resizes the array to the stored size.
  template <class List>
  void list(const std::string& name, List& list) {
    using Value = typename List::value_type;
    merge_ = Merge::join;
    if (reading()) {
      const std::size_t size = stored(prefix_ + name) / Packed<Value>::kCount;
      if (list.size() != size) list.resize(size);
    }
    if constexpr (std::is_arithmetic_v<Value>) {
      values(prefix_ + name, number<Value>(), list.data(), list.size());
    } else {
      column_of(name, list.size(), Merge::join, [&list](std::size_t i) -> Value& { return list[i]; });
    }
  }
  /// Serialises the number of entries of a list of structures; reading resizes the list to it.
  template <class List>
  void rows(const std::string& name, List& list) {
    std::uint64_t size = list.size();
    column_of(name + "/rows", 1, Merge::count, [&size](std::size_t) -> std::uint64_t& { return size; });
    if (reading()) list.resize(size);
  }
  /// Serialises one member of every entry of a list; `member` is a pointer to it or a function that returns a reference
  /// to it.
  template <class List, class Member>
  void column(const std::string& name, List& list, Member member) {
    column_of(name, list.size(), Merge::join,
              [&](std::size_t i) -> decltype(auto) { return std::invoke(member, list[i]); });
  }
  /// The same of sums, of which every rank has parts, in lists of one length.
  template <class List, class Member>
  void sum_column(const std::string& name, List& list, Member member) {
    column_of(name, list.size(), Merge::part,
              [&](std::size_t i) -> decltype(auto) { return std::invoke(member, list[i]); });
  }
  /// Serialises the generation (BlockTable::generation()) at which something was found, as the number of sorts since
  /// then; a rank that has to sort again since another could not may have one more than that.
  void generation(const std::string& name, std::uint64_t& generation) {
    std::uint64_t since = generation_ - generation;
    sum(name, since);
    if (reading()) generation = generation_ - since;
  }
  /// Sets the present generation; call it before generation().
  void set_generation(std::uint64_t generation) { generation_ = generation; }

 protected:
  /// Writes, or when reading fills, `count` numbers at `data`. @throws Error of the derived class
  virtual void values(const std::string& name, Number number, void* data, std::size_t count) = 0;
  /// Returns how many numbers are stored under that name; when reading only. @throws Error of the derived class
  virtual std::size_t stored(const std::string& name) = 0;
  /// Merge of the numbers in question in values() and stored().
  Merge merge() const {
    if (same_) return Merge::same;
    return shares_ && merge_ == Merge::join ? Merge::share : merge_;
  }
  /// Count of numbers that stay together in what is shared out.
  std::size_t share_row() const { return share_row_; }

 private:
  /// Form in which a value is stored: as kCount numbers of type Scalar.
  template <class T, class = void>
  struct Packed;
  template <class T>
  struct Packed<T, std::enable_if_t<std::is_arithmetic_v<T>>> {
    using Scalar = std::conditional_t<std::is_same_v<T, bool>, std::uint8_t, T>;
    static constexpr std::size_t kCount = 1;
    static void pack(const T& value, Scalar* to) { *to = static_cast<Scalar>(value); }
    static void unpack(T& value, const Scalar* from) { value = static_cast<T>(*from); }
  };
  template <class T>
  struct Packed<T, std::enable_if_t<std::is_enum_v<T>>> {
    using Scalar = std::underlying_type_t<T>;
    static constexpr std::size_t kCount = 1;
    static void pack(const T& value, Scalar* to) { *to = static_cast<Scalar>(value); }
    static void unpack(T& value, const Scalar* from) { value = static_cast<T>(*from); }
  };
  template <int Rows, int Columns>
  struct Packed<Eigen::Matrix<double, Rows, Columns>, void> {
    using Scalar = double;
    static constexpr std::size_t kCount = Rows * Columns;
    static void pack(const Eigen::Matrix<double, Rows, Columns>& value, double* to) {
      for (std::size_t i = 0; i < kCount; ++i) to[i] = value.data()[i];
    }
    static void unpack(Eigen::Matrix<double, Rows, Columns>& value, const double* from) {
      for (std::size_t i = 0; i < kCount; ++i) value.data()[i] = from[i];
    }
  };
  template <class Unused>
  struct Packed<Quat, Unused> {
    using Scalar = double;
    static constexpr std::size_t kCount = 4;  // x, y, z, w
    static void pack(const Quat& value, double* to) {
      for (int i = 0; i < 4; ++i) to[i] = value.coeffs()[i];
    }
    static void unpack(Quat& value, const double* from) {
      for (int i = 0; i < 4; ++i) value.coeffs()[i] = from[i];
    }
  };

  template <class T>
  static constexpr Number number() {
    if constexpr (std::is_floating_point_v<T>) return sizeof(T) == 4 ? Number::float32 : Number::float64;
    if constexpr (sizeof(T) == 1) return Number::uint8;
    if constexpr (std::is_signed_v<T>) return sizeof(T) == 4 ? Number::int32 : Number::int64;
    return sizeof(T) == 4 ? Number::uint32 : Number::uint64;
  }

  template <class At>
  void column_of(const std::string& name, std::size_t size, Merge merge, At&& at) {
    merge_ = merge;
    using Pack = Packed<std::decay_t<decltype(at(0))>>;
    using Scalar = typename Pack::Scalar;
    static_assert(sizeof(Scalar) == 1 || sizeof(Scalar) == 4 || sizeof(Scalar) == 8);
    std::vector<Scalar> packed(size * Pack::kCount);
    if (!reading()) {
      for (std::size_t i = 0; i < size; ++i) Pack::pack(at(i), packed.data() + i * Pack::kCount);
    }
    values(prefix_ + name, number<Scalar>(), packed.data(), packed.size());
    if (!reading()) return;
    for (std::size_t i = 0; i < size; ++i) Pack::unpack(at(i), packed.data() + i * Pack::kCount);
  }

  std::string prefix_;
  std::uint64_t generation_ = 0;
  std::size_t share_row_ = 1;
  Merge merge_ = Merge::same;
  bool same_ = false, shares_ = false;
};

}  // namespace mpm
