#include "bench/measure/heap_probe.hpp"

namespace airybench::heap {

bool is_active() { return false; }
std::int64_t live_bytes() { return 0; }
std::int64_t peak_bytes() { return 0; }
std::int64_t peak_ever_bytes() { return 0; }
std::int64_t allocations() { return 0; }
std::int64_t allocated_bytes() { return 0; }
void reset_peak() {}
bool was_refused() { return false; }
ByOwner<std::int64_t> live_by_owner() { return {}; }
ByOwner<std::int64_t> peak_by_owner() { return {}; }
ByOwner<std::int64_t> highest_by_owner() { return {}; }
Limit::Limit(std::int64_t) {}
Limit::~Limit() = default;
Backstop::Backstop(std::optional<std::int64_t>) {}
Backstop::~Backstop() = default;
bool Limit::exceeded() const { return false; }

}  // namespace airybench::heap
