// A fingerprint of an answer's leading digits, by which runs of different machines, builds and
// methods see at a glance that they solved the same problem and found the same.
//
// It is made of four sums over the whole answer, which are known better than any single entry, so
// rounded that the likely exact values (no friction, C = −W) are the middle of a step:
//   strain energy W, normal resultant N   to 5 significant digits
//   complementary energy C                as C / (W + |C|) in steps of 1e-5
//   tangential resultant T                as T / (|N| + |T|) in steps of 1e-5
// An error of 1e-9 changes it in about one of a thousand answers, ALM's 1e-7 in a few of a hundred:
// where a sum happens to lie at the edge of a step. Different hashes therefore ask for a look at
// the digits; equal ones settle it.
#pragma once

#include <string>

#include "bench/verify/verifier.hpp"

namespace airybench {

// 16 hexadecimal digits of the SHA-256 of the rounded sums. Empty where the answer is next to no
// stress, all of whose digits are rounding, or is not finite.
std::string answer_hash(const Verification& verification);

}  // namespace airybench
