// The kernels of hybrid_kernels.hpp for one instruction set: compiled once for each, with
//
//   AIRYBENCH_ISA    its name: baseline, avx2, avx512f
//   AIRYBENCH_LANES  doubles per vector register
//
// Instructions of this set must not reach code that other processors run. So nothing here is
// instantiated for a type that other files use too — all are packs of this width —, and a test
// reads the object's symbols.
#include "assembly/elements/equilibrium_element_templates.hpp"
#include "solvers/base/pack.hpp"
#include "solvers/condensation/hybrid_element_templates.hpp"
#include "solvers/condensation/hybrid_kernels.hpp"

#define AIRYBENCH_TEXT_2(isa) #isa
#define AIRYBENCH_TEXT(isa) AIRYBENCH_TEXT_2(isa)

namespace airybench {
namespace {

using Lanes = Pack<AIRYBENCH_LANES>;

// Values are structs of numbers and nothing else.
template <typename Values, typename ValuesOfDoubles>
Values gather(const ValuesOfDoubles* from) {
  constexpr int count = sizeof(Values) / sizeof(Lanes);
  static_assert(sizeof(ValuesOfDoubles) == count * sizeof(double));
  const auto* number = reinterpret_cast<const double*>(from);
  Values values;
  auto* pack = reinterpret_cast<Lanes*>(&values);
  for (int i = 0; i < count; ++i)
    for (int l = 0; l < AIRYBENCH_LANES; ++l) pack[i].lanes[l] = number[l * count + i];
  return values;
}
template <typename Values, typename ValuesOfDoubles>
void scatter(const Values& values, ValuesOfDoubles* to) {
  constexpr int count = sizeof(Values) / sizeof(Lanes);
  static_assert(sizeof(ValuesOfDoubles) == count * sizeof(double));
  auto* number = reinterpret_cast<double*>(to);
  const auto* pack = reinterpret_cast<const Lanes*>(&values);
  for (int l = 0; l < AIRYBENCH_LANES; ++l)
    for (int i = 0; i < count; ++i) number[l * count + i] = pack[i].lanes[l];
}

template <int k>
void stiffness(const HybridInput<double, k>* input, bool loaded,
               HybridStiffness<double, k>* result) {
  scatter(hybrid_stiffness(gather<HybridInput<Lanes, k>>(input), loaded), result);
}

template <int k>
void stress(const HybridInput<double, k>* input, bool loaded, const double* displacement,
            HybridStress<double, k>* result) {
  constexpr int size = StressDegree<k>::size;
  Eigen::Matrix<Lanes, size, 1> u;
  for (int i = 0; i < size; ++i)
    for (int l = 0; l < AIRYBENCH_LANES; ++l) u(i).lanes[l] = displacement[size * l + i];
  scatter(hybrid_stress(gather<HybridInput<Lanes, k>>(input), loaded, u), result);
}

template <int... i>
constexpr HybridKernelSet kernels_of_degrees(std::integer_sequence<int, i...>) {
  return {{AIRYBENCH_TEXT(AIRYBENCH_ISA), AIRYBENCH_LANES, stiffness<i + 1>, stress<i + 1>}...};
}

}  // namespace

#define AIRYBENCH_NAME_2(isa) hybrid_kernels_##isa
#define AIRYBENCH_NAME(isa) AIRYBENCH_NAME_2(isa)
extern const HybridKernelSet AIRYBENCH_NAME(AIRYBENCH_ISA);
constinit const HybridKernelSet AIRYBENCH_NAME(AIRYBENCH_ISA) =
    kernels_of_degrees(StressDegreeIndices());

}  // namespace airybench
