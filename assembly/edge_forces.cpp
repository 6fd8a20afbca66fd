#include "assembly/edge_forces_templates.hpp"

namespace airybench {

template EdgeForcesIn<double> edge_forces(const Eigen::Vector2d&, const Eigen::Vector2d&, double);
template EdgeForcesIn<long double> edge_forces(const Eigen::Vector2d&, const Eigen::Vector2d&,
                                               double);

}  // namespace airybench
