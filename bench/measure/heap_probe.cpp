#include "bench/measure/heap_probe.hpp"

#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace {

using airybench::all_memory_owners;
using airybench::ByOwner;
using airybench::current_memory_owner;
using airybench::MemoryOwner;

constexpr std::size_t always_granted = 64 * 1024;
std::atomic<bool> limit_passed{false}, refused_by_machine{false};
constexpr std::int64_t no_limit = std::numeric_limits<std::int64_t>::max();
std::atomic<std::int64_t> live{0}, peak{0}, peak_ever{0}, limit{no_limit}, backstop{no_limit};
std::atomic<std::int64_t> count{0}, given_out{0};

using Counters = std::array<std::atomic<std::int64_t>, all_memory_owners.size()>;
Counters live_of{}, highest_of{};
Counters at_peak{};                      // live_of at the last copy
std::atomic<std::int64_t> copied_at{0};  // live bytes then
std::atomic_flag copying = ATOMIC_FLAG_INIT;

bool raise(std::atomic<std::int64_t>& highest, std::int64_t now) {
  std::int64_t before = highest;
  while (now > before)
    if (highest.compare_exchange_weak(before, now)) return true;
  return false;
}

void copy(const Counters& from, Counters& to) {
  for (std::size_t k = 0; k < from.size(); ++k) to[k] = from[k].load();
}

ByOwner<std::int64_t> values_of(const Counters& counters) {
  ByOwner<std::int64_t> values;
  for (std::size_t k = 0; k < counters.size(); ++k) values.values[k] = counters[k];
  return values;
}

// Copies only after 0.1 % of growth, and not while another thread copies.
void copy_at_peak(std::int64_t now) {
  const std::int64_t grown = now - copied_at;
  if (grown <= now / 1000 || copying.test_and_set(std::memory_order_acquire)) return;
  copy(live_of, at_peak);
  copied_at = now;
  copying.clear(std::memory_order_release);
}

void add(MemoryOwner owner, std::int64_t bytes) {
  const auto k = static_cast<std::size_t>(owner);
  raise(highest_of[k], live_of[k].fetch_add(bytes) + bytes);
  const std::int64_t now = live.fetch_add(bytes) + bytes;
  if (raise(peak, now)) copy_at_peak(now);
}

// A block's last byte, one more than asked for, is its tag: the owner, and whether glibc, whose
// blocks end 8 bytes after a multiple of 16, gave 16 bytes for it, which do not count.
constexpr unsigned char enlarged = 0x80;
constexpr std::int64_t enlargement_bytes = 16;
constexpr std::size_t with_tag(std::size_t bytes) {
  return bytes == std::numeric_limits<std::size_t>::max() ? bytes : bytes + 1;
}
constexpr bool fills_a_block(std::size_t bytes) { return bytes >= 24 && bytes % 16 == 8; }

unsigned char& tag_of(void* block) {
  return static_cast<unsigned char*>(block)[malloc_usable_size(block) - 1];
}
MemoryOwner owner_of(void* block) {
  const unsigned char owner = tag_of(block) & ~enlarged;
  return owner < all_memory_owners.size() ? static_cast<MemoryOwner>(owner) : MemoryOwner::other;
}
std::int64_t size_of(void* block) {
  const auto usable = static_cast<std::int64_t>(malloc_usable_size(block));
  return usable - ((tag_of(block) & enlarged) != 0 ? enlargement_bytes : 0);
}

bool too_much(std::size_t bytes) {
  if (live > backstop) _exit(airybench::heap::backstop_exit_code);
  const std::int64_t most = limit;
  if (most == no_limit) return false;
  const bool passed = bytes > static_cast<std::size_t>(std::max<std::int64_t>(most, 0)) ||
                      live + static_cast<std::int64_t>(bytes) > most;
  if (passed) limit_passed = true;
  return passed && bytes >= always_granted;
}

void* refused() {
  errno = ENOMEM;
  return nullptr;
}

void* counted(void* block, std::size_t bytes, MemoryOwner owner = current_memory_owner) {
  if (block == nullptr) {
    refused_by_machine = true;
  } else {
    tag_of(block) = static_cast<unsigned char>(owner) | (fills_a_block(bytes) ? enlarged : 0);
    add(owner, size_of(block));
    count.fetch_add(1);
    given_out.fetch_add(static_cast<std::int64_t>(bytes));
  }
  return block;
}

}  // namespace

extern "C" {

void* malloc(std::size_t bytes) {
  return too_much(bytes) ? refused() : counted(__libc_malloc(with_tag(bytes)), bytes);
}

void* calloc(std::size_t n, std::size_t size) {
  std::size_t bytes = 0;
  if (__builtin_mul_overflow(n, size, &bytes) || too_much(bytes)) return refused();
  return counted(__libc_calloc(1, with_tag(bytes)), bytes);
}

void free(void* block) {
  if (block == nullptr) return;
  add(owner_of(block), -size_of(block));
  __libc_free(block);
}

void* realloc(void* block, std::size_t bytes) {
  if (block == nullptr) return malloc(bytes);
  if (bytes == 0) {  // as glibc does
    free(block);
    return nullptr;
  }
  const std::int64_t before = size_of(block);
  if (bytes > static_cast<std::size_t>(before) &&
      too_much(bytes - static_cast<std::size_t>(before)))
    return refused();
  const MemoryOwner owner = owner_of(block);
  void* moved = __libc_realloc(block, with_tag(bytes));
  if (moved != nullptr) add(owner, -before);  // otherwise the old block stays
  return counted(moved, bytes, owner);
}

void* memalign(std::size_t alignment, std::size_t bytes) {
  return too_much(bytes) ? refused() : counted(__libc_memalign(alignment, with_tag(bytes)), bytes);
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
std::int64_t live_bytes() { return live; }
std::int64_t peak_bytes() { return peak; }
std::int64_t allocations() { return count; }
std::int64_t peak_ever_bytes() {
  raise(peak_ever, peak_bytes());
  return peak_ever;
}
void reset_peak() {
  raise(peak_ever, peak_bytes());
  copied_at = live_bytes();
  copy(live_of, at_peak);
  copy(live_of, highest_of);
  peak = live_bytes();
}
bool was_refused() { return refused_by_machine; }
std::int64_t allocated_bytes() { return given_out; }
ByOwner<std::int64_t> live_by_owner() { return values_of(live_of); }
ByOwner<std::int64_t> peak_by_owner() { return values_of(at_peak); }
ByOwner<std::int64_t> highest_by_owner() { return values_of(highest_of); }

Limit::Limit(std::int64_t live_bytes_at_most) {
  limit_passed = false;
  limit = live_bytes_at_most;
}
Limit::~Limit() { limit = no_limit; }
bool Limit::exceeded() const { return limit_passed; }

Backstop::Backstop(std::optional<std::int64_t> limit_bytes) {
  [[maybe_unused]] static const int registered = std::atexit([] {
    if (limit != no_limit && limit_passed) _exit(backstop_exit_code);
  });
  std::int64_t available = no_limit / 2;
  std::ifstream file("/proc/meminfo");
  for (std::string word; file >> word;) {
    std::int64_t kibibytes = 0;
    if (word == "MemAvailable:" && file >> kibibytes) available = kibibytes * 1024 / 100 * 95;
  }
  const std::int64_t granted =
      limit_bytes ? std::min(available, *limit_bytes + *limit_bytes / 2) : available;
  backstop = live_bytes() + granted;
}
Backstop::~Backstop() { backstop = no_limit; }

}  // namespace airybench::heap
