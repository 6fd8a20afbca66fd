// Many tests at once: the chance of one false rejection among all.
#pragma once

#include <vector>

namespace airybench {

// Holm's step-down: the k-th smallest (from 1) of n p-values becomes
//   max over i <= k of min(1, (n - i + 1) p_(i)).
// To reject where it is <= α keeps the family-wise error rate at α, whatever depends on what.
// In the order of the p-values. Holm, Scand. J. Statist. 6 (1979) 65-70.
std::vector<double> holm_adjusted(const std::vector<double>& p_values);

}  // namespace airybench
