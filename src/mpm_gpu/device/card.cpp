// The card through the runtime of CUDA: its plain C interface, which any compiler reads.
#include "mpm_gpu/card.hpp"

#include <cuda_runtime_api.h>
#include <fmt/core.h>

#include <cstring>
#include <map>

#include "mpm_gpu/buffer.hpp"
#include "mpm_gpu/device/card_calls.hpp"
#include "mpm_gpu/error.hpp"

namespace mpm_gpu::card {
namespace {

constexpr double kGigabyte = 1e9;
constexpr unsigned kThreadsOfBlock = 128;
constexpr std::size_t kStaging = std::size_t{1} << 23, kStagedAt = 256;  ///< room and places for small uploads [bytes]

/// Stream, events and numbers of the card that this process uses, which is the first one.
struct Card {
  cudaStream_t stream = nullptr;
  cudaEvent_t begin = nullptr, end = nullptr;
  /// A copy from the staging memory that is to be made after the next wait.
  struct Soon {
    void* to;
    const void* from;
    std::size_t bytes;
  };
  std::vector<Soon> soon, arrived;
  char* staging = nullptr;  ///< memory of the host that the card reads and writes by itself
  std::size_t staged = 0;   ///< bytes there that may be in use
  bool profile = false;
  std::map<const char*, Row> rows;

  Card() {
    int driver = 0, runtime = 0, cards = 0;
    cudaDriverGetVersion(&driver);
    cudaRuntimeGetVersion(&runtime);
    const cudaError_t found = cudaGetDeviceCount(&cards);
    if (driver == 0 || found == cudaErrorNoDevice || (found == cudaSuccess && cards == 0)) {
      throw GpuError("gpu: this machine has no NVIDIA card with a driver: run the scene on the processor");
    }
    if (found == cudaErrorInsufficientDriver) {
      throw GpuError(
          fmt::format("gpu: the driver of the card is for CUDA {}.{} and this program for {}.{}: update the driver",
                      driver / 1000, driver % 1000 / 10, runtime / 1000, runtime % 1000 / 10));
    }
    succeed(found, "count the cards");
    int major = 0, minor = 0;
    succeed(cudaDeviceGetAttribute(&major, cudaDevAttrComputeCapabilityMajor, 0), "ask the card what it can do");
    succeed(cudaDeviceGetAttribute(&minor, cudaDevAttrComputeCapabilityMinor, 0), "ask the card what it can do");
    if (major < 8) {
      throw GpuError(
          fmt::format("gpu: the card has compute capability {}.{} and 8.0 is needed: run the scene on the processor",
                      major, minor));
    }
    succeed(cudaSetDevice(0), "open the card");
    succeed(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), "open a stream");
    succeed(cudaMallocHost(reinterpret_cast<void**>(&staging), kStaging), "take memory of the host");
    succeed(cudaEventCreate(&begin), "make an event");
    succeed(cudaEventCreate(&end), "make an event");
  }
};

/// The runtime gives everything back when the process ends.
Card& card() {
  static Card& card = *new Card;
  return card;
}

std::string gigabytes(std::size_t bytes) { return fmt::format("{:.2f} GB", static_cast<double>(bytes) / kGigabyte); }

}  // namespace

void succeed(int code, const char* what) {
  const auto error = static_cast<cudaError_t>(code);
  if (error == cudaSuccess) return;
  cudaGetLastError();  // so that the next call does not report this one
  const char* remedy = "look at the card with nvidia-smi";
  switch (error) {
    case cudaErrorMemoryAllocation:
    case cudaErrorLaunchOutOfResources:
      remedy = "run fewer particles";
      break;
    case cudaErrorNoKernelImageForDevice:
    case cudaErrorUnsupportedPtxVersion:
    case cudaErrorInvalidDeviceFunction:
      remedy = "build the program for this card or update its driver";
      break;
    case cudaErrorDevicesUnavailable:
      remedy = "another program holds the card: end it";
      break;
    case cudaErrorIllegalAddress:
    case cudaErrorMisalignedAddress:
    case cudaErrorInvalidAddressSpace:
    case cudaErrorInvalidPc:
    case cudaErrorIllegalInstruction:
    case cudaErrorAssert:
    case cudaErrorLaunchTimeout:
    case cudaErrorLaunchFailure:
    case cudaErrorECCUncorrectable:
    case cudaErrorHardwareStackError:
    case cudaErrorUnknown:
      remedy = "the card is lost to this program: start it again from the last checkpoint";
      break;
    default:
      break;
  }
  throw GpuError(fmt::format("gpu: could not {} ({}): {}", what, cudaGetErrorString(error), remedy));
}

void* stream() { return card().stream; }
void work_goes_to(void* stream) noexcept { card().stream = static_cast<cudaStream_t>(stream); }
bool profiles() { return card().profile; }

void* allocate(std::size_t bytes) {
  cudaStream_t stream = card().stream;
  void* memory = nullptr;
  const cudaError_t code = cudaMalloc(&memory, bytes);
  if (code == cudaErrorMemoryAllocation) {
    cudaGetLastError();
    throw GpuError(fmt::format("gpu: {} more of the card's memory are needed and {} are free: run fewer particles",
                               gigabytes(bytes), gigabytes(free_memory())));
  }
  succeed(code, "take memory of the card");
  succeed(cudaMemsetAsync(memory, 0, bytes, stream), "set memory of the card to zero");
  return memory;
}

