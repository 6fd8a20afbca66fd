#include "bench/report/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "support/lists.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

constexpr double same_time = 1.5;      // factor within which two times are "the same"
constexpr double same_memory = 1.5;    // the same for memory
constexpr double slow = 2;             // factor from which a preconditioner is "slow"
constexpr double omega_radius = 0.25;  // "near 1"
constexpr double contact_share = 0.01;
constexpr Interval longer = {1, infinity};

// Figs 4 and 5.
const std::vector<std::string> with_dtic = {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6"};
const std::vector<std::string> seven = {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6",
                                        "SSKY",   "3STEPD",   "ALM"};

// SYMMLQ (Fig. 3), and 3STEPCG if it has records of the preconditioner.
std::vector<std::string> families_with(const Evidence& evidence, const std::string& mesh,
                                       const std::string& preconditioner) {
  const bool both = std::ranges::any_of(evidence.cases().cases_on(mesh), [&](const Record* record) {
    return record->family == "3STEPCG" && record->preconditioner.starts_with(preconditioner);
  });
  return both ? std::vector<std::string>{"SYMMLQ", "3STEPCG"} : std::vector<std::string>{"SYMMLQ"};
}

std::map<int, CaseTime> times_of_levels(Evidence& evidence, const std::string& mesh,
                                        const std::string& family, const std::string& name,
                                        int first, int last) {
  std::map<int, CaseTime> times;
  std::vector<std::string> texts;
  for (int x = first; x <= last; ++x)
    if (const auto time = evidence.time(mesh, fmt::format("{}:{}{}", family, name, x))) {
      times[x] = *time;
      texts.push_back(fmt::format("{}{} {}", name, x, time->text));
    }
  if (!texts.empty()) evidence.figure(fmt::format("{}, {}: {}", mesh, family, joined(texts)));
  return times;
}

void larger_x_makes_dtic_faster(Evidence& evidence) {
  const std::string mesh = evidence.cases().preconditioner_mesh();
  for (const std::string family : {"SYMMLQ", "3STEPCG"}) {
    const auto times = times_of_levels(evidence, mesh, family, "DTIC", 3, 6);
    for (int x = 3; x < 6; ++x) {
      if (!times.contains(x) || !times.contains(x + 1)) continue;
      const Ratio ratio = ratio_of(times.at(x), times.at(x + 1));
      evidence.part(fmt::format("{} DTIC{}/DTIC{}", family, x, x + 1), ratio, longer);
    }
  }
}

void flic_is_fastest_near_3(Evidence& evidence) {
  const std::string mesh = evidence.cases().preconditioner_mesh();
  for (const std::string& family : families_with(evidence, mesh, "FLIC")) {
    const auto times = times_of_levels(evidence, mesh, family, "FLIC", 1, 5);
    if (times.size() < 5) continue;
    const int best = std::min(
        {2, 3, 4}, [&](int a, int b) { return times.at(a).figure_s < times.at(b).figure_s; });
    for (const int end : {1, 5}) {
      const Ratio ratio = ratio_of(times.at(end), times.at(best));
      evidence.part(fmt::format("{} FLIC{}/FLIC{}", family, end, best), ratio, longer);
    }
  }
}

// 4 as in the paper, or the level whose memory is nearest to DTIC3's. 0: no records.
int flic_level_of_equal_memory(Evidence& evidence, const std::string& mesh,
                               const std::string& family) {
  const auto dtic = evidence.bytes(mesh, family + ":DTIC3", "storage_bytes");
  const auto flic4 = evidence.bytes(mesh, family + ":FLIC4", "storage_bytes");
  if (!dtic || !flic4) return 0;
  evidence.figure(
      fmt::format("{}, {}: memory DTIC3 {}, FLIC4 {}", mesh, family, dtic->text, flic4->text));
  const auto distance = [&](double bytes) { return std::abs(std::log(bytes / dtic->bytes)); };
  int level = 4;
  double nearest = flic4->bytes;
  if (distance(nearest) <= std::log(same_memory)) return level;
  for (const int x : {1, 2, 3, 5}) {
    const Record* record = evidence.cases().find(mesh, fmt::format("{}:FLIC{}", family, x));
    if (record == nullptr || !record->storage_bytes) continue;
    const auto bytes = static_cast<double>(*record->storage_bytes);
    if (distance(bytes) >= distance(nearest)) continue;
    nearest = bytes;
    level = x;
  }
  evidence.figure(
      fmt::format("{}: FLIC4's memory is not DTIC3's, the nearest is FLIC{}'s, {:.3g} "
                  "times as much",
                  family, level, nearest / dtic->bytes));
  if (distance(nearest) > std::log(same_memory))
    evidence.part(
        ClaimVerdict::undecided,
        fmt::format("{}: no FLIC has DTIC3's memory within a factor {}", family, same_memory));
  return level;
}

void dtic_beats_flic_at_equal_memory(Evidence& evidence) {
  const std::string mesh = evidence.cases().preconditioner_mesh();
  const std::string family = "SYMMLQ";  // 3STEPCG's memory is mostly S⁻¹Cᵀ
  const int level = flic_level_of_equal_memory(evidence, mesh, family);
  const auto dtic = evidence.time(mesh, family + ":DTIC3");
  const auto flic = evidence.time(mesh, fmt::format("{}:FLIC{}", family, std::max(level, 1)));
  if (level == 0 || !dtic || !flic) return;
  const Ratio ratio = ratio_of(*flic, *dtic);
  const std::string label = fmt::format("{} FLIC{}/DTIC3", family, level);
  evidence.figure(label + ": " + ratio.text);
  evidence.part(label, ratio, longer);
}

bool is_near_one(double omega) { return std::abs(omega - 1) <= omega_radius; }

std::map<double, CaseTime> ssor_times(Evidence& evidence, const std::string& mesh,
                                      const std::string& family) {
  std::map<double, CaseTime> times;
  std::vector<std::string> texts;
  for (const Record* record : evidence.cases().cases_on(mesh)) {
    const std::string_view name = record->preconditioner;
    if (record->general_name != fmt::format("{}:{}", family, name) || !name.starts_with("SSOR"))
      continue;
    const std::optional<double> omega = parse_number(name.substr(4));
    if (!omega) continue;  // not one of the paper's
    std::string why;       // an ω without an answer is not the best
    const auto time = evidence.cases().time(mesh, record->general_name, &why);
    if (time) times[*omega] = *time;
    texts.push_back(fmt::format("ω={} {}", *omega, time ? time->text : why));
  }
  if (!texts.empty()) evidence.figure(fmt::format("{}, {}: {}", mesh, family, joined(texts)));
  return times;
}

// Every ω that may be the best must be near 1; needs times near 1 and on both sides of it.
void best_omega_is_near_one(Evidence& evidence, const std::string& family,
                            const std::map<double, CaseTime>& times, double best) {
  if (std::ranges::none_of(times, is_near_one, &std::pair<const double, CaseTime>::first) ||
      times.begin()->first >= 1 - omega_radius || times.rbegin()->first <= 1 + omega_radius) {
    evidence.part(ClaimVerdict::undecided,
                  fmt::format("{}: SSOR needs an ω below {}, one above {} and one between", family,
                              1 - omega_radius, 1 + omega_radius));
    return;
  }
  bool near = false, far = false;
  std::vector<std::string> candidates;
  for (const auto& [omega, time] : times)
    if (omega == best ||
        is_within(ratio_of(time, times.at(best)).interval, longer) != ClaimVerdict::reproduced) {
      (is_near_one(omega) ? near : far) = true;
      candidates.push_back(fmt::format("{}", omega));
    }
  evidence.figure(fmt::format("{}: best ω: {}", family, joined(candidates, " or ")));
  evidence.part(near && far ? ClaimVerdict::undecided
                            : (near ? ClaimVerdict::reproduced : ClaimVerdict::not_reproduced),
                fmt::format("{}: the best ω may be near 1 or not", family));
}

void ssor_is_best_near_1_and_slow(Evidence& evidence) {
  const std::string mesh = evidence.cases().preconditioner_mesh();
  for (const std::string& family : families_with(evidence, mesh, "SSOR")) {
    const auto times = ssor_times(evidence, mesh, family);
    if (times.empty()) {
      evidence.missing(mesh, family + ":SSOR", "no time");
      continue;
    }
    const auto best =
        std::ranges::min_element(times, {}, [](const auto& time) { return time.second.figure_s; });
    best_omega_is_near_one(evidence, family, times, best->first);
    const auto dtic = evidence.time(mesh, family + ":DTIC3");
    if (!dtic) continue;
    const Ratio ratio = ratio_of(best->second, *dtic);
    evidence.figure(fmt::format("{}: DTIC3 {}", family, dtic->text));
    evidence.part(fmt::format("{} SSOR{}/DTIC3", family, best->first), ratio, {slow, infinity});
  }
}

void symmlq_and_3stepcg_take_the_same_time(Evidence& evidence) {
  const auto meshes = evidence.cases().meshes_with(with_dtic);
  const Interval same = {1 / same_time, same_time};
  evidence.times_over_meshes("SDTIC3", "3STEPCG3", meshes, same);
  evidence.times_over_meshes("SDTIC6", "3STEPCG6", meshes, same);
}

void iterative_reach_direct_only_with_sky(Evidence& evidence) {
  std::vector<std::string> methods = with_dtic;
  methods.insert(methods.end(), {"SSKY", "3STEPD"});
  const auto meshes = evidence.cases().meshes_with(methods);
  evidence.times_over_meshes("SSKY", "3STEPD", meshes, Interval{-infinity, same_time});
  for (const std::string& method : with_dtic)
    evidence.times_over_meshes(method, "3STEPD", meshes, Interval{same_time, infinity});
}

void alm_is_slightly_faster_than_3stepd(Evidence& evidence) {
  const CaseTable& cases = evidence.cases();
  const auto meshes = cases.meshes_with({"ALM", "3STEPD"});
  evidence.times_over_meshes("ALM", "3STEPD", meshes, Interval{1 / same_time, 1});
  const auto with_tuning = [&](const std::string& mesh) -> std::optional<Ratio> {
    auto alm = cases.time(mesh, "ALM");
    const auto direct = cases.time(mesh, "3STEPD");
    if (!alm || !direct || !cases.find(mesh, "ALM")->tuning_s) return {};
    const double tuning_s = *cases.find(mesh, "ALM")->tuning_s;
    alm->text = fmt::format("({} + {:.3g} s)", alm->text, tuning_s);
    alm->figure_s += tuning_s;
    alm->at_least_s += tuning_s;
    for (double& sample : alm->samples_s) sample += tuning_s;
    return ratio_of(*alm, *direct);
  };
  evidence.over_meshes("not in the claim: (ALM + its tuning)/3STEPD", meshes, with_tuning, {});
}

void alm_needs_the_least_memory(Evidence& evidence) {
  std::vector<Ratio> to_least;
  for (const std::string& mesh : evidence.cases().meshes_with(seven)) {
    const auto alm = evidence.bytes(mesh, "ALM", "peak_heap_bytes");
    std::optional<CaseBytes> least;
    std::string least_method, direct = "3STEPD -";
    for (const std::string& method : seven) {
      if (method == "ALM") continue;
      const auto other = evidence.bytes(mesh, method, "peak_heap_bytes");
      if (!other) continue;
      if (method == "3STEPD") direct = "3STEPD " + other->text;
      if (least && other->bytes >= least->bytes) continue;
      least = other;
      least_method = method;
    }
    if (!alm || !least) continue;
    const double ratio = alm->bytes / least->bytes;
    to_least.push_back({ratio, {ratio, ratio}});
    evidence.figure(fmt::format("{}: ALM {}, {}, least but ALM {} {}", mesh, alm->text, direct,
                                least_method, least->text));
    evidence.part(ratio < 1 ? ClaimVerdict::reproduced : ClaimVerdict::not_reproduced, "");
  }
  if (!to_least.empty())
    evidence.interval("ALM/least of the others " + show_ratio(spread(to_least)));
}

bool is_condensing(const Record* record) {
  constexpr std::array<std::string_view, 4> condensing = {"3STEPD", "BLIND", "3STEPCG", "SYMMLQ"};
  return std::ranges::find(condensing, record->family) != condensing.end();
}

bool is_swept(const Record& record) {
  return record.contact_solver.value_or(implied_contact_solver(record.stop, record.knob)) ==
         ContactSolver::gauss_seidel;
}

void gauss_seidel_takes_under_1_percent(Evidence& evidence) {
  int cases = 0, below = 0, without_time = 0, by_others = 0;
  Interval range = {1, 0};
  std::vector<std::string> largest_shares;  // one per mesh
  for (const std::string& mesh : evidence.cases().meshes()) {
    double largest = -1;
    std::string text;
    for (const Record* record : evidence.cases().cases_on(mesh)) {
      if (!is_condensing(record)) continue;
      if (!has_answer(record->status) || !record->time_s || !record->stage_contact_s) {
        ++without_time;
        continue;
      }
      if (!is_swept(*record)) {
        ++by_others;
        continue;
      }
      const double share = *record->stage_contact_s / *record->time_s;
      ++cases;
      if (share < contact_share) ++below;
      range = {std::min(range.low, share), std::max(range.high, share)};
      if (share <= largest) continue;
      largest = share;
      text = fmt::format("{} {:.2g} % ({}{})", mesh, 100 * share, record->method,
                         record->status == Status::inaccurate ? ", inaccurate" : "");
    }
    if (!text.empty()) largest_shares.push_back(text);
  }
  if (by_others > 0)
    evidence.figure(fmt::format("{} cases by active sets, not by Gauss–Seidel", by_others));
  if (cases == 0) {
    if (by_others > 0)
      evidence.part(ClaimVerdict::undecided, "no case by Gauss–Seidel, which --stop=paper takes");
    return;
  }
  evidence.figure("largest share: " + joined(largest_shares));
  evidence.figure(
      fmt::format("under 1 % in {} of {} cases; {} without a time", below, cases, without_time));
  evidence.interval(fmt::format("share [{:.2g} %, {:.2g} %]", 100 * range.low, 100 * range.high));
  evidence.part(
      range.high < contact_share ? ClaimVerdict::reproduced : ClaimVerdict::not_reproduced, "");
}

void blind_condensation_is_too_expensive(Evidence& evidence) {
  evidence.times_over_meshes("BLIND", "3STEPD", evidence.cases().meshes_with({"BLIND"}), longer);
  for (const char* ours : {"BLIND:SCHUR", "BLIND:SKY"})
    evidence.times_over_meshes(ours, "3STEPD", evidence.cases().meshes_with({ours}), {});
}

}  // namespace

