// Recordings of the executor; and what a card would not do, which the processor in its place does not do either. Cost:
// 1 s.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "gpu_buffers.hpp"
#include "mpm_gpu/executor.hpp"

namespace gpu_recording_test {

using gpu_buffers::there;
using mpm_gpu::Buffer;
using mpm_gpu::Executor;

TEST(GpuRecording, DoesNothingUntilItIsReplayed) {
  Executor run;
  Buffer<int> counts = there<int>({0, 0, 0});
  int* to = counts.data();
  const auto recording = run.record([&] { run.for_each("test", 3, [=](long i) { to[i] += static_cast<int>(i); }); });
  EXPECT_EQ(counts.download(), (std::vector<int>{0, 0, 0}));
  for (int i = 0; i < 4; ++i) run.replay(recording);
  EXPECT_EQ(counts.download(), (std::vector<int>{0, 4, 8}));
}

// The condition is a number of the device, which the work before it may have changed.
TEST(GpuRecording, HasConditions) {
  if (!mpm_gpu::card::can_record()) GTEST_SKIP() << "nothing can be recorded here";
  Executor run;
  Buffer<std::uint32_t> number = there<std::uint32_t>({7, 3});
  Buffer<int> counts = there<int>({0, 0});
  std::uint32_t* left = number.data() + 1;
  int* to = counts.data();
  const auto recording = run.record([&] {
    run.when(number, 1, [&] {
      run.for_each("test", 1, [=](long) { ++to[0]; });
      run.for_each("test", 1, [=](long) { --*left; });
    });
    run.for_each("test", 1, [=](long) { ++to[1]; });
  });
  for (int i = 0; i < 5; ++i) run.replay(recording);
  EXPECT_EQ(counts.download(), (std::vector<int>{3, 5}));
}

// Not for builds with the address sanitizer, whose heap and handler of signals are others.
#ifndef MPM_CUDA
TEST(GpuRecording, WaitsForNothing) {
  Executor run;
  Buffer<int> numbers = there<int>({1});
  EXPECT_THROW(static_cast<void>(run.record([&] { static_cast<void>(numbers.get(0)); })), std::logic_error);
  EXPECT_EQ(numbers.get(0), 1);  // and is over
}

TEST(GpuStandIn, HidesItsMemoryFromTheHost) {
  Buffer<int> numbers = there<int>({1});
  volatile const int* address = numbers.data();
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // a program of its own: threads of loops do not live on in a fork
  EXPECT_DEATH(static_cast<void>(*address), "the host looks at memory of the device");
}

TEST(GpuStandIn, RefusesAddressesOfTheHost) {
  Executor run;
  std::vector<int> of_host(1);
  int* address = of_host.data();
  EXPECT_THROW(run.for_each("test", 1, [=](long i) { ++address[i]; }), std::logic_error);
  EXPECT_THROW(run.for_each("test", 1, [&](long) { of_host.clear(); }), std::logic_error);
}

TEST(GpuStandIn, DoesWorkWhenItIsWaitedFor) {
  Executor run;
  static int done = 0;
  run.for_each("test", 1, [=](long) { ++done; });
  EXPECT_EQ(done, 0);
  mpm_gpu::card::finish();
  EXPECT_EQ(done, 1);
}

TEST(GpuStandIn, GivesMemoryAgain) {
  Buffer<int> first, second, third;
  for (Buffer<int>* buffer : {&first, &second, &third}) buffer->fit(1000);
  const int* place = second.data();
  second = Buffer<int>();
  Buffer<int> again;
  again.fit(1000);
  EXPECT_EQ(again.data(), place);
  again.upload(std::vector<int>(1000, 5));
  again = Buffer<int>();
  again.fit(1000);
  EXPECT_EQ(again.get(999), 0);
}
#endif

}  // namespace gpu_recording_test
