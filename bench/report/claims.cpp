#include "bench/report/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bench/report/claims_evidence.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

constexpr double same_time = 1.5;      // factor within which two times are "the same"
constexpr double same_memory = 1.5;    // and two memories
constexpr double slow = 2;             // factor from which a preconditioner is "slow"
constexpr double omega_radius = 0.25;  // "near 1"
constexpr double contact_share = 0.01;

const std::vector<std::string> families = {"SYMMLQ", "3STEPCG"};  // with preconditioners
const std::vector<std::string> seven = {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6",
                                        "SSKY",   "3STEPD",   "ALM"};  // of Figs 4, 5

bool starts_with(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0;
}

// SYMMLQ, which is what Fig. 3 shows, and 3STEPCG where it has records of the preconditioner too.
std::vector<std::string> families_with(const CaseTable& cases, const std::string& mesh,
                                       const std::string& preconditioner) {
  std::vector<std::string> result = {"SYMMLQ"};
  for (const std::string& method : cases.methods(mesh))
    if (starts_with(method, "3STEPCG:" + preconditioner)) return families;
  return result;
}

Claim larger_x_makes_dtic_faster(const CaseTable& cases) {
  Evidence evidence(cases);
  const std::string mesh = preconditioner_mesh(cases);
  for (const std::string& family : families) {
    std::vector<std::optional<ShownTime>> times;
    std::vector<std::string> texts;
    for (int x = 3; x <= 6; ++x) {
      times.push_back(evidence.time(mesh, fmt::format("{}:DTIC{}", family, x)));
      if (times.back()) texts.push_back(fmt::format("DTIC{} {}", x, times.back()->text));
    }
    if (!texts.empty()) evidence.figure(fmt::format("{}, {}: {}", mesh, family, joined(texts)));
    for (int x = 3; x < 6; ++x) {
      const auto &smaller = times[x - 3], &larger = times[x - 2];
      if (!smaller || !larger) continue;
      const Ratio ratio = ratio_of(smaller->time, larger->time);
      evidence.part(fmt::format("{} DTIC{}/DTIC{}", family, x, x + 1), ratio,
                    is_above(ratio.interval, 1));
    }
  }
  return evidence.claim(1, "A larger x makes DTICx faster (4.0.2)");
}

// Both ends are slower than the best inner level.
void flic_has_an_inner_optimum(Evidence& evidence, const std::string& mesh,
                               const std::string& family) {
  std::map<int, ShownTime> times;
  std::vector<std::string> texts;
  for (int x = 1; x <= 5; ++x)
    if (const auto time = evidence.time(mesh, fmt::format("{}:FLIC{}", family, x))) {
      times[x] = *time;
      texts.push_back(fmt::format("FLIC{} {}", x, time->text));
    }
  if (!texts.empty()) evidence.figure(fmt::format("{}, {}: {}", mesh, family, joined(texts)));
  if (times.size() < 5) return;
  int best = 2;
  for (const int x : {3, 4})
    if (times[x].time.figure_s < times[best].time.figure_s) best = x;
  for (const int end : {1, 5}) {
    const Ratio ratio = ratio_of(times[end].time, times[best].time);
    evidence.part(fmt::format("{} FLIC{}/FLIC{}", family, end, best), ratio,
                  is_above(ratio.interval, 1));
  }
}

Claim flic_is_fastest_near_3(const CaseTable& cases) {
  Evidence evidence(cases);
  const std::string mesh = preconditioner_mesh(cases);
  for (const std::string& family : families_with(cases, mesh, "FLIC"))
    flic_has_an_inner_optimum(evidence, mesh, family);
  return evidence.claim(2, "FLICx is fastest at an inner x, near 3 (4.0.2); here: 3 ± 1");
}

// 4 as in the paper; where its memory is not DTIC3's, the level whose memory is nearest. 0: none.
int flic_level_of_equal_memory(Evidence& evidence, const std::string& mesh,
                               const std::string& family) {
  const auto dtic = evidence.storage(mesh, family + ":DTIC3");
  const auto flic4 = evidence.storage(mesh, family + ":FLIC4");
  if (!dtic || !flic4) return 0;
  const auto distance = [&](double bytes) { return std::abs(std::log(bytes / dtic->bytes)); };
  int level = 4;
  double nearest = flic4->bytes;
  evidence.figure(
      fmt::format("{}, {}: memory DTIC3 {}, FLIC4 {}", mesh, family, dtic->text, flic4->text));
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
  if (distance(nearest) <= std::log(same_memory)) return level;
  evidence.part(Verdict::undecided, fmt::format("{}: no FLIC has DTIC3's memory within a factor {}",
                                                family, same_memory));
  return level;
}

