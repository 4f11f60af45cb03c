// The processor in the place of a card. Memory is a region that the host may not touch: only while work is done or
// copied are its pages open, and a look at them at any other time ends the program with a sentence. Work is kept until
// somebody waits for it, so that a host that does not wait sees what it would see of a card. Kernels are searched for
// addresses of the host, which a card could not follow.
//
// Weak: a kernel that finds an address of the host in the card's memory is not seen, nor is one that reads beyond its
// array into another; each wait costs two calls of the system.
#include "mpm_gpu/card.hpp"

#include <fmt/core.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <initializer_list>
#include <map>
#include <memory>
#include <stdexcept>

#include "mpm/loop/loop.hpp"
#include "mpm_gpu/error.hpp"

namespace mpm_gpu::card {
namespace {

constexpr std::size_t kReserved = std::size_t{1} << 38;  ///< addresses; pages are taken as they are used
constexpr std::size_t kAligned = 64;
constexpr std::size_t kPage = std::size_t{1} << 21;  ///< bytes that are opened at once
constexpr std::size_t kMostWork = 512,
                      kMostBytes = 512 * 2048;  ///< work that is kept until it is done without being asked
constexpr std::size_t kMostStaged = 1 << 14;    ///< bytes of a copy that is kept with it

std::size_t rounded(std::size_t bytes, std::size_t to) { return (bytes + to - 1) / to * to; }

/// The region of addresses that is the card's memory.
class Region {
 public:
  Region() {
    void* memory = mmap(nullptr, kReserved, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) throw GpuError("gpu: there are no addresses for the memory of a device");
    begin_ = static_cast<char*>(memory);
    const auto beyond = reinterpret_cast<std::uintptr_t>(begin_) % kPage;
    if (beyond > 0) begin_ += kPage - beyond;
    free_[0] = kReserved - kPage;
    madvise(begin_, kReserved - kPage, MADV_HUGEPAGE);  // without such pages opening takes longer
  }
  bool contains(const void* address) const { return address >= begin_ && address < begin_ + kReserved - kPage; }
  void let(bool open) {
    if (open == open_) return;
    const int rights = open ? PROT_READ | PROT_WRITE : PROT_NONE;
    if (mprotect(begin_, rounded(used_, kPage), rights) != 0) throw GpuError("gpu: memory of a device stays closed");
    open_ = open;
  }
  /// First place that is large enough. The region is closed.
  void* take(std::size_t bytes) {
    const std::size_t size = rounded(bytes, kAligned);
    const auto fits = [size](const auto& gap) { return gap.second >= size; };
    const auto gap = std::find_if(free_.begin(), free_.end(), fits);
    if (gap == free_.end()) throw GpuError("gpu: too little memory");
    const auto [at, room] = *gap;
    free_.erase(gap);
    if (room > size) free_[at + size] = room - size;
    taken_[at] = size;
    used_ = std::max(used_, at + size);
    let(true);
    std::memset(begin_ + at, 0, size);
    let(false);
    return begin_ + at;
  }
  void give_back(void* memory) {
    const auto taken = taken_.find(static_cast<std::size_t>(static_cast<char*>(memory) - begin_));
    auto [at, size] = *taken;
    taken_.erase(taken);
    used_ = taken_.empty() ? 0 : taken_.rbegin()->first + taken_.rbegin()->second;
    const auto after = free_.find(at + size);
    if (after != free_.end()) {
      size += after->second;
      free_.erase(after);
    }
    const auto next = free_.lower_bound(at);
    if (next != free_.begin()) {
      const auto before = std::prev(next);
      if (before->first + before->second == at) {
        before->second += size;
        return;
      }
    }
    free_[at] = size;
  }

