#include "bench/report/claims.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/lists.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

std::string scene_of(const std::vector<Record>& records, const std::string& source) {
  std::set<std::string> scenes;
  for (const Record& record : records) scenes.insert(record.scene);
  if (scenes.empty() || scenes.contains("default")) return "default";
  if (scenes.size() > 1)
    throw RecordError(
        fmt::format("{}: scene: {} and {} (allowed: default among them, or one scene alone)",
                    source, *scenes.begin(), *std::next(scenes.begin())));
  return *scenes.begin();
}

std::string some_of(std::vector<std::string> names) {
  constexpr std::size_t max_named = 4;
  if (names.size() <= max_named) return joined(names);
  const std::size_t rest = names.size() - max_named + 1;
  names.resize(max_named - 1);
  return fmt::format("{} and {} more", joined(names), rest);
}

std::string remark(const Record& record) {
  return record.status == Status::inaccurate ? " (inaccurate)" : "";
}

std::string show_figure(const Ratio& ratio) {
  return fmt::format("{}{:.3g}", ratio.estimated ? "~" : "", ratio.figure);
}

}  // namespace

std::string_view name_of(ClaimVerdict verdict) {
  constexpr std::array<std::string_view, 3> names = {"not reproduced", "undecided", "reproduced"};
  return names[static_cast<std::size_t>(verdict)];
}

ClaimVerdict is_within(const Interval& quantity, const Interval& range) {
  if (quantity.high <= range.low || quantity.low > range.high) return ClaimVerdict::not_reproduced;
  return quantity.low > range.low && quantity.high <= range.high ? ClaimVerdict::reproduced
                                                                 : ClaimVerdict::undecided;
}

