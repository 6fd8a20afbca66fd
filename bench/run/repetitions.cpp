#include "bench/run/repetitions.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "bench/records/robust.hpp"

namespace airybench {

int least_repetitions(const Options& options) {
  return options.precision ? std::max(options.repetitions, fewest_for_median_interval)
                           : options.repetitions;
}

int most_repetitions(const Options& options) {
  return options.precision ? options.max_repetitions : options.repetitions;
}

bool is_repeated(const Record& record, const Options& options) {
  const std::vector<double>& samples = record.samples_s;
  if (samples.empty()) return true;
  const double so_far_s = std::accumulate(samples.begin(), samples.end(), 0.0);
  if (record.measured_once || so_far_s >= options.long_case_s ||
      std::ssize(samples) >= most_repetitions(options))
    return false;
  if (std::ssize(samples) < least_repetitions(options)) return true;
  return *median_uncertainty(samples) > *options.precision;
}

}  // namespace airybench
