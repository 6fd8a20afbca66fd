#include "assembly/edge_forces_templates.hpp"

namespace airybench {

template EdgeForcesIn<double> edge_forces<double>(const Eigen::Vector2d&, const Eigen::Vector2d&,
                                                  double);
template EdgeForcesIn<long double> edge_forces<long double>(const Eigen::Vector2d&,
                                                            const Eigen::Vector2d&, double);

}  // namespace airybench