// Answers are not looked at: the runtime may have ended before the last buffer.
void release(void* memory) noexcept {
  cudaStreamSynchronize(card().stream);
  cudaFree(memory);
}

/// Takes so many bytes of the staging memory, for which it may have to wait; null for more than there is.
static char* staged(std::size_t bytes) {
  if (is_recording()) throw GpuError("gpu: a recording cannot copy");  // it would copy whatever lies there later
  Card& own = card();
  if (bytes > kStaging) return nullptr;
  if (own.staged + bytes > kStaging) finish();
  char* place = own.staging + own.staged;
  own.staged += (bytes + kStagedAt - 1) / kStagedAt * kStagedAt;
  return place;
}

void upload(void* to, const void* from, std::size_t bytes) {
  char* place = staged(bytes);
  if (place != nullptr) std::memcpy(place, from, bytes);
  succeed(cudaMemcpyAsync(to, place != nullptr ? place : from, bytes, cudaMemcpyHostToDevice, card().stream),
          "copy to the card");
  if (place == nullptr) finish();
}

void download_soon(void* to, const void* from, std::size_t bytes) {
  char* place = staged(bytes);
  if (place == nullptr) return download(to, from, bytes);
  succeed(cudaMemcpyAsync(place, from, bytes, cudaMemcpyDeviceToHost, card().stream), "copy from the card");
  card().soon.push_back({to, place, bytes});
}

void download(void* to, const void* from, std::size_t bytes) {
  succeed(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, card().stream), "copy from the card");
  finish();
}

std::string name() {
  card();
  cudaDeviceProp properties{};
  succeed(cudaGetDeviceProperties(&properties, 0), "ask the card for its name");
  return properties.name;
}

std::size_t free_memory() {
  card();
  std::size_t free = 0, all = 0;
  succeed(cudaMemGetInfo(&free, &all), "ask the card for its memory");
  return free;
}

double bytes_per_second() {
  constexpr std::size_t kBytes = std::size_t{1} << 29;
  constexpr int kCopies = 10;
  Card& own = card();
  Buffer<unsigned char> from, to;
  for (Buffer<unsigned char>* buffer : {&from, &to}) buffer->fit(kBytes);
  float milliseconds = 0.0F;
  for (int i = 0; i <= kCopies; ++i) {
    if (i == 1) succeed(cudaEventRecord(own.begin, own.stream), "time a copy");  // after the first
    succeed(cudaMemcpyAsync(to.data(), from.data(), kBytes, cudaMemcpyDeviceToDevice, own.stream),
            "copy memory of the card");
  }
  succeed(cudaEventRecord(own.end, own.stream), "time a copy");
  succeed(cudaEventSynchronize(own.end), "time a copy");
  succeed(cudaEventElapsedTime(&milliseconds, own.begin, own.end), "time a copy");
  return 2.0 * kBytes * kCopies / (1e-3 * static_cast<double>(milliseconds));
}

void require(long particles, std::size_t bytes_of_each) {
  const std::size_t free = free_memory(), needed = static_cast<std::size_t>(particles) * bytes_of_each;
  if (needed <= free) return;
  throw GpuError(
      fmt::format("gpu: {} particles need about {} of the card's memory and {} are free: about {} particles would fit",
                  particles, gigabytes(needed), gigabytes(free), free / bytes_of_each));
}

void launch(const char* name, const void* kernel, long count, void** arguments) {
  if (count == 0) return;
  Card& own = card();
  const Timed timed(name);
  const auto blocks = static_cast<unsigned>((count + kThreadsOfBlock - 1) / kThreadsOfBlock);
  succeed(cudaLaunchKernel(kernel, dim3(blocks), dim3(kThreadsOfBlock), arguments, 0, own.stream), name);
}

Timed::Timed(const char* name) : name_(name), on_(card().profile) {
  if (on_) succeed(cudaEventRecord(card().begin, card().stream), "time a kernel");
}

// The time of a launch that failed is left out, and the failure is found by the next call.
Timed::~Timed() {
  if (!on_) return;
  Card& own = card();
  float milliseconds = 0.0F;
  if (cudaEventRecord(own.end, own.stream) != cudaSuccess || cudaEventSynchronize(own.end) != cudaSuccess ||
      cudaEventElapsedTime(&milliseconds, own.begin, own.end) != cudaSuccess) {
    return;
  }
  Row& row = own.rows[name_];
  ++row.launches;
  row.seconds += 1e-3 * static_cast<double>(milliseconds);
}

void profile(bool on) {
  card().profile = on;
  if (on) card().rows.clear();
}

std::vector<Row> profiled() {
  std::map<std::string, Row> by_name;
  for (const auto& [name, row] : card().rows) {
    Row& sum = by_name[name];
    sum.name = name;
    sum.launches += row.launches;
    sum.seconds += row.seconds;
  }
  std::vector<Row> rows;
  for (const auto& [name, row] : by_name) rows.push_back(row);
  return rows;
}

void finish() {
  Card& own = card();
  own.arrived.swap(own.soon);
  own.soon.clear();  // also where the card is lost
  succeed(cudaStreamSynchronize(own.stream), "end the work on the card");
  for (const Card::Soon& one : own.arrived) std::memcpy(one.to, one.from, one.bytes);
  own.staged = 0;
}

}  // namespace mpm_gpu::card
