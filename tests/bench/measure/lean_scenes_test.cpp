// Scene by scene, for every kind of method: what a scene does not need has no stage time, no block,
// no right-hand side and no byte. Lean scenes are compared with the full one, which has everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <ostream>

#include "assembly/problem/scene.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/plan/stages.hpp"
#include "bench/records/record.hpp"
#include "solvers/condensation/blind.hpp"
#include "solvers/condensation/three_step.hpp"
#include "solvers/direct/skyline.hpp"
#include "solvers/methods.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::lean_scenes_test {

void PrintTo(const Method& method, std::ostream* out) { *out << method.name; }

namespace {

// Every load, friction, and boundaries of all three roles.
Scene full_scene() { return {.body_force_N_per_mm3 = {3, -1}}; }

struct LeanScene {
  const char* name;
  std::function<void(Scene&)> change = [](Scene&) {};
  std::vector<BoundaryRole> without = {};  // these edges become displacement edges

  std::shared_ptr<const Problem> posed() const {
    Scene scene = full_scene();
    change(scene);
    Mesh mesh = testing::small_tooth(7, 6);
    for (const BoundaryRole role : without)
      mesh = testing::with_role(std::move(mesh), role, BoundaryRole::displacement);
    return testing::posed(scene, std::move(mesh));
  }
};

const LeanScene full = {"full"};
const LeanScene no_body_force = {"no body force",
                                 [](Scene& s) { s.body_force_N_per_mm3.setZero(); }};
const LeanScene no_displacement = {"no prescribed displacement",
                                   [](Scene& s) { s.displacement_mm.setZero(); }};
const LeanScene no_load = {"no load", [](Scene& s) {
                             s.displacement_mm.setZero();
                             s.body_force_N_per_mm3.setZero();
                           }};
const LeanScene flat_wall = {"flat wall", [](Scene& s) { s.crown_radius_mm.reset(); }};
const LeanScene no_friction = {"no friction", [](Scene& s) { s.friction = 0; }};
const LeanScene no_contact = {"no contact", [](Scene&) {}, {BoundaryRole::contact}};
const LeanScene no_force = {"no force boundary", [](Scene&) {}, {BoundaryRole::force}};
const LeanScene no_constraint = {
    "no constraint", [](Scene&) {}, {BoundaryRole::contact, BoundaryRole::force}};

const std::vector<LeanScene> lean_scenes = {no_body_force, no_displacement, no_load,
                                            flat_wall,     no_friction,     no_contact,
                                            no_force,      no_constraint};

std::vector<LeanScene> all_scenes() {
  std::vector<LeanScene> scenes = lean_scenes;
  scenes.push_back(full);
  return scenes;
}

struct Measured {
  std::unique_ptr<ContactSystem> system;
  Solution solution;
  std::vector<StageDecision> stages;
  std::int64_t blocks_bytes = 0;  // live after assembly
  std::int64_t peak_bytes = 0;    // highest during the solve, with the blocks
  std::int64_t allocations = 0;   // of the solve

