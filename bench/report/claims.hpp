// The paper's sentences on time and memory (its sections 3.2, 3.3 and 4), tested against records:
// ratios of times and memories with intervals, verdicts on inequalities between them, and claims
// made of these.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/records/record_reader.hpp"
#include "bench/records/robust.hpp"

namespace airybench {

enum class ClaimVerdict { not_reproduced, undecided, reproduced };  // the least of several decides
std::string_view name_of(ClaimVerdict verdict);
// Is the quantity in (low, high]? Undecided if a bound of the range is inside its interval.
ClaimVerdict is_within(const Interval& quantity, const Interval& range);
inline constexpr double infinity = std::numeric_limits<double>::infinity();

// A timeout has no samples: its time is above at_least_s, figure_s is an estimate.
struct CaseTime {
  double figure_s = 0;
  std::vector<double> samples_s;
  double at_least_s = 0;
  std::string text = {};  // "12.3 s", "12.3 s (inaccurate)", "~120 s (timeout, above 60 s)"
  bool timed_out() const { return samples_s.empty(); }
};

struct CaseBytes {
  double bytes = 0;
  std::string text;  // "3.4 MiB"
};

struct Ratio {
  double figure = 0;
  Interval interval;
  bool estimated = false;  // rests on an extrapolated time
  std::string text = {};   // "12.3 s/6 s = 2.05"
};

// Of the medians, with a 95 % bootstrap interval (fixed seed). A single sample counts as exact, a
// timeout with its lower bound.
Ratio ratio_of(const CaseTime& numerator, const CaseTime& denominator);
// Geometric mean and range, with the bounds of estimated ratios. `ratios` must not be empty.
Ratio spread(const std::vector<Ratio>& ratios);
// "1.34", "1.34 [1.3, 1.38]", "~5.2 above 3.1", "~0.2 below 0.4", "~2.1 (no bound)".
std::string show_ratio(const Ratio& ratio);

inline constexpr std::array<std::pair<std::string_view, std::string_view>, 5> paper_names = {{
    {"SDTIC3", "SYMMLQ:DTIC3"},
    {"SDTIC6", "SYMMLQ:DTIC6"},
    {"SSKY", "SYMMLQ:SKY"},
    {"3STEPCG3", "3STEPCG:DTIC3"},
    {"3STEPCG6", "3STEPCG:DTIC6"},
}};

class CaseTable {
 public:
  // Keeps the records of the stop and of the default (or only) scene. Direct methods have no stop:
  // records of the other stop count if there are none of this one. The last record of a case
  // counts. Throws RecordError, with `source`: several scenes, no default one.
  CaseTable(const std::vector<Record>& records, const std::string& stop, const std::string& source);

  const Record* find(const std::string& mesh, const std::string& method) const;  // or null
  // Empty if the case has no usable time; `why` is then the reason ("no record").
  std::optional<CaseTime> time(const std::string& mesh, const std::string& method,
                               std::string* why = nullptr) const;
  std::vector<const Record*> cases_on(const std::string& mesh) const;  // by general name
  const std::vector<std::string>& meshes() const { return meshes_; }   // in order of appearance
  std::vector<std::string> meshes_with(const std::vector<std::string>& methods) const;
  // The mesh with most preconditioned records; of several, Mesh3 (the paper's). Empty: no records.
  std::string preconditioner_mesh() const;
  const std::string& scene() const { return scene_; }
  std::size_t size() const { return cases_.size(); }

 private:
  std::string scene_ = "default";
  std::vector<std::string> meshes_;
  std::map<std::pair<std::string, std::string>, Record> cases_;  // (mesh, general name)
};

struct Claim {
  std::string sentence;                // with the paper's section
  std::vector<std::string> figures;    // measured; ~: extrapolated
  std::vector<std::string> intervals;  // of the ratios that decide
  ClaimVerdict verdict = ClaimVerdict::undecided;
  std::vector<std::string> open;  // missing, unusable or undecided
};

class Evidence {
 public:
  explicit Evidence(const CaseTable& cases) : cases_(cases) {}
  const CaseTable& cases() const { return cases_; }

  // If these return nothing, the claim can no longer be reproduced.
  std::optional<CaseTime> time(const std::string& mesh, const std::string& method);
  std::optional<CaseBytes> bytes(const std::string& mesh, const std::string& method,
                                 const char* field);
  void missing(const std::string& mesh, const std::string& method, const std::string& why);

  void figure(std::string text) { claim_.figures.push_back(std::move(text)); }
  void interval(std::string text) { claim_.intervals.push_back(std::move(text)); }
  // Adds one condition of the claim; undecided needs a reason.
  void part(ClaimVerdict verdict, const std::string& if_undecided);
  // Adds the condition that a ratio is in (low, high]; shows its interval.
  void part(const std::string& label, const Ratio& ratio, const Interval& range);
  // Shows a ratio per mesh, with geometric mean and range. Tests these if a range is given and no
  // mesh lacks a ratio.
  void over_meshes(const std::string& label, const std::vector<std::string>& meshes,
                   const std::function<std::optional<Ratio>(const std::string& mesh)>& ratio_on,
                   const std::optional<Interval>& range);
  void times_over_meshes(const std::string& numerator, const std::string& denominator,
                         const std::vector<std::string>& meshes,
                         const std::optional<Interval>& range);

  Claim claim(const std::string& sentence) const;

 private:
  const CaseTable& cases_;
  Claim claim_;
  std::vector<ClaimVerdict> parts_;
  std::map<std::string, std::vector<std::pair<std::string, std::vector<std::string>>>> missing_;
};

std::vector<Claim> check_claims(const CaseTable& cases);

}  // namespace airybench
