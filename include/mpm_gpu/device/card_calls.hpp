// Functions that the sources of the card share beyond card.hpp. For builds with MPM_CUDA.
#pragma once

#include <cstdint>

namespace mpm_gpu::card {

/// @throws GpuError with the sentence for a code of CUDA's runtime that is not success. `what`: "could not …"
void succeed(int code, const char* what);
/// The stream, a cudaStream_t.
void* stream();
/// Lets all work go to another, which captures it.
void work_goes_to(void* stream) noexcept;
/// Hands out the kernel that sets a condition, a cudaGraphConditionalHandle, by the number there.
void set_condition(unsigned long long handle, const std::uint32_t* number);
/// True while a profile is kept.
bool profiles();

/// Time of the work that is handed to the stream while it lives, as a row of the profile where one is kept.
class Timed {
 public:
  explicit Timed(const char* name);
  ~Timed();
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;

 private:
  const char* name_;
  bool on_;
};

}  // namespace mpm_gpu::card
