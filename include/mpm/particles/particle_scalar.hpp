// One scalar of every particle of a set, stored in the precision of the run.
//
// Code outside the kernels reads and writes it as double, one particle at a time; a kernel takes the typed array, once
// per pass. Positions are not ParticleScalars: they are double in every run, because a step moves a particle by a small
// fraction of its distance to the origin.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

#include "mpm/particles/padded_array.hpp"

namespace mpm {

/// IEEE 754 format of the particles' numbers.
enum class Precision { float32, float64 };

/// The name in a scene: "single" or "double".
inline const char* precision_name(Precision precision) { return precision == Precision::float32 ? "single" : "double"; }

class ParticleScalar {
 public:
  ParticleScalar() = default;
  /// `value` for each of `size` particles, rounded to the precision.
  explicit ParticleScalar(Precision precision, std::size_t size = 0, double value = 0.0) {
    if (precision == Precision::float32) values_.emplace<PaddedArray<float>>();
    assign(size, value);
  }

  Precision precision() const { return is_double() ? Precision::float64 : Precision::float32; }
  std::size_t size() const {
    return std::visit([](const auto& values) { return values.size(); }, values_);
  }
  double operator[](std::size_t p) const {
    return is_double() ? (*std::get_if<PaddedArray<double>>(&values_))[p]
                       : static_cast<double>((*std::get_if<PaddedArray<float>>(&values_))[p]);
  }
  void set(std::size_t p, double value) {
    std::visit([&](auto& values) { values[p] = static_cast<std::decay_t<decltype(values[p])>>(value); }, values_);
  }
  void assign(std::size_t size, double value) {
    std::visit(
        [&](auto& values) {
          values.assign(size, static_cast<typename std::decay_t<decltype(values)>::value_type>(value));
        },
        values_);
  }

  /// The values, 64-byte aligned and padded (padded_array.hpp). @throws std::bad_variant_access when T is not the
  /// stored type
  template <class T>
  T* data() {
    return std::get<PaddedArray<T>>(values_).data();
  }
  template <class T>
  const T* data() const {
    return std::get<PaddedArray<T>>(values_).data();
  }

  /// Calls visit(PaddedArray<double>&) or visit(PaddedArray<float>&).
  template <class Visit>
  decltype(auto) visit(Visit&& visit) {
    return std::visit(std::forward<Visit>(visit), values_);
  }
  template <class Visit>
  decltype(auto) visit(Visit&& visit) const {
    return std::visit(std::forward<Visit>(visit), values_);
  }
  void swap(ParticleScalar& other) noexcept { values_.swap(other.values_); }

 private:
  bool is_double() const { return values_.index() == 0; }

  std::variant<PaddedArray<double>, PaddedArray<float>> values_;
};

}  // namespace mpm