Claim dtic_beats_flic_at_equal_memory(const CaseTable& cases) {
  Evidence evidence(cases);
  const std::string mesh = preconditioner_mesh(cases);
  const std::string family = "SYMMLQ";  // 3STEPCG's memory is mostly S⁻¹Cᵀ
  const int level = flic_level_of_equal_memory(evidence, mesh, family);
  const auto dtic = evidence.time(mesh, family + ":DTIC3");
  const auto flic = evidence.time(mesh, fmt::format("{}:FLIC{}", family, std::max(level, 1)));
  if (level > 0 && dtic && flic) {
    const ShownRatio shown = shown_ratio(*flic, *dtic);
    const std::string label = fmt::format("{} FLIC{}/DTIC3", family, level);
    evidence.figure(label + ": " + shown.text);
    evidence.part(label, shown.ratio, is_above(shown.ratio.interval, 1));
  }
  return evidence.claim(3, "DTIC beats FLIC at equal memory, e.g. DTIC3 and FLIC4 (4.0.2)");
}

bool is_near_one(double omega) { return std::abs(omega - 1) <= omega_radius; }

std::map<double, ShownTime> ssor_times(Evidence& evidence, const std::string& mesh,
                                       const std::string& family) {
  const std::string prefix = family + ":SSOR";
  std::map<double, ShownTime> times;
  std::vector<std::string> texts;
  for (const std::string& method : evidence.cases().methods(mesh)) {
    if (!starts_with(method, prefix)) continue;
    const std::optional<double> omega = parse_number(method.substr(prefix.size()));
    if (!omega) continue;  // a variant of ours
    std::string why;       // an omega that gives no answer is not the best one
    const auto time = time_of(evidence.cases(), mesh, method, why);
    if (time) times[*omega] = *time;
    texts.push_back(fmt::format("ω={} {}", *omega, time ? time->text : why));
  }
  if (!texts.empty()) evidence.figure(fmt::format("{}, {}: {}", mesh, family, joined(texts)));
  return times;
}

// Those that may be the best are near 1, and there are some on both sides that are not.
void best_omega_is_near_one(Evidence& evidence, const std::string& family,
                            const std::map<double, ShownTime>& times, double best) {
  const auto any = [&](auto test) {
    return std::any_of(times.begin(), times.end(), [&](const auto& t) { return test(t.first); });
  };
  if (!any(is_near_one) || !any([](double w) { return w < 1 - omega_radius; }) ||
      !any([](double w) { return w > 1 + omega_radius; })) {
    evidence.part(Verdict::undecided,
                  fmt::format("{}: SSOR needs an ω below {}, one above {} and one between", family,
                              1 - omega_radius, 1 + omega_radius));
    return;
  }
  bool near = false, far = false;
  std::vector<std::string> candidates;
  for (const auto& [omega, time] : times)
    if (omega == best ||
        is_above(ratio_of(time.time, times.at(best).time).interval, 1) != Verdict::reproduced) {
      (is_near_one(omega) ? near : far) = true;
      candidates.push_back(fmt::format("{}", omega));
    }
  evidence.figure(fmt::format("{}: best ω: {}", family, joined(candidates, " or ")));
  evidence.part(
      near && far ? Verdict::undecided : (near ? Verdict::reproduced : Verdict::not_reproduced),
      fmt::format("{}: the best ω may be near 1 or not", family));
}

Claim ssor_is_best_near_1_and_slow(const CaseTable& cases) {
  Evidence evidence(cases);
  const std::string mesh = preconditioner_mesh(cases);
  for (const std::string& family : families_with(cases, mesh, "SSOR")) {
    const auto times = ssor_times(evidence, mesh, family);
    if (times.empty()) {
      evidence.missing(mesh, family + ":SSOR", "no time");
      continue;
    }
    const auto best =
        std::min_element(times.begin(), times.end(), [](const auto& a, const auto& b) {
          return a.second.time.figure_s < b.second.time.figure_s;
        });
    best_omega_is_near_one(evidence, family, times, best->first);
    const auto dtic = evidence.time(mesh, family + ":DTIC3");
    if (!dtic) continue;
    const Ratio ratio = ratio_of(best->second.time, dtic->time);
    evidence.figure(fmt::format("{}: DTIC3 {}", family, dtic->text));
    evidence.part(fmt::format("{} SSOR{}/DTIC3", family, best->first), ratio,
                  is_above(ratio.interval, slow));
  }
  return evidence.claim(
      4, fmt::format("SSOR is best with ω near 1, and slow (4.0.2); here: 1 ± {}, {} times DTIC3's "
                     "time",
                     omega_radius, slow));
}

