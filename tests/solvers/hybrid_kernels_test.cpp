// Elements of every degree side by side in vector registers are the same as one by one, to the last
// bit, by every instruction set that the processor has; and no lane disturbs another.
#include "solvers/condensation/hybrid_kernels.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "assembly/problem/pose.hpp"
#include "solvers/condensation/hybrid_element_templates.hpp"
#include "tests/support/small_meshes.hpp"

namespace airybench::hybrid_kernels_test {
namespace {

using testing::small_tooth;

#define FOR_EVERY_DEGREE(function)            \
  do {                                        \
    AIRYBENCH_STRESS_DEGREES(CALL_##function) \
  } while (false)

template <int k, typename Scalar = double>
std::vector<HybridInput<Scalar, k>> inputs_of(const Problem& problem) {
  const std::vector<int> rows = rows_in_frame(problem);
  std::vector<HybridInput<Scalar, k>> inputs;
  for (int t = 0; t < static_cast<int>(problem.mesh.triangles.size()); ++t)
    inputs.push_back(hybrid_input<Scalar, k>(problem, rows, t));
  return inputs;
}

// Has contact edges in frames, a curved boundary, edges walked both ways, a body force.
Problem loaded_problem(int columns, int rows) {
  Scene scene;
  scene.body_force_N_per_mm3 = {3, -1};
  return pose(scene, small_tooth(columns, rows));
}

template <int k>
struct Results {
  std::vector<HybridStiffness<double, k>> stiffness;
  std::vector<HybridStress<double, k>> stress;
};

template <int k>
std::vector<double> displacements(std::size_t elements) {
  std::mt19937 generator(1);
  std::normal_distribution<double> normal(0, 0.01);
  std::vector<double> displacement(StressDegree<k>::size * elements);
  for (double& u : displacement) u = normal(generator);
  return displacement;
}

// Of as many inputs as the kernels' width divides.
template <int k>
Results<k> compute(const HybridKernels<double, k>& kernels,
                   const std::vector<HybridInput<double, k>>& inputs, bool loaded) {
  const std::vector<double> displacement = displacements<k>(inputs.size());
  Results<k> results{std::vector<HybridStiffness<double, k>>(inputs.size()),
                     std::vector<HybridStress<double, k>>(inputs.size())};
  for (std::size_t first = 0; first < inputs.size(); first += kernels.width) {
    kernels.stiffness(&inputs[first], loaded, &results.stiffness[first]);
    kernels.stress(&inputs[first], loaded, &displacement[StressDegree<k>::size * first],
                   &results.stress[first]);
  }
  return results;
}

// S_e of slivers is factorised by its root (equilibrium_element.hpp).
template <typename Scalar, int k>
void make_sliver(HybridInput<Scalar, k>& input, double part_of_height) {
  for (int i = 0; i < 3; ++i) input.vertices[2 * i] *= part_of_height;
}

template <typename Values>
bool same_bits(const Values& a, const Values& b) {
  return std::memcmp(&a, &b, sizeof(Values)) == 0;
}

template <int k>
void check_bits() {
  // 96 triangles: twelve times eight. Some packs have one sliver or more, two nothing else.
  std::vector<HybridInput<double, k>> inputs = inputs_of<k>(loaded_problem(8, 6));
  for (const std::size_t t : {1, 9, 10}) make_sliver(inputs[t], 1e-3);
  for (std::size_t t = 16; t < 32; ++t) make_sliver(inputs[t], 1e-3);
  const Results<k> baseline = compute<k>(usable_hybrid_kernels().front(), inputs, true);
  for (const HybridKernels<double, k>& kernels : usable_hybrid_kernels()) {
    const Results<k> results = compute<k>(kernels, inputs, true);
    for (std::size_t t = 0; t < inputs.size(); ++t) {
      EXPECT_TRUE(same_bits(results.stiffness[t], baseline.stiffness[t])) << kernels.name << t;
      EXPECT_TRUE(same_bits(results.stress[t], baseline.stress[t])) << kernels.name << t;
    }
  }
}

TEST(HybridKernels, EveryInstructionSetGivesTheSameBits) {
#define CALL_check_bits(k) check_bits<k>();
  FOR_EVERY_DEGREE(check_bits);
}

// Largest difference of two arrays over the largest number, or that of the terms if it is larger.
template <typename Exact, std::size_t n>
double distance(const double (&a)[n], const Exact (&b)[n], double of_terms = 0) {
  double difference = 0, largest = of_terms;
  for (std::size_t i = 0; i < n; ++i) {
    const double here = std::abs(a[i] - static_cast<double>(b[i]));
    if (!(here <= difference)) difference = here;  // NaN, too
    largest = std::max(largest, std::abs(static_cast<double>(b[i])));
  }
  return difference / largest;
}

template <int k>
void check_values() {
  // The condition of a Bernstein basis doubles with each degree.
  constexpr double tolerance = 4e-12 * (1 << k);
  const Problem problem = loaded_problem(4, 4);
  auto inputs = inputs_of<k>(problem);
  auto exact = inputs_of<k, Wide>(problem);
  for (const std::size_t t : {3, 20}) {
    make_sliver(inputs[t], 0.03);
    make_sliver(exact[t], 0.03);
  }
  const Results<k> results = compute<k>(hybrid_kernels<double, k>(), inputs, true);
  const std::vector<double> displacement = displacements<k>(inputs.size());
  constexpr int size = StressDegree<k>::size;
  for (std::size_t t = 0; t < inputs.size(); ++t) {
    const HybridStiffness<Wide, k> stiffness = hybrid_stiffness(exact[t], true);
    const Eigen::Matrix<Wide, size, 1> u =
        Eigen::Map<const Eigen::Matrix<double, size, 1>>(&displacement[size * t])
            .template cast<Wide>();
    const HybridStress<Wide, k> stress = hybrid_stress(exact[t], true, u);
    EXPECT_LT(distance(results.stiffness[t].lower, stiffness.lower), tolerance) << k << ' ' << t;
    // f_e is small against the forces of σ_p.
    using Particular = Eigen::Map<const Eigen::Matrix3d>;
    const double particular = Particular(inputs[t].particular).cwiseAbs().maxCoeff();
    EXPECT_LT(distance(results.stiffness[t].load, stiffness.load, particular), tolerance)
        << k << ' ' << t;
    EXPECT_LT(distance(results.stress[t].stress, stress.stress), tolerance) << k << ' ' << t;
    EXPECT_LT(distance(results.stress[t].forces, stress.forces), tolerance) << k << ' ' << t;
    EXPECT_NEAR(results.stiffness[t].independence, static_cast<double>(stiffness.independence),
                tolerance);
    EXPECT_GT(stiffness.independence, 1e-5);
  }
}

TEST(HybridKernels, AreWhatTheTemplatesSayInLongDouble) {
#define CALL_check_values(k) check_values<k>();
  FOR_EVERY_DEGREE(check_values);
}

template <int k>
void check_flat() {
  const std::vector<HybridInput<double, k>> inputs = inputs_of<k>(pose({}, small_tooth(4, 4)));
  for (const HybridKernels<double, k>& kernels : usable_hybrid_kernels()) {
    const Results<k> before = compute<k>(kernels, inputs, false);
    std::vector<HybridInput<double, k>> spoilt = inputs;
    constexpr std::size_t flat = 9;
    std::copy_n(spoilt[flat].vertices, 2, spoilt[flat].vertices + 2);  // V2 = V1
    const Results<k> after = compute<k>(kernels, spoilt, false);
    for (std::size_t t = 0; t < inputs.size(); ++t)
      if (t == flat)
        EXPECT_FALSE(after.stiffness[t].independence > 0) << kernels.name;
      else
        EXPECT_TRUE(same_bits(after.stiffness[t], before.stiffness[t])) << kernels.name << t;
  }
}

TEST(HybridKernels, AFlatTriangleIsItsOwnFaultOnly) {
#define CALL_check_flat(k) check_flat<k>();
  FOR_EVERY_DEGREE(check_flat);
}

}  // namespace
}  // namespace airybench::hybrid_kernels_test
