// Measures the speed of our factorisations as a fraction of the speed of dgemm in the same run,
// with BLAS on one thread: the skyline factorisation of S, its solves, and the multifrontal
// factorisation of HYBRID.
//
//   factor_benchmark [Google Benchmark's options]
//
// Each iteration times one dgemm, then one operation. Operation counts:
//   skyline factor       Σ h_i²       h_i: see SkylineProfile; padding is not counted
//   skyline solve        4 Σ h_i      per right-hand side, which is dense
//   multifrontal factor  Σ (rows of a pivot)²   without forming and gathering fronts
#include <benchmark/benchmark.h>

#include <chrono>
#include <functional>
#include <map>
#include <memory>

#include "assembly/airy_system.hpp"
#include "assembly/problem/pose.hpp"
#include "mesh/msh_format.hpp"
#include "mesh/refinement.hpp"
#include "solvers/base/blas_library.hpp"
#include "solvers/base/dense_products.hpp"
#include "solvers/condensation/hybridized.hpp"
#include "solvers/direct/multifrontal.hpp"
#include "solvers/direct/skyline.hpp"
#include "support/data_folder.hpp"

namespace {

using namespace airybench;
using Clock = std::chrono::steady_clock;

constexpr const char* mesh_names[] = {"Mesh3", "Mesh5", "Mesh7"};
constexpr int max_refinements_of_Mesh7 = 2;
constexpr Eigen::Index dgemm_size = 1024;
constexpr Eigen::Index right_hand_sides = 384;
constexpr int repetitions = 5;

double seconds(const std::function<void()>& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Flop/s of C ← C + A B with square matrices.
double dgemm_rate() {
  static const Eigen::MatrixXd a = Eigen::MatrixXd::Random(dgemm_size, dgemm_size);
  static Eigen::MatrixXd c = Eigen::MatrixXd::Zero(dgemm_size, dgemm_size);
  const double spent = seconds([] { add_product(1, a, a, c); });
  benchmark::DoNotOptimize(c.data());
  return 2.0 * dgemm_size * dgemm_size * dgemm_size / spent;
}

Mesh mesh_of(const std::string& name) { return read_msh(data_folder("meshes") / (name + ".msh")); }

const AirySystem& system_of(const std::string& mesh) {
  static std::map<std::string, AirySystem> systems;
  const auto found = systems.find(mesh);
  if (found != systems.end()) return found->second;
  auto problem = std::make_shared<const Problem>(pose(Scene{}, mesh_of(mesh)));
  return systems.emplace(mesh, airy_system(std::move(problem))).first->second;
}

void report(benchmark::State& state, double flops, double op_s, double dgemm_flops_per_s) {
  state.SetIterationTime(op_s);
  state.counters["of_dgemm"] = flops / op_s / dgemm_flops_per_s;
  state.counters["GFlop/s"] = flops / op_s * 1e-9;
  state.counters["dgemm_GFlop/s"] = dgemm_flops_per_s * 1e-9;
}

void report_profile(benchmark::State& state, const SkylineProfile& profile) {
  state.counters["profile"] = static_cast<double>(profile.profile);
  state.counters["stored/profile"] =
      static_cast<double>(profile.stored) / static_cast<double>(profile.profile);
}

void skyline_factor(benchmark::State& state, const std::string& mesh) {
  const AirySystem& system = system_of(mesh);
  for (auto _ : state) {
    const double rate = dgemm_rate();
    SkylineProfile profile = analyse_skyline(system.S);
    SkylineFactor result;
    const double spent = seconds([&] { result = factor_ldlt(std::move(profile), system.S); });
    report(state, result.profile.factor_flops, spent, rate);
    report_profile(state, result.profile);
  }
}

void skyline_solve(benchmark::State& state, const std::string& mesh) {
  const AirySystem& system = system_of(mesh);
  const SkylineFactor f = factor_ldlt(analyse_skyline(system.S), system.S);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(system.n(), right_hand_sides);
  for (auto _ : state) {
    const double rate = dgemm_rate();
    Eigen::MatrixXd x = b;
    const double spent = seconds([&] { solve_in_place(f, x); });
    report(state, f.profile.solve_flops() * right_hand_sides, spent, rate);
    report_profile(state, f.profile);
  }
}

void multifrontal_factor(benchmark::State& state, int refinements) {
  Mesh mesh = mesh_of("Mesh7");
  for (int k = 0; k < refinements; ++k) mesh = uniformly_refined(mesh);
  const ContactSystem points =
      contact_system(std::make_shared<const Problem>(pose(Scene{}, std::move(mesh))));
  const HybridizedSystem system = assemble_hybridized(*points.problem, points.contact);
  for (auto _ : state) {
    const double rate = dgemm_rate();
    MultifrontalFactor result;
    result.analyse(system.K, system.n_c);
    const double spent = seconds([&] { result.factor(system.K); });
    report(state, result.flops(), spent, rate);
  }
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->UseManualTime()
      ->Iterations(1)
      ->Repetitions(repetitions)
      ->ReportAggregatesOnly()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int argc, char** argv) {
  restart_with_better_blas_core(argv);
  set_blas_threads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const std::string mesh : mesh_names) {
    add("skyline factor/" + mesh, [mesh](benchmark::State& s) { skyline_factor(s, mesh); });
    add("skyline solve/" + mesh, [mesh](benchmark::State& s) { skyline_solve(s, mesh); });
  }
  for (int k = 0; k <= max_refinements_of_Mesh7; ++k)
    add("multifrontal factor/Mesh7" + (k > 0 ? "+refine" + std::to_string(k) : ""),
        [k](benchmark::State& s) { multifrontal_factor(s, k); });
  benchmark::RunSpecifiedBenchmarks();
}
