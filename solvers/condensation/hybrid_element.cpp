#include "solvers/condensation/hybrid_element_templates.hpp"

namespace airybench {

template struct HybridElement<double>;
template struct HybridElement<long double>;
template Eigen::Matrix4<double> edge_components(const Mesh&, int, int, bool);
template HybridElement<double> make_hybrid_element(const Problem&, const std::vector<bool>&, int);
template HybridElement<long double> make_hybrid_element(const Problem&, const std::vector<bool>&,
                                                        int);

}  // namespace airybench
