// Collects what a claim rests on: figures, intervals, the verdicts of its parts, and what is open.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/report/claims.hpp"

namespace airybench {

struct ShownTime {
  CaseTime time;
  std::string text;  // "12.3 s", "12.3 s (inaccurate)", "~120 s (timeout, above 60 s)"
};
struct ShownBytes {
  double bytes = 0;
  std::string text;  // "3.4 MiB"
};
struct ShownRatio {
  Ratio ratio;
  std::string text;  // "12.3 s/6 s = 2.05"
};

// Empty when the case cannot support anything; `why` then says so: "no record".
std::optional<ShownTime> time_of(const CaseTable& cases, const std::string& mesh,
                                 const std::string& method, std::string& why);
ShownRatio shown_ratio(const ShownTime& numerator, const ShownTime& denominator);

// "1.34 [1.3, 1.38]", "1.34" (no spread: single samples), "~5.2 above 3.1", "~0.2 below 0.4",
// "~2.1 (no bound)": both ran out of time.
std::string show_ratio(const Ratio& ratio);

class Evidence {
 public:
  explicit Evidence(const CaseTable& cases) : cases_(cases) {}

  // What the claim needs: where it is empty, the claim cannot be reproduced any more.
  std::optional<ShownTime> time(const std::string& mesh, const std::string& method);
  std::optional<ShownBytes> peak_heap(const std::string& mesh, const std::string& method);
  std::optional<ShownBytes> storage(const std::string& mesh, const std::string& method);

  void figure(std::string text) { claim_.figures.push_back(std::move(text)); }
  void interval(std::string text) { claim_.intervals.push_back(std::move(text)); }
  // The claim is the conjunction of its parts; an undecided one needs a reason.
  void part(Verdict verdict, const std::string& if_undecided);
  // The verdict on a ratio, which is shown with its interval.
  void part(const std::string& label, const Ratio& ratio, Verdict verdict);

  // A case that the claim needs and that is of no use.
  void missing(const std::string& mesh, const std::string& method, const std::string& why);

  using RatioOn = std::function<std::optional<ShownRatio>(const std::string& mesh)>;
  using Test = std::function<Verdict(const Interval&)>;
  // A ratio on every mesh as a figure; geometric mean and range as an interval, which is tested
  // when no mesh is without. No test: for information only.
  void over_meshes(const std::string& label, const std::vector<std::string>& meshes,
                   const RatioOn& ratio_on, const Test& test);
  void times_over_meshes(const std::string& numerator, const std::string& denominator,
                         const std::vector<std::string>& meshes, const Test& test);

  Claim claim(int number, std::string sentence) const;
  const CaseTable& cases() const { return cases_; }

 private:
  std::optional<ShownBytes> bytes(const std::string& mesh, const std::string& method,
                                  std::optional<std::int64_t> Record::*value, const char* name);

  const CaseTable& cases_;
  Claim claim_;
  std::vector<Verdict> parts_;
  struct Missing {
    std::string why, method;
    std::vector<std::string> meshes;
  };
  std::vector<Missing> missing_;
};

// The meshes that have a record of any of these methods.
std::vector<std::string> meshes_with(const CaseTable& cases,
                                     const std::vector<std::string>& methods);

// "a, b, c"
std::string joined(const std::vector<std::string>& texts, const char* separator = ", ");

}  // namespace airybench
