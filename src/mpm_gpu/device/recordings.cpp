// Recordings on a card: what is handed to the stream is captured as a graph of CUDA, and a condition is a node whose
// body another stream captures. Conditions need a toolkit and a driver of CUDA 12.4 or later.
#include <cuda_runtime_api.h>

#include <memory>

#include "mpm_gpu/card.hpp"
#include "mpm_gpu/device/card_calls.hpp"
#include "mpm_gpu/error.hpp"

namespace mpm_gpu::card {
namespace {

constexpr int kFirstWithConditions = 12040;

/// A graph, and what of it can be handed out.
struct Graph {
  cudaGraph_t graph = nullptr;
  cudaGraphExec_t whole = nullptr;

  Graph() = default;
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;
  // Answers are not looked at: the runtime may have ended before.
  ~Graph() {
    if (whole != nullptr) cudaGraphExecDestroy(whole);
    if (graph != nullptr) cudaGraphDestroy(graph);
  }
};

/// The stream that captures, and the one that captures the body of a condition.
struct Recorder {
  cudaStream_t whole = nullptr, body = nullptr;
  bool on = false, in_body = false;
};
Recorder& recorder() {
  static Recorder recorder;
  return recorder;
}

#if CUDART_VERSION >= kFirstWithConditions
/// The graph that a stream captures, and the nodes that the next one comes after.
struct Captured {
  cudaGraph_t graph = nullptr;
  const cudaGraphNode_t* last = nullptr;
  const cudaGraphEdgeData* edges = nullptr;
  std::size_t count = 0;

  explicit Captured(cudaStream_t stream) {
    cudaStreamCaptureStatus status = cudaStreamCaptureStatusNone;
#if CUDART_VERSION >= 13000
    succeed(cudaStreamGetCaptureInfo(stream, &status, nullptr, &graph, &last, &edges, &count), "record a condition");
#else
    succeed(cudaStreamGetCaptureInfo_v3(stream, &status, nullptr, &graph, &last, &edges, &count), "record a condition");
#endif
  }
  /// Adds a node after those, which all that is captured from here on comes after.
  void add(cudaStream_t stream, cudaGraphNodeParams& parameters) const {
    cudaGraphNode_t node = nullptr;
#if CUDART_VERSION >= 13000
    succeed(cudaGraphAddNode(&node, graph, last, edges, count, &parameters), "record a condition");
    succeed(cudaStreamUpdateCaptureDependencies(stream, &node, nullptr, 1, cudaStreamSetCaptureDependencies),
            "record a condition");
#else
    succeed(cudaGraphAddNode_v2(&node, graph, last, edges, count, &parameters), "record a condition");
    succeed(cudaStreamUpdateCaptureDependencies_v2(stream, &node, nullptr, 1, cudaStreamSetCaptureDependencies),
            "record a condition");
#endif
  }
};
#endif

}  // namespace

Recording::~Recording() {
  if (work_ == nullptr) return;
  cudaStreamSynchronize(static_cast<cudaStream_t>(stream()));  // it may be at work
  delete static_cast<Graph*>(work_);
}

// Events between launches, which a profile needs, would be captured, too.
bool can_record() {
  static const bool can = [] {
    int driver = 0;
    return cudaDriverGetVersion(&driver) == cudaSuccess && driver >= kFirstWithConditions;
  }();
  return CUDART_VERSION >= kFirstWithConditions && can && !profiles();
}

bool is_recording() { return recorder().on; }

void begin_recording() {
  Recorder& own = recorder();
  own.whole = static_cast<cudaStream_t>(stream());
  if (own.body == nullptr) succeed(cudaStreamCreateWithFlags(&own.body, cudaStreamNonBlocking), "open a stream");
  succeed(cudaStreamBeginCapture(own.whole, cudaStreamCaptureModeThreadLocal), "begin a recording");
  own.on = true;
}

Recording end_recording() {
  Recorder& own = recorder();
  auto made = std::make_unique<Graph>();
  own.on = false;
  succeed(cudaStreamEndCapture(own.whole, &made->graph), "end a recording");
  succeed(cudaGraphInstantiate(&made->whole, made->graph, 0), "make a graph of a recording");
  return Recording(made.release());
}

void drop_recording() noexcept {
  Recorder& own = recorder();
  cudaGraph_t graph = nullptr;
  if (own.in_body) {
    cudaStreamEndCapture(own.body, &graph);
    work_goes_to(own.whole);
  }
  if (cudaStreamEndCapture(own.whole, &graph) == cudaSuccess && graph != nullptr) cudaGraphDestroy(graph);
  cudaGetLastError();
  own.on = own.in_body = false;
}

void begin_when(const std::uint32_t* number) {
#if CUDART_VERSION >= kFirstWithConditions
  Recorder& own = recorder();
  if (own.in_body) throw GpuError("gpu: conditions are not nested");
  cudaGraphConditionalHandle handle{};
  succeed(cudaGraphConditionalHandleCreate(&handle, Captured(own.whole).graph, 0, cudaGraphCondAssignDefault),
          "record a condition");
  set_condition(handle, number);
  cudaGraphNodeParams parameters{};
  parameters.type = cudaGraphNodeTypeConditional;
  parameters.conditional.handle = handle;
  parameters.conditional.type = cudaGraphCondTypeIf;
  parameters.conditional.size = 1;
  Captured(own.whole).add(own.whole, parameters);
  succeed(cudaStreamBeginCaptureToGraph(own.body, parameters.conditional.phGraph_out[0], nullptr, nullptr, 0,
                                        cudaStreamCaptureModeThreadLocal),
          "record what has a condition");
  own.in_body = true;
  work_goes_to(own.body);
#else
  static_cast<void>(number);
#endif
}

void end_when() {
  Recorder& own = recorder();
  cudaGraph_t body = nullptr;
  work_goes_to(own.whole);
  own.in_body = false;
  succeed(cudaStreamEndCapture(own.body, &body), "end what has a condition");
}

void replay(const Recording& recording) {
  succeed(cudaGraphLaunch(static_cast<const Graph*>(recording.work())->whole, static_cast<cudaStream_t>(stream())),
          "do what was recorded");
}

}  // namespace mpm_gpu::card