  // Without blocks where the method needs none.
  const AirySystem& airy() const {
    static const AirySystem none;
    const auto* const blocks = dynamic_cast<const AirySystem*>(system.get());
    return blocks != nullptr ? *blocks : none;
  }
};

// The allocator rounds every block up to a multiple of 16 bytes; as many as a few dozen blocks.
constexpr std::int64_t rounding = 512;

RunControl control() {
  RunControl with;
  with.tolerance = 1e-6;
  with.target_error = 1;  // work and memory are counted here, digits are not
  return with;
}

Measured measure_now(const LeanScene& scene, const Method& method) {
  const auto problem = scene.posed();
  Measured m;
  m.stages = decide_stages(problem, method, /*fields_asked=*/false);
  const std::int64_t before = heap::live_bytes();
  m.system = assemble(method, problem);
  m.blocks_bytes = heap::live_bytes() - before;
  heap::reset_peak();
  const std::int64_t calls = heap::allocations();
  m.solution = run(method, *m.system, control());
  m.peak_bytes = heap::peak_bytes() - before;
  m.allocations = heap::allocations() - calls;
  EXPECT_EQ(m.solution.status, Status::ok) << scene.name << ": " << m.solution.message;
  return m;
}

// Every scene once per method: all tests look at the same numbers.
const Measured& measure(const LeanScene& scene, const Method& method) {
  static std::map<std::string, std::map<std::string, Measured>> all;
  const bool first = !all.contains(method.name);
  auto& scenes = all[method.name];
  if (first) {  // what libraries keep from their first call is no part of the others
    EXPECT_EQ(run(method, *assemble(method, full.posed()), control()).status, Status::ok);
  }
  if (!scenes.contains(scene.name)) scenes.emplace(scene.name, measure_now(scene, method));
  return scenes.at(scene.name);
}

std::vector<Method> kinds_of_methods() {
  std::vector<Method> kinds;
  for (const Method& method : methods())
    if (!method.is_iterative()) kinds.push_back(method);
  for (const char* name : {"ALM:r=20,rho=20", "ALM:AUTO", "SYMMLQ:DTIC3", "SYMMLQ:FLIC2",
                           "SYMMLQ:SSOR1.0", "SYMMLQ:SKY", "SYMMLQ:NONE", "3STEPCG:DTIC3",
                           "3STEPCG:FLIC2", "3STEPCG:SSOR1.0", "3STEPCG:SKY", "3STEPCG:NONE"})
    kinds.push_back(select_methods(name).front());
  return kinds;
}

class LeanScenes : public ::testing::TestWithParam<Method> {};
INSTANTIATE_TEST_SUITE_P(Table, LeanScenes, ::testing::ValuesIn(kinds_of_methods()),
                         testing::readable);

TEST_P(LeanScenes, TimesAndBlocksAreThoseOfTheStagesDecided) {
  for (const LeanScene& scene : all_scenes()) {
    const Measured& m = measure(scene, GetParam());
    std::map<std::string, bool> runs;
    for (const StageDecision& stage : m.stages) runs[stage.stage] = stage.run;
    for (const Stage stage : all_stages) {
      const std::string name(name_of(stage));
      EXPECT_EQ(m.solution.times[stage].has_value(), runs[name]) << scene.name << ": " << name;
    }
    const AirySystem& s = m.airy();
    const ContactPoints& contact = m.system->contact;
    for (const auto& [stage, is_there] :
         {std::pair("assemble S", s.S.nonZeros() > 0),
          {"assemble C_F", s.C_F.nonZeros() > 0},
          {"assemble C_C", s.C_C.nonZeros() > 0},
          {"assemble q", s.q.size() > 0},
          {"assemble F", s.F.size() > 0},
          {"assemble F0", s.F0.size() > 0},
          {"assemble gap", contact.gap.size() > 0},
          {"contact: tangential law", contact.count > 0 && contact.components == 2}})
      EXPECT_EQ(is_there, runs[stage]) << scene.name << ": " << stage;
    if (!GetParam().in_displacements()) {  // which has its control points
      EXPECT_EQ(m.solution.F_C.size(), contact.size()) << scene.name;
    }
    const bool sweeps = runs["contact"] && !m.solution.uzawa_iterations;
    EXPECT_EQ(m.solution.contact_iterations.has_value(), sweeps) << scene.name;
  }
}

// What MUMPS takes by itself: it orders each matrix, and from version 5.7 on the workspace for
// a smaller one may be larger, by up to 0.3 % of the peak as seen.
std::int64_t of_mumps(const Method& method, const Measured& m) {
  const bool by_mumps = method.name == "HYBRID:MUMPS" ||
                        (method.name.starts_with("BLIND") && !method.name.starts_with("BLIND:SKY"));
  return by_mumps ? m.peak_bytes / 200 : 0;
}

Eigen::Index closed_components(const Solution& solution) {
  return (solution.F_C.array() != 0).count();
}

TEST_P(LeanScenes, TakeNoMoreHeapAndNoMoreAllocations) {
  const Measured& with = measure(full, GetParam());
  const auto squared = [](const Measured& m) {
    return std::int64_t{m.airy().n_f()} * m.airy().n_f();
  };
  const bool three_step = GetParam().name.starts_with("3STEP");
  for (const LeanScene& scene : lean_scenes) {
    const Measured& lean = measure(scene, GetParam());
    // Without friction the tangential rows move to K_FF: its sum, copy and factor are larger.
    const std::int64_t moved =
        three_step ? 8 * std::max<std::int64_t>(squared(lean) - squared(with), 0) : 0;
    // What no law holds stays in the factor.
    const bool by_laws = GetParam().name == "HYBRID:PDAS";
    const std::int64_t held = by_laws ? with.peak_bytes / 50 : 0;
    EXPECT_LE(lean.blocks_bytes, with.blocks_bytes + rounding) << scene.name;
    EXPECT_LE(lean.peak_bytes,
              with.peak_bytes + 3 * moved + held + of_mumps(GetParam(), with) + rounding)
        << scene.name;
    // Each asking of the contact law, each growth of a history, each step of a refinement
    // allocates, and the more the more points are closed: where other forces need more of them,
    // nothing is said, nor where CHOLMOD orders a smaller matrix by itself. One temporary more is
    // let pass.
    const bool asks_otherwise = GetParam().in_displacements() ||
                                GetParam().name.ends_with(":REFINED") ||
                                GetParam().name == "HYBRID:CHOLMOD";
    if (!asks_otherwise && lean.solution.contact_iterations <= with.solution.contact_iterations &&
        lean.solution.newton_steps <= with.solution.newton_steps &&
        closed_components(lean.solution) <= closed_components(with.solution) &&
        lean.solution.uzawa_iterations <= with.solution.uzawa_iterations) {
      EXPECT_LE(lean.allocations, with.allocations + 1) << scene.name;
    }
    EXPECT_LE(matrix_bytes(lean.solution), matrix_bytes(with.solution) + moved + held)
        << scene.name;
  }
}

TEST_P(LeanScenes, SaveAtLeastTheBlocksThatAreNotBuilt) {
  const Method& method = GetParam();
  const Measured& with = measure(full, method);
  const auto saved = [&](const LeanScene& scene) {
    return with.peak_bytes - measure(scene, method).peak_bytes;
  };
  const auto numbers = [](std::int64_t count) { return 8 * count - rounding; };
  const AirySystem& airy = with.airy();
  const std::int64_t n = airy.n(), n_c = with.system->contact.size(), n_f = airy.n_f();
  const bool three_step = method.name.starts_with("3STEP");
  const bool keeps_X = three_step && method.name != "3STEPD:FILE" && method.name != "3STEPD:LEAN";
  const bool condenses = !method.name.starts_with("ALM");
  // D; and of the three steps K_FF⁻¹K_FC, of K the rows and columns, of X the columns.
  if (condenses) {
    EXPECT_GE(saved(no_contact), numbers(n_c * n_c) - of_mumps(method, with));
  }
  if (three_step) {
    // Refined, it has its peak without them in another stage: without K, and D does not show.
    const bool refined = method.name.ends_with(":REFINED");
    const std::int64_t D = refined ? 0 : n_c * n_c, coupling = (refined ? 1 : 2) * n_f * n_c;
    EXPECT_GE(saved(no_contact), numbers(D + coupling + (keeps_X ? n * n_c : 0)));
    EXPECT_GE(saved(no_force), numbers(n_f * n_f + coupling + (keeps_X ? n * n_f : 0)));
  }
  EXPECT_GE(saved(no_body_force), numbers(airy.F.size() + airy.F0.size()));
  EXPECT_GE(saved(no_load), numbers(airy.q.size()));
}

TEST_P(LeanScenes, IterateNoMoreAndWithoutConstraintsOnce) {
  const Measured& with = measure(full, GetParam());
  const Measured& unloaded = measure(no_load, GetParam());
  const Measured& unconstrained = measure(no_constraint, GetParam());
  if (with.solution.linear_iterations) {
    // A right-hand side that is zero is not iterated on.
    EXPECT_LT(*unloaded.solution.linear_iterations, *with.solution.linear_iterations);
    EXPECT_LT(*measure(no_contact, GetParam()).solution.linear_iterations,
              *with.solution.linear_iterations);
    if (GetParam().name.starts_with("3STEP")) {  // which solves for the force multipliers too
      EXPECT_LT(*measure(no_force, GetParam()).solution.linear_iterations,
                *with.solution.linear_iterations);
    }
  }
  if (with.solution.uzawa_iterations) {
    EXPECT_EQ(unconstrained.solution.uzawa_iterations, 1);
  }
}

// Right-hand sides that a condensation asks of its factor.
struct CountedSolve {
  const SkylineFactor& factor;
  int columns = 0;
  void operator()(Eigen::Ref<Eigen::MatrixXd> X) {
    columns += static_cast<int>(X.cols());
    solve_in_place(factor, X);
  }
};

TEST(CountOfSolves, ThreeStepSolvesForMultipliersAndALoadOnly) {
  for (const LeanScene& scene : all_scenes()) {
    const AirySystem system = airy_system(scene.posed());
    const SkylineFactor factor = factor_ldlt(analyse_skyline(system.S), system.S);
    for (const auto where : {KeepX::Where::memory, KeepX::Where::nowhere}) {
      CountedSolve solve{factor};
      const ThreeStep steps = condense_in_three_steps(system, std::ref(solve), {where});
      const bool loaded = system.q.size() > 0;
      EXPECT_EQ(solve.columns, system.n_f() + system.n_c() + (loaded ? 1 : 0)) << scene.name;
      EXPECT_EQ(steps.x.size(), system.q.size()) << scene.name;
      EXPECT_EQ(steps.condensed.D.rows(), system.n_c()) << scene.name;
      EXPECT_EQ(steps.condensed.G.size(), system.n_c()) << scene.name;
      EXPECT_EQ(steps.K_FF_inverse_K_FC.size(), system.n_f() * system.n_c()) << scene.name;
      const bool step_two = system.n_f() > 0 && (loaded || system.F.size() > 0);
      EXPECT_EQ(steps.lambda_0.size(), step_two ? system.n_f() : 0) << scene.name;
    }
  }
}

TEST(CountOfSolves, BlindCondensationSolvesForContactForcesAndALoadOnly) {
  for (const LeanScene& scene : all_scenes()) {
    const AirySystem system = airy_system(scene.posed());
    const BlindSystem blind = make_blind_system(system, BlindNumbering::multipliers_after_unknowns);
    const SkylineFactor factor = factor_ldlt(analyse_skyline(blind.lower), blind.lower);
    CountedSolve solve{factor};
    const contact::Problem condensed = condense_blindly(system, blind, std::ref(solve), 8);
    const bool loaded = blind.load.size() > 0;
    EXPECT_EQ(loaded, system.q.size() + system.F.size() + system.F0.size() > 0) << scene.name;
    EXPECT_EQ(solve.columns, system.n_c() > 0 ? system.n_c() + (loaded ? 1 : 0) : 0) << scene.name;
    EXPECT_EQ(condensed.D.rows(), system.n_c()) << scene.name;
  }
}

}  // namespace
}  // namespace airybench::lean_scenes_test
