// Of what takes long under sanitizers, tests do a part there.
#pragma once

namespace airybench::testing {

#ifdef AIRYBENCH_SANITIZED
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace airybench::testing
