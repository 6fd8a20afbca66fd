#include "solvers/contact/gauss_seidel.hpp"

#include <cblas.h>

#include <cmath>

#include "solvers/contact/compliance.hpp"
#include "solvers/contact/coulomb_law.hpp"

namespace airybench {
namespace {

template <int components>
using Local = Eigen::Matrix<double, components, 1>;
template <int components>
using Block = Eigen::Matrix<double, components, components>;

// Rows of D from the i-th on: their product with F, and D_pp, the block at column i.
struct DenseRows {
  const Eigen::MatrixXd& as_columns;
  template <int components>
  Local<components> times(Eigen::Index i, const Eigen::VectorXd& F, Block<components>& D_pp) const {
    Local<components> product;
    for (int k = 0; k < components; ++k)
      product(k) =
          cblas_ddot(static_cast<int>(F.size()), as_columns.col(i + k).data(), 1, F.data(), 1);
    D_pp = as_columns.block<components, components>(i, i);  // its symmetric part counts
    return product;
  }
};
struct CompressedRows {
  const SparseRows& rows;
  template <int components>
  Local<components> times(Eigen::Index i, const Eigen::VectorXd& F, Block<components>& D_pp) const {
    Local<components> product;
    D_pp.setZero();
    for (int k = 0; k < components; ++k) {
      double sum = 0;
      for (SparseRows::InnerIterator entry(rows, i + k); entry; ++entry) {
        sum += entry.value() * F(entry.col());
        const Eigen::Index other = entry.col() - i;
        if (other >= 0 && other < components) D_pp(k, other) = entry.value();
      }
      product(k) = sum;
    }
    return product;
  }
};

template <int components, typename Rows>
double squared_change(const Rows& rows, const ContactPoints& points, const Eigen::VectorXd& offset,
                      Eigen::VectorXd& F) {
  double change = 0;
  Block<components> D_pp;
  for (int p = 0; p < points.count; ++p) {
    const Eigen::Index i = components * p;
    const Local<components> old = F.segment<components>(i);
    Local<components> b = rows.template times<components>(i, F, D_pp);
    b -= offset.segment<components>(i);
    // The law at one point is solved for the symmetric part; the rest is in b.
    const Block<components> symmetric = (D_pp + D_pp.transpose()) / 2;
    b -= symmetric * old;
    Local<components> solved;
    if constexpr (components == 1)
      solved(0) = solve_signorini_law(symmetric(0), b(0));
    else
      solved = solve_coulomb_law(symmetric, b, points.friction_at(p));
    F.segment<components>(i) = solved;
    change += (solved - old).squaredNorm();
  }
  return change;
}

}  // namespace

GaussSeidel::GaussSeidel(const contact::Problem& problem)
    : problem_(&problem), offset_(contact_offset(problem)) {
  need_formed(problem, "Gauss-Seidel");
  if (problem.is_dense() && !problem.is_symmetric) transposed_ = problem.D.transpose();
}

double GaussSeidel::sweep(Eigen::VectorXd& F) const {
  const auto sweep_by = [&](const auto& rows) {
    const ContactPoints& points = problem_->points;
    switch (points.components) {
      case 1:
        return std::sqrt(squared_change<1>(rows, points, offset_, F));
      case 2:
        return std::sqrt(squared_change<2>(rows, points, offset_, F));
      default:
        return std::sqrt(squared_change<3>(rows, points, offset_, F));
    }
  };
  if (!problem_->is_dense()) return sweep_by(CompressedRows{problem_->rows});
  return sweep_by(DenseRows{transposed_.size() > 0 ? transposed_ : problem_->D});
}

ContactResult solve_contact_by_gauss_seidel(const contact::Problem& problem,
                                            const ContactOptions& options,
                                            const Deadline& deadline) {
  const GaussSeidel by(problem);
  return iterate_contact(problem, options, deadline,
                         [&](Eigen::VectorXd& F) { return by.sweep(F); });
}

}  // namespace airybench