 private:
  char* begin_ = nullptr;
  std::size_t used_ = 0;
  bool open_ = false;
  std::map<std::size_t, std::size_t> free_, taken_;  ///< sizes by place
};

struct Work;
/// A piece of work: a kernel, the condition of those that follow, or what was recorded.
struct Piece {
  const char* name = "";
  int threads = 1;
  long count = 0;
  void (*run)(const void*, long, long) = nullptr;  ///< for a kernel: does a part of its indices
  std::size_t kernel = 0;                          ///< place of its bytes
  const std::uint32_t* number = nullptr;           ///< for a condition
  std::size_t conditional = 0;                     ///< number of its pieces
  const Work* recorded = nullptr;
};
struct Work {
  std::vector<Piece> pieces;
  std::vector<unsigned char> kernels;

  struct Bytes {
    const void* from;
    std::size_t count;
  };
  /// Adds a kernel of these bytes, one after another.
  void add(Piece piece, std::initializer_list<Bytes> kernel) {
    piece.kernel = rounded(kernels.size(), alignof(std::max_align_t));
    kernels.resize(piece.kernel);
    for (const Bytes& bytes : kernel) {
      const auto* from = static_cast<const unsigned char*>(bytes.from);
      kernels.insert(kernels.end(), from, from + bytes.count);
    }
    pieces.push_back(piece);
  }
};

/// Copy to the device of the bytes that follow it.
struct Upload {
  void* to;
  std::size_t bytes;

  static void run(const void* upload, long, long) {
    const Upload& own = *static_cast<const Upload*>(upload);
    std::memcpy(own.to, &own + 1, own.bytes);
  }
};
/// Copy of bytes that are still there when it is made.
struct Copy {
  void* to;
  const void* from;
  std::size_t bytes;

  static void run(const void* copy, long, long) {
    const Copy& own = *static_cast<const Copy*>(copy);
    std::memcpy(own.to, own.from, own.bytes);
  }
};

struct Stream {
  Region region;
  Work waiting;
  std::unique_ptr<Work> recorded;  ///< null while nothing is recorded
  std::size_t condition = 0;       ///< one past the open condition in the recording; 0: none is open

