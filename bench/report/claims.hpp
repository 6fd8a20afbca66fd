// The paper's sentences on time and memory (its sections 3.2, 3.3 and 4), tested against records:
// cases by their methods' names, ratios of times and memories with intervals, verdicts on
// inequalities between them, and the claims made of these.
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

enum class Verdict { not_reproduced, undecided, reproduced };
std::string_view name_of(Verdict verdict);
Verdict opposite(Verdict verdict);                     // of an undecided one: undecided
Verdict all_of(const std::vector<Verdict>& verdicts);  // the least of them; of none: reproduced

// Is the quantity in (low, high] of the range? Undecided where one of its bounds is inside the
// quantity's interval.
Verdict is_within(const Interval& quantity, const Interval& range);
inline constexpr double infinity = std::numeric_limits<double>::infinity();

// The time of a case. One that its time limit stopped has no samples: it takes longer than
// at_least_s, and by estimate figure_s.
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
  bool estimated = false;  // the figure rests on an extrapolated time
  std::string text = {};   // "12.3 s/6 s = 2.05"
};

// Of the medians: 95 % bootstrap interval with a fixed seed; one sample on either side is taken as
// exact. Timed-out cases enter with their lower bounds.
Ratio ratio_of(const CaseTime& numerator, const CaseTime& denominator);
// Over several meshes: geometric mean, smallest and largest. A ratio counts with its figure, one
// that rests on an extrapolated time with its bounds. Not for an empty list.
Ratio spread(const std::vector<Ratio>& ratios);
// "1.34 [1.3, 1.38]", "1.34" (no spread: single samples), "~5.2 above 3.1", "~0.2 below 0.4",
// "~2.1 (no bound)": both ran out of time.
std::string show_ratio(const Ratio& ratio);

// The paper's names for methods that have a general one, as its sentences use them.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 5> paper_names = {{
    {"SDTIC3", "SYMMLQ:DTIC3"},
    {"SDTIC6", "SYMMLQ:DTIC6"},
    {"SSKY", "SYMMLQ:SKY"},
    {"3STEPCG3", "3STEPCG:DTIC3"},
    {"3STEPCG6", "3STEPCG:DTIC6"},
}};

// The cases of one stop and one scene, found under any of their method's names.
class CaseTable {
 public:
  // Keeps the records of the stop and of the default scene, or of the only scene there is; a direct
  // method (no stop to choose) that has none of this stop serves with the other one's. Of several
  // records of a case the last one counts. Throws RecordError: several scenes, none of them the
  // default one; `source` is the file that it names.
  CaseTable(const std::vector<Record>& records, const std::string& stop, const std::string& source);

  const Record* find(const std::string& mesh, const std::string& method) const;  // or null
  // Empty when the case cannot support anything; `why` then says so: "no record".
  std::optional<CaseTime> time(const std::string& mesh, const std::string& method,
                               std::string* why = nullptr) const;
  std::vector<const Record*> cases_on(const std::string& mesh) const;  // by general names
  const std::vector<std::string>& meshes() const { return meshes_; }   // as they first appear
  // The meshes that have a record of any of these methods.
  std::vector<std::string> meshes_with(const std::vector<std::string>& methods) const;
  // The mesh with most preconditioners among its records; Mesh3, the paper's, where several have as
  // many. Empty: no records.
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
  std::vector<std::string> figures;    // what was measured, ~: extrapolated
  std::vector<std::string> intervals;  // of the ratios on which the verdict rests
  Verdict verdict = Verdict::undecided;
  std::vector<std::string> open;  // what is missing, of no use, or not decided by its interval
};

// Collects the figures, intervals and verdicts of one claim.
class Evidence {
 public:
  explicit Evidence(const CaseTable& cases) : cases_(cases) {}
  const CaseTable& cases() const { return cases_; }

  // What the claim needs: where it is empty, the claim cannot be reproduced any more.
  std::optional<CaseTime> time(const std::string& mesh, const std::string& method);
  std::optional<CaseBytes> bytes(const std::string& mesh, const std::string& method,
                                 const char* field);
  // A case that the claim needs and that is of no use.
  void missing(const std::string& mesh, const std::string& method, const std::string& why);

  void figure(std::string text) { claim_.figures.push_back(std::move(text)); }
  void interval(std::string text) { claim_.intervals.push_back(std::move(text)); }
  // The claim is the conjunction of its parts; an undecided one needs a reason.
  void part(Verdict verdict, const std::string& if_undecided);
  // That a ratio is in (low, high] of the range. It is shown with its interval.
  void part(const std::string& label, const Ratio& ratio, const Interval& range);
  // A ratio on every mesh as a figure; geometric mean and range as an interval, which is tested
  // when no mesh is without. No range: for information only.
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
  std::vector<Verdict> parts_;
  // Why → methods, each with its meshes.
  std::map<std::string, std::vector<std::pair<std::string, std::vector<std::string>>>> missing_;
};

// Preconditioners (the paper's Fig. 3), then methods (its Figs 4, 5), then the rest.
std::vector<Claim> check_claims(const CaseTable& cases);

// "a, b, c"
std::string joined(const std::vector<std::string>& texts, const char* separator = ", ");

}  // namespace airybench
