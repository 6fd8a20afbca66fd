#include "solvers/direct/skyline.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace airybench {
namespace {

using Block = Eigen::Map<Eigen::MatrixXd>;
using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;

// Columns solved together: wide enough for matrix products, narrow enough for the cache.
constexpr Eigen::Index columns_at_once = 192;

std::vector<int> first_columns(const Eigen::SparseMatrix<double>& lower) {
  std::vector<int> first(static_cast<std::size_t>(lower.rows()));
  for (int i = 0; i < lower.rows(); ++i) first[i] = i;
  for (int j = 0; j < lower.cols(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry)
      first[entry.row()] = std::min(first[entry.row()], j);
  return first;
}

void scatter(const Eigen::SparseMatrix<double>& lower, SkylineFactor& factor) {
  const SkylineProfile& profile = factor.profile;
  for (int j = 0; j < lower.cols(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, j); entry; ++entry) {
      const int i = static_cast<int>(entry.row());
      const SkylinePanel& panel = profile.panels[profile.panel_of_row[i]];
      factor.values[panel.offset + std::int64_t{j - panel.column} * panel.rows + (i - panel.row)] =
          entry.value();
    }
}

Block block_of(SkylineFactor& factor, const SkylinePanel& panel) {
  return {factor.values.data() + panel.offset, panel.rows, panel.width()};
}
ConstBlock block_of(const SkylineFactor& factor, const SkylinePanel& panel) {
  return {factor.values.data() + panel.offset, panel.rows, panel.width()};
}

// In place A = L D Lᵀ of a panel's corner; lower triangle only.
void factor_corner(Eigen::Ref<Eigen::MatrixXd> a, int first_row) {
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    const double pivot = a(j, j);
    if (!(std::abs(pivot) > 0) || !std::isfinite(pivot))
      throw Breakdown("skyline LDLT: pivot of row " + std::to_string(first_row + j + 1) + " is " +
                      std::to_string(pivot));
    const Eigen::Index below = a.rows() - j - 1;
    for (Eigen::Index k = 0; k < below; ++k) {
      const double l = a(j + 1 + k, j) / pivot;
      a.col(j + 1 + k).tail(below - k) -= l * a.col(j).tail(below - k);
    }
    a.col(j).tail(below) /= pivot;
  }
}

void factor_panel(SkylineFactor& factor, std::size_t index, Eigen::MatrixXd& scaled) {
  const SkylineProfile& profile = factor.profile;
  const SkylinePanel& panel = profile.panels[index];
  Block w = block_of(factor, panel);

  for (std::size_t k = profile.panel_of_row[panel.column]; k < index; ++k) {
    const SkylinePanel& earlier = profile.panels[k];
    const ConstBlock l = block_of(std::as_const(factor), earlier);
    const int begin = std::max(panel.column, earlier.row);  // the part of K that I reaches
    const int skipped = begin - earlier.row;
    const int size = earlier.rows - skipped;
    const int from = std::max(panel.column, earlier.column);  // where the two rows' products begin
    auto target = w.middleCols(begin - panel.column, size);
    if (begin > from)
      target.noalias() -= w.middleCols(from - panel.column, begin - from) *
                          l.block(skipped, from - earlier.column, size, begin - from).transpose();
    l.block(skipped, begin - earlier.column, size, size)
        .triangularView<Eigen::UnitLower>()
        .transpose()
        .solveInPlace<Eigen::OnTheRight>(target);
  }

  auto left = w.leftCols(panel.left());
  auto corner = w.rightCols(panel.rows);
  auto scaled_left = scaled.topLeftCorner(panel.rows, panel.left());
  scaled_left =
      left * factor.diagonal.segment(panel.column, panel.left()).cwiseInverse().asDiagonal();
  corner.noalias() -= scaled_left * left.transpose();
  left = scaled_left;
  factor_corner(corner, panel.row);
  factor.diagonal.segment(panel.row, panel.rows) = corner.diagonal();
}

void solve_columns(const SkylineFactor& factor, Eigen::Ref<Eigen::MatrixXd> x,
                   const Deadline& deadline) {
  const SkylineProfile& profile = factor.profile;
  const int panels = static_cast<int>(profile.panels.size());
  Eigen::Index first = profile.n;
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    Eigen::Index i = 0;
    while (i < first && x(i, j) == 0) ++i;
    first = i;
  }
  if (first == profile.n) return;  // all zero

