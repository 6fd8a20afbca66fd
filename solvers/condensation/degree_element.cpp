#include "solvers/condensation/degree_element.hpp"

#include <algorithm>

#include "solvers/condensation/edge_unknowns.hpp"

namespace airybench {

template <typename Scalar>
DegreeInput<Scalar> degree_input(const Problem& problem, const std::vector<int>& rows, int degree,
                                 int t) {
  DegreeInput<Scalar> input;
  input.vertices = problem.vertices_of(t);
  input.compliance = problem.compliance_of(t);
  const auto& corner = problem.mesh.triangles[t];
  for (int e = 0; e < 3; ++e) {
    const int row = rows[problem.edges.of_triangle[t][e]];
    input.from_start[e] = row != no_frame || corner[e] < corner[(e + 1) % 3];
    input.in_frame[e] = row != no_frame;
    if (input.in_frame[e])
      for (int j = 0; j <= degree; ++j)
        input.frame[e][j] = problem.frame_of_moment<Scalar>(row, degree, j);
    if (problem.loads.has_body_force())
      input.particular.col(e) =
          problem.particular_stress<Scalar>(input.vertices.col(e).template cast<Scalar>());
  }
  return input;
}

namespace {

template <typename Scalar, int k>
struct Kernels {
  using Element = EquilibriumElement<Scalar, k>;
  using Input = DegreeInput<Scalar>;
  using OnEdges = typename Element::OnEdges;
  using Pair = Eigen::Vector2<Scalar>;
  static constexpr int size = StressDegree<k>::size;

  // Where the unknowns' components are that belong to a pair of the element's walk.
  static int place(const Input& input, int pair) {
    const int e = pair / (k + 1), j = pair % (k + 1);
    return 2 * ((k + 1) * e + (input.from_start[e] ? j : k - j));
  }
  static Pair from_axes(const Input& input, int pair, const Pair& v) {
    const int e = pair / (k + 1);
    if (!input.in_frame[e]) return v;
    const auto& frame = input.frame[e][pair % (k + 1)];
    return {frame.normal.dot(v), frame.tangent.dot(v)};
  }
  static void from_axes(const Input& input, const OnEdges& of_element, Scalar* values) {
    for (int p = 0; p < size / 2; ++p)
      Eigen::Map<Pair>(values + place(input, p)) =
          from_axes(input, p, of_element.template segment<2>(2 * p));
  }
  static OnEdges to_axes(const Input& input, const Scalar* values) {
    OnEdges of_element;
    for (int p = 0; p < size / 2; ++p) {
      const Pair v = Eigen::Map<const Pair>(values + place(input, p));
      const int e = p / (k + 1);
      const auto& frame = input.frame[e][p % (k + 1)];
      of_element.template segment<2>(2 * p) =
          input.in_frame[e] ? Pair(v(0) * frame.normal + v(1) * frame.tangent) : v;
    }
    return of_element;
  }
  static typename Element::Stress particular(const Input& input, bool loaded) {
    if (!loaded) return Element::Stress::Zero();
    return linear_stress<k>(input.particular);
  }

  static Scalar stiffness(const Input& input, bool loaded, Scalar* lower, Scalar* load) {
    const Element element(input.vertices, input.compliance);
    typename Element::Stiffness K = element.stiffness(), own;
    for (int p = 0; p < size / 2; ++p)
      if (input.in_frame[p / (k + 1)])
        for (int j = 0; j < size; ++j)
          K.col(j).template segment<2>(2 * p) =
              from_axes(input, p, K.col(j).template segment<2>(2 * p));
    for (int q = 0; q < size / 2; ++q)
      for (int i = 0; i < size; ++i) {
        const Pair row = from_axes(input, q, {K(i, 2 * q), K(i, 2 * q + 1)});
        const int at = place(input, i / 2) + i % 2;
        own(at, place(input, q)) = row(0);
        own(at, place(input, q) + 1) = row(1);
      }
    for (int j = 0; j < size; ++j)
      for (int i = j; i < size; ++i) *lower++ = own(i, j);
    if (loaded)
      from_axes(input, element.load(particular(input, loaded)), load);
    else
      std::fill_n(load, size, Scalar(0));
    return element.independence();
  }

  static Scalar stress(const Input& input, bool loaded, const Scalar* displacement, Scalar* stress,
                       Scalar* forces, Scalar* defect) {
    const Element element(input.vertices, input.compliance);
    const OnEdges u = to_axes(input, displacement);
    const typename Element::Stress total = element.stress(u, particular(input, loaded));
    std::copy_n(total.data(), total.size(), stress);
    from_axes(input, element.edge_forces(total), forces);
    const typename Element::Defect off = element.defect(u, total);
    from_axes(input, off.forces, defect);
    return off.energy;
  }
};

}  // namespace

template <typename Scalar>
const DegreeKernels<Scalar>& degree_kernels(int degree) {
  return with_degree(degree, [](auto k) -> const DegreeKernels<Scalar>& {
    static const DegreeKernels<Scalar> kernels = {Kernels<Scalar, k>::stiffness,
                                                  Kernels<Scalar, k>::stress};
    return kernels;
  });
}

template DegreeInput<double> degree_input(const Problem&, const std::vector<int>&, int, int);
template DegreeInput<long double> degree_input(const Problem&, const std::vector<int>&, int, int);
template const DegreeKernels<double>& degree_kernels(int);
template const DegreeKernels<long double>& degree_kernels(int);

}  // namespace airybench
