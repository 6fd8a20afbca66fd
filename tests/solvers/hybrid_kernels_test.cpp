// Elements side by side in vector registers are the same as one by one, to the last bit, by every
// instruction set that the processor has; and no lane disturbs another.
#include "solvers/condensation/hybrid_kernels.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "assembly/scene.hpp"
#include "solvers/condensation/edge_unknowns.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::hybrid_kernels_test {
namespace {

using testing::small_tooth;

template <typename Scalar = double>
std::vector<HybridInput<Scalar>> inputs_of(const Problem& problem) {
  const std::vector<int> rows = rows_in_frame(problem);
  std::vector<HybridInput<Scalar>> inputs;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    inputs.push_back(hybrid_input<Scalar>(problem, rows, t));
  return inputs;
}

struct Results {
  std::vector<HybridStiffness<double>> stiffness;
  std::vector<HybridStress<double>> stress;
};

// Of as many inputs as the kernels' width divides.
Results compute(const HybridKernels<double>& kernels, std::vector<HybridInput<double>> inputs,
                bool loaded) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, 0.01);
  std::vector<double> displacement(12 * inputs.size());
  for (double& u : displacement) u = normal(generator);
  Results results{std::vector<HybridStiffness<double>>(inputs.size()),
                  std::vector<HybridStress<double>>(inputs.size())};
  for (std::size_t first = 0; first < inputs.size(); first += kernels.width) {
    kernels.stiffness(&inputs[first], loaded, &results.stiffness[first]);
    kernels.stress(&inputs[first], loaded, &displacement[12 * first], &results.stress[first]);
  }
  return results;
}

template <typename Values>
bool same_bits(const Values& a, const Values& b) {
  return std::memcmp(&a, &b, sizeof(Values)) == 0;
}

TEST(HybridKernels, EveryInstructionSetGivesTheSameBits) {
  Scene scene;
  scene.body_force_N_per_mm3 = {3, -1};
  const Problem problem = pose(scene, small_tooth(8, 6));  // 96 triangles: twelve times eight
  const std::vector<HybridInput<double>> inputs = inputs_of(problem);
  const Results baseline = compute(usable_hybrid_kernels().front(), inputs, true);
  for (const HybridKernels<double>& kernels : usable_hybrid_kernels()) {
    const Results results = compute(kernels, inputs, true);
    for (std::size_t t = 0; t < inputs.size(); ++t) {
      EXPECT_TRUE(same_bits(results.stiffness[t], baseline.stiffness[t])) << kernels.name << t;
      EXPECT_TRUE(same_bits(results.stress[t], baseline.stress[t])) << kernels.name << t;
    }
  }
}

TEST(HybridKernels, AreWhatTheTemplatesSayInLongDouble) {
  const Problem problem = pose({}, small_tooth(4, 4));
  const std::vector<HybridInput<double>> inputs = inputs_of(problem);
  const std::vector<HybridInput<long double>> exact = inputs_of<long double>(problem);
  const Results results = compute(hybrid_kernels<double>(), inputs, false);
  for (std::size_t t = 0; t < inputs.size(); ++t) {
    HybridStiffness<long double> one;
    hybrid_kernels<long double>().stiffness(&exact[t], false, &one);
    for (int k = 0; k < 78; ++k)  // entries are up to 4e6 N/mm
      EXPECT_NEAR(results.stiffness[t].lower[k], static_cast<double>(one.lower[k]), 1e-4) << t;
    EXPECT_GT(results.stiffness[t].independence, 1e-3);
  }
}

TEST(HybridKernels, AFlatTriangleIsItsOwnFaultOnly) {
  const Problem problem = pose({}, small_tooth(4, 4));
  std::vector<HybridInput<double>> inputs = inputs_of(problem);
  for (const HybridKernels<double>& kernels : usable_hybrid_kernels()) {
    const Results before = compute(kernels, inputs, false);
    std::vector<HybridInput<double>> spoilt = inputs;
    constexpr std::size_t flat = 9;
    std::copy_n(spoilt[flat].vertices, 2, spoilt[flat].vertices + 2);  // V2 = V1
    const Results after = compute(kernels, spoilt, false);
    for (std::size_t t = 0; t < inputs.size(); ++t)
      if (t == flat)
        EXPECT_FALSE(after.stiffness[t].independence > 0) << kernels.name;
      else
        EXPECT_TRUE(same_bits(after.stiffness[t], before.stiffness[t])) << kernels.name << t;
  }
}

}  // namespace
}  // namespace airybench::hybrid_kernels_test