  for (int k = profile.panel_of_row[first]; k < panels; ++k) {  // L y = b
    const SkylinePanel& panel = profile.panels[k];
    const ConstBlock l = block_of(factor, panel);
    const int from = std::max(panel.column, static_cast<int>(first));
    auto target = x.middleRows(panel.row, panel.rows);
    if (panel.row > from)
      target.noalias() -= l.middleCols(from - panel.column, panel.row - from) *
                          x.middleRows(from, panel.row - from);
    l.rightCols(panel.rows).triangularView<Eigen::UnitLower>().solveInPlace(target);
  }
  deadline.check("a skyline solve");
  for (Eigen::Index j = 0; j < x.cols(); ++j)  // z = D⁻¹ y
    x.col(j).tail(profile.n - first).array() /= factor.diagonal.tail(profile.n - first).array();
  for (int k = panels - 1; k >= 0; --k) {  // Lᵀ x = z
    const SkylinePanel& panel = profile.panels[k];
    const ConstBlock l = block_of(factor, panel);
    auto solved = x.middleRows(panel.row, panel.rows);
    l.rightCols(panel.rows).triangularView<Eigen::UnitLower>().transpose().solveInPlace(solved);
    if (panel.left() > 0)
      x.middleRows(panel.column, panel.left()).noalias() -=
          l.leftCols(panel.left()).transpose() * solved;
  }
}

}  // namespace

SkylineProfile analyse_skyline(const Eigen::SparseMatrix<double>& lower, int panel_rows) {
  const std::vector<int> first = first_columns(lower);
  SkylineProfile profile;
  profile.n = static_cast<int>(lower.rows());
  profile.panel_of_row.resize(profile.n);
  for (int row = 0; row < profile.n;) {
    SkylinePanel panel{row, 0, row, profile.stored};
    for (; panel.rows < panel_rows && row < profile.n; ++row, ++panel.rows) {
      panel.column = std::min(panel.column, first[row]);
      const double height = row - first[row] + 1;
      profile.profile += row - first[row] + 1;
      profile.factor_flops += height * height;
      profile.panel_of_row[row] = static_cast<int>(profile.panels.size());
    }
    profile.stored += std::int64_t{panel.rows} * panel.width();
    profile.panels.push_back(panel);
  }
  return profile;
}

SkylineFactor factor_ldlt(SkylineProfile profile, const Eigen::SparseMatrix<double>& lower,
                          const Deadline& deadline) {
  SkylineFactor factor{std::move(profile), {}, {}};
  factor.values.assign(static_cast<std::size_t>(factor.profile.stored), 0.0);
  factor.diagonal.resize(factor.profile.n);
  scatter(lower, factor);
  int rows = 0, left = 0;
  for (const SkylinePanel& panel : factor.profile.panels) {
    rows = std::max(rows, panel.rows);
    left = std::max(left, panel.left());
  }
  Eigen::MatrixXd scaled(rows, left);
  for (std::size_t k = 0; k < factor.profile.panels.size(); ++k) {
    factor_panel(factor, k, scaled);
    deadline.check("the skyline factorisation");
  }
  return factor;
}

void solve_in_place(const SkylineFactor& factor, Eigen::Ref<Eigen::MatrixXd> X,
                    const Deadline& deadline) {
  for (Eigen::Index j = 0; j < X.cols(); j += columns_at_once)
    solve_columns(factor, X.middleCols(j, std::min(columns_at_once, X.cols() - j)), deadline);
}

}  // namespace airybench
