#include "bench/report/claims_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace airybench {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::not_reproduced:
      return "not reproduced";
    case Verdict::undecided:
      return "undecided";
  }
  return "unknown";
}

Verdict opposite(Verdict verdict) {
  if (verdict == Verdict::undecided) return verdict;
  return verdict == Verdict::reproduced ? Verdict::not_reproduced : Verdict::reproduced;
}

Verdict both(Verdict first, Verdict second) {
  for (const Verdict decisive : {Verdict::not_reproduced, Verdict::undecided})
    if (first == decisive || second == decisive) return decisive;
  return Verdict::reproduced;
}

Verdict all_of(const std::vector<Verdict>& verdicts) {
  Verdict result = Verdict::reproduced;
  for (const Verdict verdict : verdicts) result = both(result, verdict);
  return result;
}

Verdict is_above(const Interval& interval, double threshold) {
  if (interval.low > threshold) return Verdict::reproduced;
  return interval.high <= threshold ? Verdict::not_reproduced : Verdict::undecided;
}

Verdict is_within_factor(const Interval& interval, double factor) {
  return both(is_above(interval, 1 / factor), opposite(is_above(interval, factor)));
}

Ratio ratio_of(const CaseTime& numerator, const CaseTime& denominator) {
  Ratio ratio;
  ratio.figure = numerator.figure_s / denominator.figure_s;
  ratio.estimated = numerator.timed_out() || denominator.timed_out();
  if (!ratio.estimated)
    ratio.interval = bootstrap_ratio_of_medians(numerator.samples_s, denominator.samples_s);
  else if (numerator.timed_out() && denominator.timed_out())
    ratio.interval = {0, infinity};
  else if (numerator.timed_out())  // at_least / the denominator's upper end
    ratio.interval = {bootstrap_ratio_of_medians({numerator.at_least_s}, denominator.samples_s).low,
                      infinity};
  else
    ratio.interval = {
        0, bootstrap_ratio_of_medians(numerator.samples_s, {denominator.at_least_s}).high};
  return ratio;
}

Ratio spread(const std::vector<Ratio>& ratios) {
  Ratio result;
  result.interval = {infinity, 0};
  double sum = 0;
  for (const Ratio& ratio : ratios) {
    sum += std::log(ratio.figure);
    result.estimated = result.estimated || ratio.estimated;
    const Interval own = ratio.estimated ? ratio.interval : Interval{ratio.figure, ratio.figure};
    result.interval.low = std::min(result.interval.low, own.low);
    result.interval.high = std::max(result.interval.high, own.high);
  }
  result.figure = std::exp(sum / static_cast<double>(ratios.size()));
  return result;
}

}  // namespace airybench