Verdict is_same_time(const Interval& ratio) { return is_within_factor(ratio, same_time); }
Verdict reaches(const Interval& ratio) { return opposite(is_above(ratio, same_time)); }
Verdict does_not_reach(const Interval& ratio) { return is_above(ratio, same_time); }

Claim symmlq_and_3stepcg_take_the_same_time(const CaseTable& cases) {
  Evidence evidence(cases);
  const auto meshes = meshes_with(cases, {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6"});
  evidence.times_over_meshes("SDTIC3", "3STEPCG3", meshes, is_same_time);
  evidence.times_over_meshes("SDTIC6", "3STEPCG6", meshes, is_same_time);
  return evidence.claim(5, fmt::format("SYMMLQ and 3STEPCG take the same time with the same "
                                       "preconditioner (4.0.3); here: within a factor {}",
                                       same_time));
}

Claim iterative_reach_direct_only_with_sky(const CaseTable& cases) {
  Evidence evidence(cases);
  const auto meshes =
      meshes_with(cases, {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6", "SSKY", "3STEPD"});
  evidence.times_over_meshes("SSKY", "3STEPD", meshes, reaches);
  for (const char* method : {"SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6"})
    evidence.times_over_meshes(method, "3STEPD", meshes, does_not_reach);
  return evidence.claim(6, fmt::format("Iterative methods are as fast as 3STEPD only with SKY "
                                       "(4.0.3); here: as fast up to a factor {}",
                                       same_time));
}

Claim alm_is_slightly_faster_than_3stepd(const CaseTable& cases) {
  Evidence evidence(cases);
  const auto meshes = meshes_with(cases, {"ALM", "3STEPD"});
  evidence.times_over_meshes("ALM", "3STEPD", meshes, [](const Interval& ratio) {
    return both(is_above(ratio, 1 / same_time), opposite(is_above(ratio, 1)));
  });
  const auto with_tuning = [&](const std::string& mesh) -> std::optional<ShownRatio> {
    std::string ignored;
    auto alm = time_of(cases, mesh, "ALM", ignored);
    const auto direct = time_of(cases, mesh, "3STEPD", ignored);
    const Record* record = cases.find(mesh, "ALM");
    if (!alm || !direct || !record->tuning_s) return {};
    alm->text = fmt::format("({} + {:.3g} s)", alm->text, *record->tuning_s);
    alm->time.figure_s += *record->tuning_s;
    alm->time.at_least_s += *record->tuning_s;
    for (double& sample : alm->time.samples_s) sample += *record->tuning_s;
    return shown_ratio(*alm, *direct);
  };
  evidence.over_meshes("beside the claim: (ALM + its tuning)/3STEPD", meshes, with_tuning, {});
  return evidence.claim(7, fmt::format("ALM takes the same time as 3STEPD, slightly less (4.0.3); "
                                       "here: between 1/{} and 1 of it",
                                       same_time));
}

// One mesh: ALM below every other one; the figure shows it beside 3STEPD and the least other one.
void alm_needs_least(Evidence& evidence, const std::string& mesh, std::vector<Ratio>& to_least) {
  const auto alm = evidence.peak_heap(mesh, "ALM");
  std::optional<ShownBytes> least;
  std::string least_method, direct = "3STEPD -";
  for (const std::string& method : seven) {
    if (method == "ALM") continue;
    const auto other = evidence.peak_heap(mesh, method);
    if (!other) continue;
    if (method == "3STEPD") direct = "3STEPD " + other->text;
    if (!least || other->bytes < least->bytes) {
      least = other;
      least_method = method;
    }
  }
  if (!alm || !least) return;
  const double ratio = alm->bytes / least->bytes;
  to_least.push_back({ratio, {ratio, ratio}, false});
  evidence.figure(fmt::format("{}: ALM {}, {}, least but ALM {} {}", mesh, alm->text, direct,
                              least_method, least->text));
  evidence.part(ratio < 1 ? Verdict::reproduced : Verdict::not_reproduced, "");
}

Claim alm_needs_the_least_memory(const CaseTable& cases) {
  Evidence evidence(cases);
  std::vector<Ratio> to_least;
  for (const std::string& mesh : meshes_with(cases, seven))
    alm_needs_least(evidence, mesh, to_least);
  if (!to_least.empty())
    evidence.interval("ALM/least of the others " + show_ratio(spread(to_least)));
  return evidence.claim(8, "ALM needs the least memory of all, less than 3STEPD (4.0.3)");
}

// Of the paper's families that condense on the contact boundary.
bool is_condensing(const Record& record) {
  constexpr std::array<std::string_view, 4> condensing = {"3STEPD", "BLIND", "3STEPCG", "SYMMLQ"};
  return std::find(condensing.begin(), condensing.end(), record.family) != condensing.end();
}

struct ContactShares {
  int cases = 0, below = 0, without_answer = 0;
  Interval range = {1, 0};
  std::vector<std::string> largest;  // on each mesh
};

void add_contact_shares(ContactShares& shares, const CaseTable& cases, const std::string& mesh) {
  double largest = -1;
  std::string text;
  for (const std::string& method : cases.methods(mesh)) {
    const Record& record = *cases.find(mesh, method);
    if (!is_condensing(record)) continue;
    if (!has_answer(record.status) || !record.time_s || !record.stage_contact_s) {
      ++shares.without_answer;
      continue;
    }
    const double share = *record.stage_contact_s / *record.time_s;
    ++shares.cases;
    if (share < contact_share) ++shares.below;
    shares.range = {std::min(shares.range.low, share), std::max(shares.range.high, share)};
    if (share <= largest) continue;
    largest = share;
    text = fmt::format("{} {:.2g} % ({}{})", mesh, 100 * share, record.method,
                       record.status == Status::inaccurate ? ", inaccurate" : "");
  }
  if (!text.empty()) shares.largest.push_back(text);
}

Claim gauss_seidel_takes_under_1_percent(const CaseTable& cases) {
  Evidence evidence(cases);
  ContactShares shares;
  for (const std::string& mesh : cases.meshes()) add_contact_shares(shares, cases, mesh);
  if (shares.cases > 0) {
    evidence.figure("largest share: " + joined(shares.largest));
    evidence.figure(fmt::format("under 1 % in {} of {} cases; {} without a time", shares.below,
                                shares.cases, shares.without_answer));
    evidence.interval(
        fmt::format("share [{:.2g} %, {:.2g} %]", 100 * shares.range.low, 100 * shares.range.high));
    evidence.part(shares.range.high < contact_share ? Verdict::reproduced : Verdict::not_reproduced,
                  "");
  }
  return evidence.claim(9,
                        "Gauss–Seidel usually takes under 1 % of the time (3.3); here: in every "
                        "condensing case");
}

Claim blind_condensation_is_too_expensive(const CaseTable& cases) {
  Evidence evidence(cases);
  evidence.times_over_meshes("BLIND", "3STEPD", meshes_with(cases, {"BLIND"}),
                             [](const Interval& ratio) { return is_above(ratio, 1); });
  for (const char* ours : {"BLIND:SCHUR", "BLIND:SKY"})
    evidence.times_over_meshes(ours, "3STEPD", meshes_with(cases, {ours}), {});
  return evidence.claim(10,
                        "Blind condensation is too expensive (3.2.1); here: slower than 3STEPD");
}

}  // namespace

std::string preconditioner_mesh(const CaseTable& cases) {
  std::string result;
  std::ptrdiff_t most = -1;
  for (const std::string& mesh : cases.meshes()) {
    const auto methods = cases.methods(mesh);
    const auto count = std::count_if(methods.begin(), methods.end(), [&](const std::string& m) {
      return !cases.find(mesh, m)->preconditioner.empty();
    });
    if (count > most || (count == most && mesh == "Mesh3")) {
      most = count;
      result = mesh;
    }
  }
  return result;
}

std::vector<Claim> check_claims(const CaseTable& cases) {
  std::vector<Claim> claims;
  for (const auto check :
       {larger_x_makes_dtic_faster, flic_is_fastest_near_3, dtic_beats_flic_at_equal_memory,
        ssor_is_best_near_1_and_slow, symmlq_and_3stepcg_take_the_same_time,
        iterative_reach_direct_only_with_sky, alm_is_slightly_faster_than_3stepd,
        alm_needs_the_least_memory, gauss_seidel_takes_under_1_percent,
        blind_condensation_is_too_expensive})
    claims.push_back(check(cases));
  return claims;
}

}  // namespace airybench
