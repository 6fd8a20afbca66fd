// How fast the skyline factorisation and solves are, as a fraction of dgemm on the same machine in
// the same run (OpenBLAS, one thread).
//
//   skyline_benchmark [Google Benchmark's options]        sizes: all meshes below
//
// Each iteration times one dgemm and one operation in turn. Operations are counted on the skyline
// itself: Σ h² for the factor, 4 Σ h per dense right-hand side. What the panels pad, and the
// leading zeros that solves skip, is not credited: solves here are on dense right-hand sides.
#include <benchmark/benchmark.h>
#include <cblas.h>

#include <chrono>
#include <functional>
#include <map>
#include <memory>

#include "assembly/dual_system.hpp"
#include "assembly/scene.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/direct/skyline.hpp"
#include "support/data_folder.hpp"

namespace {

using namespace airybench;
using Clock = std::chrono::steady_clock;

constexpr const char* mesh_names[] = {"Mesh3", "Mesh5", "Mesh7"};
constexpr Eigen::Index dgemm_size = 1024;
constexpr Eigen::Index right_hand_sides = 384;
constexpr int repetitions = 5;

double seconds(const std::function<void()>& work) {
  const auto start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Flops per second of C ← C + A B with square matrices.
double dgemm_rate() {
  static const Eigen::MatrixXd a = Eigen::MatrixXd::Random(dgemm_size, dgemm_size);
  static Eigen::MatrixXd c = Eigen::MatrixXd::Zero(dgemm_size, dgemm_size);
  const double spent = seconds([] { c.noalias() += a * a; });
  benchmark::DoNotOptimize(c.data());
  return 2.0 * dgemm_size * dgemm_size * dgemm_size / spent;
}

const DualSystem& system_of(const std::string& mesh) {
  static std::map<std::string, DualSystem> systems;
  const auto found = systems.find(mesh);
  if (found != systems.end()) return found->second;
  auto problem = std::make_shared<const Problem>(
      pose(Scene{}, read_msh(data_folder("meshes") / (mesh + ".msh"))));
  return systems.emplace(mesh, assemble(std::move(problem))).first->second;
}

void report(benchmark::State& state, double flops, double op_s, double dgemm_flops_per_s,
            const SkylineProfile& profile) {
  state.SetIterationTime(op_s);
  state.counters["of_dgemm"] = flops / op_s / dgemm_flops_per_s;
  state.counters["GFlop/s"] = flops / op_s * 1e-9;
  state.counters["dgemm_GFlop/s"] = dgemm_flops_per_s * 1e-9;
  state.counters["profile"] = static_cast<double>(profile.profile);
  state.counters["stored/profile"] =
      static_cast<double>(profile.stored) / static_cast<double>(profile.profile);
}

void factor(benchmark::State& state, const std::string& mesh) {
  const DualSystem& system = system_of(mesh);
  for (auto _ : state) {
    const double rate = dgemm_rate();
    SkylineProfile profile = analyse_skyline(system.S);
    SkylineFactor result;
    const double spent = seconds([&] { result = factor_ldlt(std::move(profile), system.S); });
    report(state, result.profile.factor_flops, spent, rate, result.profile);
  }
}

void solve(benchmark::State& state, const std::string& mesh) {
  const DualSystem& system = system_of(mesh);
  const SkylineFactor f = factor_ldlt(analyse_skyline(system.S), system.S);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Random(system.n(), right_hand_sides);
  for (auto _ : state) {
    const double rate = dgemm_rate();
    Eigen::MatrixXd x = b;
    const double spent = seconds([&] { solve_in_place(f, x); });
    report(state, f.profile.solve_flops() * right_hand_sides, spent, rate, f.profile);
  }
}

}  // namespace

int main(int argc, char** argv) {
  openblas_set_num_threads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const std::string mesh : mesh_names) {
    for (const auto& [name, run] : {std::pair{"factor", &factor}, std::pair{"solve", &solve}})
      benchmark::RegisterBenchmark((std::string(name) + "/" + mesh).c_str(),
                                   [run = run, mesh](benchmark::State& s) { run(s, mesh); })
          ->UseManualTime()
          ->Iterations(1)
          ->Repetitions(repetitions)
          ->ReportAggregatesOnly()
          ->Unit(benchmark::kMillisecond);
  }
  benchmark::RunSpecifiedBenchmarks();
}
