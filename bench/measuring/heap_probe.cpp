#include "bench/measuring/heap_probe.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>

// glibc's allocator under its own names.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace {

constexpr std::size_t always_granted = 64 * 1024;
std::atomic<bool> limit_passed{false};
constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
std::atomic<std::int64_t> live{0}, peak{0}, peak_ever{0}, count{0}, limit{no_limit},
    backstop{no_limit};

void raise(std::atomic<std::int64_t>& highest, std::int64_t now) {
  std::int64_t before = highest.load(std::memory_order_relaxed);
  while (now > before && !highest.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
  }
}

void add(std::int64_t bytes) {
  const std::int64_t now = live.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  raise(peak, now);
}

std::int64_t size_of(void* block) { return static_cast<std::int64_t>(malloc_usable_size(block)); }

bool too_much(std::size_t bytes) {
  if (live.load(std::memory_order_relaxed) > backstop.load(std::memory_order_relaxed))
    _exit(airybench::heap::backstop_exit_code);
  const std::int64_t most = limit.load(std::memory_order_relaxed);
  if (most == no_limit) return false;
  const bool passed =
      bytes > static_cast<std::size_t>(std::max<std::int64_t>(most, 0)) ||
      live.load(std::memory_order_relaxed) + static_cast<std::int64_t>(bytes) > most;
  if (passed) limit_passed.store(true, std::memory_order_relaxed);
  return passed && bytes >= always_granted;
}

void* refused() {
  errno = ENOMEM;
  return nullptr;
}

void* counted(void* block) {
  if (block != nullptr) {
    add(size_of(block));
    count.fetch_add(1, std::memory_order_relaxed);
  }
  return block;
}

}  // namespace

extern "C" {

void* malloc(std::size_t bytes) {
  return too_much(bytes) ? refused() : counted(__libc_malloc(bytes));
}

void* calloc(std::size_t n, std::size_t size) {
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(n, size, &bytes) || too_much(bytes)) return refused();
  return counted(__libc_calloc(n, size));
}

void* realloc(void* block, std::size_t bytes) {
  if (block == nullptr) return malloc(bytes);
  const std::int64_t before = size_of(block);
  if (bytes > static_cast<std::size_t>(before) &&
      too_much(bytes - static_cast<std::size_t>(before)))
    return refused();
  void* moved = __libc_realloc(block, bytes);
  if (moved == nullptr && bytes > 0) return nullptr;  // the old block is still there
  add(-before);
  return counted(moved);
}

void free(void* block) {
  if (block == nullptr) return;
  add(-size_of(block));
  __libc_free(block);
}

void* memalign(std::size_t alignment, std::size_t bytes) {
  return too_much(bytes) ? refused() : counted(__libc_memalign(alignment, bytes));
}

void* aligned_alloc(std::size_t alignment, std::size_t bytes) { return memalign(alignment, bytes); }

int posix_memalign(void** block, std::size_t alignment, std::size_t bytes) {
  if (alignment % sizeof(void*) != 0 || (alignment & (alignment - 1)) != 0) return EINVAL;
  void* result = memalign(alignment, bytes);
  if (result == nullptr) return ENOMEM;
  *block = result;
  return 0;
}

void* valloc(std::size_t bytes) { return memalign(4096, bytes); }

}  // extern "C"

namespace airybench::heap {

bool is_active() { return true; }
std::int64_t live_bytes() { return live.load(std::memory_order_relaxed); }
std::int64_t peak_bytes() { return peak.load(std::memory_order_relaxed); }
std::int64_t allocations() { return count.load(std::memory_order_relaxed); }
std::int64_t peak_ever_bytes() {
  raise(peak_ever, peak_bytes());
  return peak_ever.load(std::memory_order_relaxed);
}
void reset_peak() {
  raise(peak_ever, peak_bytes());
  peak.store(live_bytes(), std::memory_order_relaxed);
}

Limit::Limit(std::int64_t live_bytes_at_most) {
  limit_passed.store(false);
  limit.store(live_bytes_at_most);
}
Limit::~Limit() { limit.store(no_limit); }
bool Limit::exceeded() const { return limit_passed.load(); }

Backstop::Backstop(std::optional<std::int64_t> limit_bytes) {
  std::int64_t available = no_limit / 2;
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;) {
    std::int64_t kibibytes = 0;
    if (word == "MemAvailable:" && file >> kibibytes) available = kibibytes * 1024 / 100 * 95;
  }
  const std::int64_t granted =
      limit_bytes ? std::min(available, *limit_bytes + *limit_bytes / 2) : available;
  backstop.store(live_bytes() + granted);
}
Backstop::~Backstop() { backstop.store(no_limit); }

}  // namespace airybench::heap