std::vector<Claim> check_claims(const CaseTable& cases) {
  const std::vector<std::pair<std::string, void (*)(Evidence&)>> sentences = {
      {"A larger x makes DTICx faster (4.0.2)", larger_x_makes_dtic_faster},
      {"FLICx is fastest at an inner x, near 3 (4.0.2); here: 3 ± 1", flic_is_fastest_near_3},
      {"DTIC beats FLIC at equal memory, e.g. DTIC3 and FLIC4 (4.0.2)",
       dtic_beats_flic_at_equal_memory},
      {fmt::format("SSOR is best with ω near 1, and slow (4.0.2); here: 1 ± {}, {} times DTIC3's "
                   "time",
                   omega_radius, slow),
       ssor_is_best_near_1_and_slow},
      {fmt::format("SYMMLQ and 3STEPCG take the same time with the same preconditioner (4.0.3); "
                   "here: within a factor {}",
                   same_time),
       symmlq_and_3stepcg_take_the_same_time},
      {fmt::format("Iterative methods are as fast as 3STEPD only with SKY (4.0.3); here: as fast "
                   "up to a factor {}",
                   same_time),
       iterative_reach_direct_only_with_sky},
      {fmt::format("ALM takes the same time as 3STEPD, slightly less (4.0.3); here: between 1/{} "
                   "and 1 of it",
                   same_time),
       alm_is_slightly_faster_than_3stepd},
      {"ALM needs the least memory of all, less than 3STEPD (4.0.3)", alm_needs_the_least_memory},
      {"Gauss–Seidel usually takes under 1 % of the time (3.3); here: in every condensing case",
       gauss_seidel_takes_under_1_percent},
      {"Blind condensation is too expensive (3.2.1); here: slower than 3STEPD",
       blind_condensation_is_too_expensive}};
  std::vector<Claim> claims;
  for (const auto& [sentence, check] : sentences) {
    Evidence evidence(cases);
    check(evidence);
    claims.push_back(evidence.claim(sentence));
  }
  return claims;
}

}  // namespace airybench
