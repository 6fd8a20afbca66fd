// A fingerprint of an answer's leading digits: equal hashes from different machines, builds or
// methods mean that they found the same answer.
//
// It hashes four rounded sums, which are more accurate than single entries. The rounding puts the
// likely exact values (no friction, C = −W) in the middle of a step:
//   strain energy W, normal resultant N   to 5 significant digits
//   complementary energy C                as C / (W + |C|) in steps of 1e-5
//   tangential resultant T                as T / (|N| + |T|) in steps of 1e-5
// A sum may lie at the edge of a step, so an error of 1e-9 changes the hash of about one answer in
// a thousand, ALM's 1e-7 that of a few in a hundred. If hashes differ, compare the digits.
#pragma once

#include <string>

#include "bench/verify/verifier.hpp"

namespace airybench {

// 16 hexadecimal digits of SHA-256. Empty if the answer is unstressed (all rounding) or not finite.
std::string answer_hash(const Verification& verification);

}  // namespace airybench
