// Of what takes long under sanitizers, tests do a part there.
#pragma once

namespace airybench::testing {

#ifdef AIRYBENCH_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

// Of cases that are much alike, a third.
inline bool left_out(int turn) { return sanitized && turn % 3 != 0; }

}  // namespace airybench::testing
