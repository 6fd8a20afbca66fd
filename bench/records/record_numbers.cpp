#include "bench/records/record_numbers.hpp"

#include "bench/records/robust.hpp"

namespace airybench {

std::vector<std::pair<std::string, double>> numbers_of(const Record& record) {
  std::vector<std::pair<std::string, double>> numbers;
  for (const Field& field : record_fields())
    if (const auto number = number_in(record, field)) numbers.emplace_back(field.name, *number);
  return numbers;
}

Interval time_interval(const Record& record) {
  if (!record.time_s) return {};
  if (record.time_low_s && record.time_high_s) return {*record.time_low_s, *record.time_high_s};
  const double mad_s = record.samples_s.empty() ? 0 : median_absolute_deviation(record.samples_s);
  return {*record.time_s - mad_s, *record.time_s + mad_s};
}

std::string variant_of(const Record& record) {
  const CaseName name = name_of(record);
  return name.method + name.suffix();
}

}  // namespace airybench