  Stream() {
    waiting.pieces.reserve(2 * kMostWork);
    waiting.kernels.reserve(2 * kMostBytes);
  }
};

extern "C" void refuse(int, siginfo_t*, void*);

/// Lives as long as the program, as a card does.
Stream& stream() {
  static Stream& stream = []() -> Stream& {
    auto& made = *new Stream;
    struct sigaction now = {};
    if (sigaction(SIGSEGV, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) {
      struct sigaction action = {};
      action.sa_sigaction = &refuse;
      action.sa_flags = SA_SIGINFO | static_cast<int>(SA_RESETHAND);
      sigaction(SIGSEGV, &action, nullptr);
    }
    return made;
  }();
  return stream;
}

extern "C" void refuse(int, siginfo_t* info, void*) {
  static constexpr char kSentence[] =
      "gpu: the host looks at memory of the device, which it can reach by copies alone\n";
  if (stream().region.contains(info->si_addr)) static_cast<void>(!write(2, kSentence, sizeof(kSentence) - 1));
  // The same access ends the program when it is made again.
}

/// True if a number is an address of the host's memory.
bool is_of_host(std::uintptr_t number) {
  // The program and its heap, libraries and stacks have these on 64-bit Linux; others are looked up in vain.
  const std::uintptr_t high = number >> 40;
  if (high != 0x55 && high != 0x56 && high != 0x7e && high != 0x7f) return false;
  if (stream().region.contains(reinterpret_cast<const void*>(number))) return false;
  static const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  unsigned char in_memory = 0;
  return mincore(reinterpret_cast<void*>(number / page * page), 1, &in_memory) == 0;
}

void refuse_addresses(const char* name, const void* kernel, std::size_t bytes) {
  for (std::size_t at = 0; at + sizeof(std::uintptr_t) <= bytes; at += sizeof(std::uintptr_t)) {
    std::uintptr_t number = 0;
    std::memcpy(&number, static_cast<const char*>(kernel) + at, sizeof(number));
    if (is_of_host(number)) {
      throw std::logic_error(
          fmt::format("kernel '{}' holds an address of the host, {:#x}, at byte {}", name, number, at));
    }
  }
}

void refuse_in_recording() {
  if (is_recording()) throw std::logic_error("a recording cannot wait for the device");
}

void do_all(const Work& work) {
  for (std::size_t i = 0; i < work.pieces.size(); ++i) {
    const Piece& piece = work.pieces[i];
    if (piece.recorded != nullptr) {
      do_all(*piece.recorded);
    } else if (piece.number != nullptr) {
      if (*piece.number == 0) i += piece.conditional;
    } else {
      const unsigned char* kernel = work.kernels.data() + piece.kernel;
      mpm::for_parts(piece.name, piece.threads, piece.count,
                     [&](long first, long end, int) { piece.run(kernel, first, end); });
    }
  }
}

/// Does work where much is waiting.
void limit_waiting() {
  const Work& waiting = stream().waiting;
  if (waiting.pieces.size() >= kMostWork || waiting.kernels.size() >= kMostBytes) finish();
}

}  // namespace

void* allocate(std::size_t bytes) {
  finish();
  return stream().region.take(bytes);
}

void release(void* memory) noexcept {
  if (!is_recording()) finish();
  stream().region.give_back(memory);
}

void upload(void* to, const void* from, std::size_t bytes) {
  if (bytes > kMostStaged) return download(to, from, bytes);  // the same copy, which is waited for
  refuse_in_recording();
  const Upload upload{to, bytes};
  stream().waiting.add({"gpu: copies", 1, 1, &Upload::run}, {{&upload, sizeof(upload)}, {from, bytes}});
  limit_waiting();
}

void download_soon(void* to, const void* from, std::size_t bytes) {
  refuse_in_recording();
  const Copy copy{to, from, bytes};
  stream().waiting.add({"gpu: copies", 1, 1, &Copy::run}, {{&copy, sizeof(copy)}});
  limit_waiting();
}

void download(void* to, const void* from, std::size_t bytes) {
  download_soon(to, from, bytes);
  finish();
}

void finish() {
  refuse_in_recording();
  Stream& own = stream();
  if (own.waiting.pieces.empty()) return;
  own.region.let(true);
  do_all(own.waiting);
  own.waiting.pieces.clear();
  own.waiting.kernels.clear();
  own.region.let(false);
}

void launch(const char* name, int threads, long count, void (*run)(const void*, long, long), const void* kernel,
            std::size_t bytes) {
  if (count == 0) return;
  refuse_addresses(name, kernel, bytes);
  Stream& own = stream();
  Work& to = own.recorded ? *own.recorded : own.waiting;
  to.add({name, threads, count, run}, {{kernel, bytes}});
  if (!own.recorded) limit_waiting();
}

Recording::~Recording() {
  if (work_ == nullptr) return;
  if (!is_recording()) finish();  // it may wait to be done
  delete static_cast<Work*>(work_);
}

bool can_record() { return true; }
bool is_recording() { return stream().recorded != nullptr; }
void begin_recording() {
  finish();  // so that memory can be given back meanwhile
  stream().recorded = std::make_unique<Work>();
}
void drop_recording() noexcept {
  stream().recorded.reset();
  stream().condition = 0;
}
Recording end_recording() { return Recording(stream().recorded.release()); }

void begin_when(const std::uint32_t* number) {
  Stream& own = stream();
  if (own.condition != 0) throw std::logic_error("conditions are not nested");
  Piece condition;
  condition.number = number;
  own.recorded->pieces.push_back(condition);
  own.condition = own.recorded->pieces.size();
}
void end_when() {
  Stream& own = stream();
  own.recorded->pieces[own.condition - 1].conditional = own.recorded->pieces.size() - own.condition;
  own.condition = 0;
}

void replay(const Recording& recording) {
  Piece piece;
  piece.recorded = static_cast<const Work*>(recording.work());
  stream().waiting.pieces.push_back(piece);
  limit_waiting();
}

}  // namespace mpm_gpu::card
