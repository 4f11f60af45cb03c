// Functions that the sources of the card share beyond card.hpp. For builds with MPM_CUDA.
#pragma once

#include <cstdint>

namespace mpm_gpu::card {

/// @throws GpuError with the sentence for a code of CUDA's runtime that is not success. `what`: "could not …"
void succeed(int code, const char* what);
/// The stream, a cudaStream_t.
void* stream();
/// Two numbers of the host's memory to which the card copies at once.
std::uint32_t* host_sums();

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
