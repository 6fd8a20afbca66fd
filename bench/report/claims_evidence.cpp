#include "bench/report/claims_evidence.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "support/text_table.hpp"

namespace airybench {
namespace {

constexpr std::size_t most_named = 4;

std::string some_of(std::vector<std::string> names) {
  if (names.size() <= most_named) return joined(names);
  const std::size_t rest = names.size() - most_named + 1;
  names.resize(most_named - 1);
  return fmt::format("{} and {} more", joined(names), rest);
}

std::string remark(const Record& record) {
  return record.status == Status::inaccurate ? " (inaccurate)" : "";
}

}  // namespace

std::optional<ShownTime> time_of(const CaseTable& cases, const std::string& mesh,
                                 const std::string& method, std::string& why) {
  const Record* record = cases.find(mesh, method);
  const auto refuse = [&](const std::string& reason) -> std::optional<ShownTime> {
    why = reason;
    return {};
  };
  if (record == nullptr) return refuse("no record");
  ShownTime shown;
  if (record->status == Status::timeout) {
    if (!record->extrapolated_time_s) return refuse("timeout without an extrapolated time");
    shown.time.figure_s = *record->extrapolated_time_s;
    shown.time.at_least_s = record->done_fraction.value_or(0) * shown.time.figure_s;
    shown.text = fmt::format("~{} (timeout, above {})", show_seconds(shown.time.figure_s),
                             show_seconds(shown.time.at_least_s));
    return shown;
  }
  if (!has_answer(record->status)) return refuse(std::string(name_of(record->status)));
  if (!record->time_s) return refuse("no time_s");
  shown.time.figure_s = *record->time_s;
  shown.time.samples_s = record->samples_s;
  if (record->samples_s.empty()) shown.time.samples_s = {*record->time_s};
  shown.text = show_seconds(*record->time_s) + remark(*record);
  return shown;
}

ShownRatio shown_ratio(const ShownTime& numerator, const ShownTime& denominator) {
  const Ratio ratio = ratio_of(numerator.time, denominator.time);
  return {ratio, fmt::format("{}/{} = {}{:.3g}", numerator.text, denominator.text,
                             ratio.estimated ? "~" : "", ratio.figure)};
}

std::string show_ratio(const Ratio& ratio) {
  const auto& [low, high] = ratio.interval;
  const std::string figure = fmt::format("{}{:.3g}", ratio.estimated ? "~" : "", ratio.figure);
  if (!std::isfinite(high) && low == 0) return figure + " (no bound)";
  if (!std::isfinite(high)) return fmt::format("{} above {:.3g}", figure, low);
  if (low == 0) return fmt::format("{} below {:.3g}", figure, high);
  if (low == high) return figure;
  return fmt::format("{} [{:.3g}, {:.3g}]", figure, low, high);
}

std::optional<ShownTime> Evidence::time(const std::string& mesh, const std::string& method) {
  std::string why;
  std::optional<ShownTime> time = time_of(cases_, mesh, method, why);
  if (!time) missing(mesh, method, why);
  return time;
}

std::optional<ShownBytes> Evidence::bytes(const std::string& mesh, const std::string& method,
                                          std::optional<std::int64_t> Record::*value,
                                          const char* name) {
  const Record* record = cases_.find(mesh, method);
  const auto refuse = [&](std::string_view reason) -> std::optional<ShownBytes> {
    missing(mesh, method, std::string(reason));
    return {};
  };
  if (record == nullptr) return refuse("no record");
  // What stands there after a timeout is only what there was until then.
  if (!has_answer(record->status)) return refuse(name_of(record->status));
  if (!(record->*value)) return refuse(fmt::format("no {}", name));
  return ShownBytes{static_cast<double>(*(record->*value)),
                    show_bytes(record->*value) + remark(*record)};
}

std::optional<ShownBytes> Evidence::peak_heap(const std::string& mesh, const std::string& method) {
  return bytes(mesh, method, &Record::peak_heap_bytes, "peak_heap_bytes");
}

std::optional<ShownBytes> Evidence::storage(const std::string& mesh, const std::string& method) {
  return bytes(mesh, method, &Record::storage_bytes, "storage_bytes");
}

void Evidence::part(Verdict verdict, const std::string& if_undecided) {
  parts_.push_back(verdict);
  auto& open = claim_.open;
  if (verdict == Verdict::undecided &&
      std::find(open.begin(), open.end(), if_undecided) == open.end())
    open.push_back(if_undecided);
}

void Evidence::part(const std::string& label, const Ratio& ratio, Verdict verdict) {
  interval(label + " " + show_ratio(ratio));
  part(verdict, label + ": the interval straddles the threshold");
}

void Evidence::missing(const std::string& mesh, const std::string& method, const std::string& why) {
  parts_.push_back(Verdict::undecided);
  const auto same = std::find_if(missing_.begin(), missing_.end(), [&](const Missing& entry) {
    return entry.why == why && entry.method == method;
  });
  if (same == missing_.end())
    missing_.push_back({why, method, {mesh}});
  else if (same->meshes.back() != mesh)
    same->meshes.push_back(mesh);
}

void Evidence::over_meshes(const std::string& label, const std::vector<std::string>& meshes,
                           const RatioOn& ratio_on, const Test& test) {
  std::vector<Ratio> ratios;
  std::vector<std::string> texts;
  for (const std::string& mesh : meshes)
    if (const std::optional<ShownRatio> shown = ratio_on(mesh)) {
      ratios.push_back(shown->ratio);
      texts.push_back(mesh + " " + shown->text);
    }
  if (ratios.empty()) return;
  figure(fmt::format("{}: {}", label, joined(texts)));
  const Ratio all = spread(ratios);
  const bool complete = ratios.size() == meshes.size();
  const std::string text =
      fmt::format("{} on {} mesh{}", label, ratios.size(), ratios.size() == 1 ? "" : "es");
  if (test && complete)
    part(text, all, test(all.interval));
  else
    interval(text + " " + show_ratio(all));
}

void Evidence::times_over_meshes(const std::string& numerator, const std::string& denominator,
                                 const std::vector<std::string>& meshes, const Test& test) {
  const auto find = [&](const std::string& mesh, const std::string& method) {
    std::string ignored;
    return test ? time(mesh, method) : time_of(cases_, mesh, method, ignored);
  };
  over_meshes(
      numerator + "/" + denominator, meshes,
      [&](const std::string& mesh) -> std::optional<ShownRatio> {
        const auto above = find(mesh, numerator), below = find(mesh, denominator);
        if (!above || !below) return {};
        return shown_ratio(*above, *below);
      },
      test);
}

Claim Evidence::claim(int number, std::string sentence) const {
  Claim claim = claim_;
  claim.number = number;
  claim.sentence = std::move(sentence);
  claim.verdict = parts_.empty() ? Verdict::undecided : all_of(parts_);
  if (parts_.empty()) claim.open.push_back("no records");
  std::map<std::string, std::vector<std::string>> by_reason;
  for (const auto& [why, method, meshes] : missing_)
    by_reason[why].push_back(fmt::format("{} ({})", method, some_of(meshes)));
  for (const auto& [why, which] : by_reason) claim.open.push_back(why + ": " + joined(which));
  return claim;
}

std::vector<std::string> meshes_with(const CaseTable& cases,
                                     const std::vector<std::string>& methods) {
  std::vector<std::string> meshes;
  for (const std::string& mesh : cases.meshes())
    if (std::any_of(methods.begin(), methods.end(),
                    [&](const std::string& method) { return cases.find(mesh, method) != nullptr; }))
      meshes.push_back(mesh);
  return meshes;
}

std::string joined(const std::vector<std::string>& texts, const char* separator) {
  return fmt::format("{}", fmt::join(texts, separator));
}

}  // namespace airybench