Ratio ratio_of(const CaseTime& numerator, const CaseTime& denominator) {
  const auto samples_or_bound = [](const CaseTime& time) {
    return time.timed_out() ? std::vector{time.at_least_s} : time.samples_s;
  };
  Ratio ratio;
  ratio.figure = numerator.figure_s / denominator.figure_s;
  ratio.interval =
      bootstrap_ratio_of_medians(samples_or_bound(numerator), samples_or_bound(denominator));
  if (numerator.timed_out()) ratio.interval.high = infinity;
  if (denominator.timed_out()) ratio.interval.low = 0;
  ratio.estimated = numerator.timed_out() || denominator.timed_out();
  ratio.text = fmt::format("{}/{} = {}", numerator.text, denominator.text, show_figure(ratio));
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

std::string show_ratio(const Ratio& ratio) {
  const auto& [low, high] = ratio.interval;
  const std::string figure = show_figure(ratio);
  if (!std::isfinite(high) && low == 0) return figure + " (no bound)";
  if (!std::isfinite(high)) return fmt::format("{} above {:.3g}", figure, low);
  if (low == 0) return fmt::format("{} below {:.3g}", figure, high);
  if (low == high) return figure;
  return fmt::format("{} [{:.3g}, {:.3g}]", figure, low, high);
}

CaseTable::CaseTable(const std::vector<Record>& records, const std::string& stop,
                     const std::string& source)
    : scene_(scene_of(records, source)) {
  for (const bool of_this_stop : {false, true})  // the second replaces the first
    for (const Record& record : records) {
      if (record.scene == scene_ && !name_of(record).contact &&
          (name_of(record.stop) == stop) == of_this_stop && (of_this_stop || !record.iterative))
        cases_[{record.mesh, record.general_name}] = record;
    }
  for (const Record& record : records)
    if (!cases_on(record.mesh).empty() && std::ranges::find(meshes_, record.mesh) == meshes_.end())
      meshes_.push_back(record.mesh);
}

const Record* CaseTable::find(const std::string& mesh, const std::string& method) const {
  std::string name = method;
  for (const auto& [of_paper, general] : paper_names)
    if (method == of_paper) name = general;
  const auto found = cases_.find({mesh, name});
  return found == cases_.end() ? nullptr : &found->second;
}

std::optional<CaseTime> CaseTable::time(const std::string& mesh, const std::string& method,
                                        std::string* why) const {
  const auto refuse = [&](std::string_view reason) -> std::optional<CaseTime> {
    if (why != nullptr) *why = reason;
    return {};
  };
  const Record* record = find(mesh, method);
  if (record == nullptr) return refuse("no record");
  CaseTime time;
  if (record->status == Status::timeout) {
    if (!record->extrapolated_time_s) return refuse("timeout without an extrapolated time");
    time.figure_s = *record->extrapolated_time_s;
    time.at_least_s = record->done_fraction.value_or(0) * time.figure_s;
    time.text = fmt::format("~{} (timeout, above {})", show_seconds(time.figure_s),
                            show_seconds(time.at_least_s));
    return time;
  }
  if (!has_answer(record->status)) return refuse(name_of(record->status));
  if (!record->time_s) return refuse("no time_s");
  time.figure_s = *record->time_s;
  time.samples_s = record->samples_s.empty() ? std::vector{time.figure_s} : record->samples_s;
  time.text = show_seconds(time.figure_s) + remark(*record);
  return time;
}

std::vector<const Record*> CaseTable::cases_on(const std::string& mesh) const {
  std::vector<const Record*> records;
  for (auto at = cases_.lower_bound({mesh, ""}); at != cases_.end() && at->first.first == mesh;
       ++at)
    records.push_back(&at->second);
  return records;
}

std::vector<std::string> CaseTable::meshes_with(const std::vector<std::string>& methods) const {
  std::vector<std::string> meshes;
  std::ranges::copy_if(meshes_, std::back_inserter(meshes), [&](const std::string& mesh) {
    return std::ranges::any_of(methods, [&](const auto& method) { return find(mesh, method); });
  });
  return meshes;
}

std::string CaseTable::preconditioner_mesh() const {
  std::string result;
  std::ptrdiff_t most = -1;
  for (const std::string& mesh : meshes_) {
    const std::ptrdiff_t count = std::ranges::count_if(
        cases_on(mesh), [](const Record* record) { return !record->preconditioner.empty(); });
    if (count > most || (count == most && mesh == "Mesh3")) {
      most = count;
      result = mesh;
    }
  }
  return result;
}

std::optional<CaseTime> Evidence::time(const std::string& mesh, const std::string& method) {
  std::string why;
  std::optional<CaseTime> time = cases_.time(mesh, method, &why);
  if (!time) missing(mesh, method, why);
  return time;
}

std::optional<CaseBytes> Evidence::bytes(const std::string& mesh, const std::string& method,
                                         const char* field) {
  const Record* record = cases_.find(mesh, method);
  // After a timeout the field holds the value at that moment only.
  const bool answered = record != nullptr && has_answer(record->status);
  const auto bytes = answered ? number_in(*record, field_named(field)) : std::nullopt;
  if (bytes) return CaseBytes{*bytes, show_bytes(std::llround(*bytes)) + remark(*record)};
  missing(mesh, method,
          answered ? fmt::format("no {}", field)
          : record ? std::string(name_of(record->status))
                   : "no record");
  return {};
}

void Evidence::part(ClaimVerdict verdict, const std::string& if_undecided) {
  parts_.push_back(verdict);
  auto& open = claim_.open;
  if (verdict == ClaimVerdict::undecided && std::ranges::find(open, if_undecided) == open.end())
    open.push_back(if_undecided);
}

void Evidence::part(const std::string& label, const Ratio& ratio, const Interval& range) {
  interval(label + " " + show_ratio(ratio));
  part(is_within(ratio.interval, range), label + ": the interval straddles the threshold");
}

void Evidence::missing(const std::string& mesh, const std::string& method, const std::string& why) {
  parts_.push_back(ClaimVerdict::undecided);
  auto& methods = missing_[why];
  auto same = std::ranges::find(methods, method, [](const auto& entry) { return entry.first; });
  if (same == methods.end()) same = methods.insert(same, {method, {}});
  auto& meshes = same->second;
  if (meshes.empty() || meshes.back() != mesh) meshes.push_back(mesh);
}

void Evidence::over_meshes(
    const std::string& label, const std::vector<std::string>& meshes,
    const std::function<std::optional<Ratio>(const std::string& mesh)>& ratio_on,
    const std::optional<Interval>& range) {
  std::vector<Ratio> ratios;
  std::vector<std::string> texts;
  for (const std::string& mesh : meshes)
    if (const std::optional<Ratio> ratio = ratio_on(mesh)) {
      ratios.push_back(*ratio);
      texts.push_back(mesh + " " + ratio->text);
    }
  if (ratios.empty()) return;
  figure(fmt::format("{}: {}", label, joined(texts)));
  const Ratio all = ratios.size() == 1 ? ratios.front() : spread(ratios);
  const std::string text =
      fmt::format("{} on {} mesh{}", label, ratios.size(), ratios.size() == 1 ? "" : "es");
  if (range && ratios.size() == meshes.size())
    part(text, all, *range);
  else
    interval(text + " " + show_ratio(all));
}

void Evidence::times_over_meshes(const std::string& numerator, const std::string& denominator,
                                 const std::vector<std::string>& meshes,
                                 const std::optional<Interval>& range) {
  const auto find = [&](const std::string& mesh, const std::string& method) {
    return range ? time(mesh, method) : cases_.time(mesh, method);
  };
  const auto ratio_on = [&](const std::string& mesh) -> std::optional<Ratio> {
    const auto above = find(mesh, numerator), below = find(mesh, denominator);
    if (!above || !below) return {};
    return ratio_of(*above, *below);
  };
  over_meshes(numerator + "/" + denominator, meshes, ratio_on, range);
}

Claim Evidence::claim(const std::string& sentence) const {
  Claim claim = claim_;
  claim.sentence = sentence;
  claim.verdict = parts_.empty() ? ClaimVerdict::undecided : std::ranges::min(parts_);
  if (parts_.empty()) claim.open.push_back("no records");
  for (const auto& [why, methods] : missing_) {
    std::vector<std::string> which;
    for (const auto& [method, meshes] : methods)
      which.push_back(fmt::format("{} ({})", method, some_of(meshes)));
    claim.open.push_back(why + ": " + joined(which));
  }
  return claim;
}

}  // namespace airybench
