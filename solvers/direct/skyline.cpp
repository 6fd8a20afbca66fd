#include "solvers/direct/skyline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace airybench {
namespace {

// Columns solved together: wide enough for matrix products, narrow enough for the cache.
constexpr Eigen::Index columns_at_once = 192;

// The blocks of a panel; Scalar is double or const double.
template <typename Scalar>
struct PanelBlocks {
  using Block = Eigen::Map<
      std::conditional_t<std::is_const_v<Scalar>, const Eigen::MatrixXd, Eigen::MatrixXd>>;
  Block tall, rest, corner;  // rest: the short rows

  PanelBlocks(Scalar* values, const SkylinePanel& p)
      : tall(values + p.offset, p.tall, p.row - p.column),
        rest(tall.data() + tall.size(), p.rows - p.tall, p.row - p.short_column),
        corner(rest.data() + rest.size(), p.rows, p.rows) {}
};

// The rows of a panel that share a leading column.
struct RowGroup {
  int begin, end;  // rows inside the panel
  int column;
};
std::array<RowGroup, 2> row_groups(const SkylinePanel& p) {
  return {RowGroup{0, p.tall, p.column}, RowGroup{p.tall, p.rows, p.short_column}};
}

// Splits a panel's rows, given their first columns, into tall and short so that the least is
// stored; returns the panel's rows in their new order.
std::vector<int> split_rows(SkylinePanel& panel, const std::vector<int>& first) {
  std::vector<int> order(static_cast<std::size_t>(panel.rows));
  for (int i = 0; i < panel.rows; ++i) order[i] = panel.row + i;
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return first[a] < first[b]; });
  panel.column = first[order.front()];
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (int tall = 1; tall <= panel.rows; ++tall) {
    SkylinePanel candidate = panel;
    candidate.tall = tall;
    candidate.short_column = tall < panel.rows ? first[order[tall]] : panel.row;
    if (candidate.size() < least) {
      least = candidate.size();
      panel = candidate;
    }
  }
  return order;
}

void scatter(const Eigen::SparseMatrix<double>& lower, SkylineFactor& factor) {
  const SkylineProfile& profile = factor.profile;
  for (int col = 0; col < lower.cols(); ++col) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, col); entry; ++entry) {
      const int i = profile.position[entry.row()], j = profile.position[col];
      const SkylinePanel& panel = profile.panels[profile.panel_of_row[i]];
      PanelBlocks<double> blocks(factor.values.data(), panel);
      if (j >= panel.row)
        blocks.corner(std::max(i, j) - panel.row, std::min(i, j) - panel.row) = entry.value();
      else if (i - panel.row < panel.tall)
        blocks.tall(i - panel.row, j - panel.column) = entry.value();
      else
        blocks.rest(i - panel.row - panel.tall, j - panel.short_column) = entry.value();
    }
  }
}

// In place A = L D Lᵀ of a panel's corner; lower triangle only.
void factor_corner(Eigen::Ref<Eigen::MatrixXd> a, int first_row) {
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    const double pivot = a(j, j);
    if (!(std::abs(pivot) > 0) || !std::isfinite(pivot))
      throw Breakdown("skyline LDLT: pivot " + std::to_string(first_row + j + 1) + " is " +
                      std::to_string(pivot));
    const Eigen::Index below = a.rows() - j - 1;
    for (Eigen::Index k = 0; k < below; ++k) {
      const double l = a(j + 1 + k, j) / pivot;
      a.col(j + 1 + k).tail(below - k) -= l * a.col(j).tail(below - k);
    }
    a.col(j).tail(below) /= pivot;
  }
}

// w: the rows of a panel that begin at column `first`, to the left of its corner; on entry A, on
// exit W = L D, columns before `end` done.
void eliminate_left(const SkylineFactor& factor, Eigen::Ref<Eigen::MatrixXd> w, int first,
                    int end) {
  const SkylineProfile& profile = factor.profile;
  if (w.size() == 0) return;
  for (int k = profile.panel_of_row[first]; k < profile.panel_of_row[end]; ++k) {
    const SkylinePanel& earlier = profile.panels[k];
    const PanelBlocks<const double> l(factor.values.data(), earlier);
    const int reached = std::max(first, earlier.row) - earlier.row;  // its rows from here on
    for (const RowGroup& group : row_groups(earlier)) {
      const int begin = std::max(reached, group.begin), count = group.end - begin;
      const int from = std::max(first, group.column), inner = earlier.row - from;
      if (count <= 0 || inner <= 0) continue;
      const auto& block = group.begin == 0 ? l.tall : l.rest;
      w.middleCols(earlier.row + begin - first, count).noalias() -=
          w.middleCols(from - first, inner) *
          block.block(begin - group.begin, from - group.column, count, inner).transpose();
    }
    const int size = earlier.rows - reached;
    auto target = w.middleCols(earlier.row + reached - first, size);
    l.corner.bottomRightCorner(size, size)
        .triangularView<Eigen::UnitLower>()
        .transpose()
        .solveInPlace<Eigen::OnTheRight>(target);
  }
}

// scaled: workspace, at least rows × left columns.
void factor_panel(SkylineFactor& factor, const SkylinePanel& panel, Eigen::MatrixXd& scaled) {
  PanelBlocks<double> own(factor.values.data(), panel);
  eliminate_left(factor, own.tall, panel.column, panel.row);
  eliminate_left(factor, own.rest, panel.short_column, panel.row);

  // A_II − W D⁻¹ Wᵀ; the short rows meet the tall ones from short_column on.
  const int short_rows = panel.rows - panel.tall, shared = panel.row - panel.short_column;
  auto l_tall = scaled.topLeftCorner(panel.tall, panel.row - panel.column);
  l_tall =
      own.tall *
      factor.diagonal.segment(panel.column, panel.row - panel.column).cwiseInverse().asDiagonal();
  own.corner.topLeftCorner(panel.tall, panel.tall).noalias() -= l_tall * own.tall.transpose();
  if (short_rows > 0 && shared > 0) {
    own.corner.bottomLeftCorner(short_rows, panel.tall).noalias() -=
        own.rest * l_tall.rightCols(shared).transpose();
  }
  own.tall = l_tall;
  if (short_rows > 0 && shared > 0) {
    auto l_rest = scaled.topLeftCorner(short_rows, shared);
    l_rest =
        own.rest * factor.diagonal.segment(panel.short_column, shared).cwiseInverse().asDiagonal();
    own.corner.bottomRightCorner(short_rows, short_rows).noalias() -= l_rest * own.rest.transpose();
    own.rest = l_rest;
  }
  factor_corner(own.corner, panel.row);
  factor.diagonal.segment(panel.row, panel.rows) = own.corner.diagonal();
}

// Brings the rows of every panel into the panel's order, or back.
void permute_rows(const SkylineProfile& profile, Eigen::Ref<Eigen::MatrixXd> x, bool back) {
  std::array<double, most_panel_rows> buffer;
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    for (const SkylinePanel& panel : profile.panels) {
      double* rows = &x(panel.row, j);
      for (int i = 0; i < panel.rows; ++i) {
        const int moved = profile.position[panel.row + i] - panel.row;
        (back ? buffer[i] : buffer[moved]) = back ? rows[moved] : rows[i];
      }
      std::copy_n(buffer.begin(), panel.rows, rows);
    }
}

Eigen::Index first_nonzero_row(const Eigen::Ref<const Eigen::MatrixXd>& x) {
  Eigen::Index first = x.rows();
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    Eigen::Index i = 0;
    while (i < first && x(i, j) == 0) ++i;
    first = i;
  }
  return first;
}

void solve_columns(const SkylineFactor& factor, Eigen::Ref<Eigen::MatrixXd> x,
                   const Deadline& deadline) {
  const SkylineProfile& profile = factor.profile;
  const auto first_row = first_nonzero_row(x);
  if (first_row == profile.n) return;  // all zero
  const int first_panel = profile.panel_of_row[first_row];
  const int first = profile.panels[first_panel].row;  // rows before are zero
  permute_rows(profile, x, false);

  for (std::size_t k = first_panel; k < profile.panels.size(); ++k) {  // L y = b
    const SkylinePanel& panel = profile.panels[k];
    const PanelBlocks<const double> l(factor.values.data(), panel);
    for (const RowGroup& group : row_groups(panel)) {
      const int from = std::max(group.column, first), inner = panel.row - from;
      const int count = group.end - group.begin;
      if (count == 0 || inner <= 0) continue;
      const auto& block = group.begin == 0 ? l.tall : l.rest;
      x.middleRows(panel.row + group.begin, count).noalias() -=
          block.rightCols(inner) * x.middleRows(from, inner);
    }
    auto solved = x.middleRows(panel.row, panel.rows);
    l.corner.triangularView<Eigen::UnitLower>().solveInPlace(solved);
  }
  deadline.check("the skyline solves");
  for (Eigen::Index j = 0; j < x.cols(); ++j)  // z = D⁻¹ y
    x.col(j).tail(profile.n - first).array() /= factor.diagonal.tail(profile.n - first).array();
  for (auto panel = profile.panels.rbegin(); panel != profile.panels.rend(); ++panel) {  // Lᵀ x = z
    const PanelBlocks<const double> l(factor.values.data(), *panel);
    auto solved = x.middleRows(panel->row, panel->rows);
    l.corner.triangularView<Eigen::UnitLower>().transpose().solveInPlace(solved);
    for (const RowGroup& group : row_groups(*panel)) {
      const int inner = panel->row - group.column, count = group.end - group.begin;
      if (count == 0 || inner == 0) continue;
      const auto& block = group.begin == 0 ? l.tall : l.rest;
      x.middleRows(group.column, inner).noalias() -=
          block.transpose() * solved.middleRows(group.begin, count);
    }
  }
  permute_rows(profile, x, true);
  deadline.check("the skyline solves");
}

}  // namespace

SkylineProfile analyse_skyline(const Eigen::SparseMatrix<double>& lower, int panel_rows) {
  if (panel_rows < 1 || panel_rows > most_panel_rows)
    throw std::invalid_argument("analyse_skyline: panel_rows is " + std::to_string(panel_rows) +
                                " (allowed: 1 to " + std::to_string(most_panel_rows) + ")");
  SkylineProfile profile;
  const int n = profile.n = static_cast<int>(lower.rows());
  profile.panel_of_row.resize(n);
  profile.position.resize(n);
  std::vector<int> skyline(n), first(n);  // first columns in S, and in the panels' order
  for (int i = 0; i < n; ++i) skyline[i] = first[i] = i;

  for (int row = 0; row < n; row += panel_rows) {
    SkylinePanel panel;
    panel.row = panel.column = panel.short_column = row;
    panel.rows = std::min(panel_rows, n - row);
    for (int i = row; i < row + panel.rows; ++i) first[i] = std::min(first[i], row);
    const std::vector<int> order = split_rows(panel, first);
    for (int i = 0; i < panel.rows; ++i) {
      profile.position[order[i]] = row + i;
      profile.panel_of_row[row + i] = static_cast<int>(profile.panels.size());
    }
    for (int col = row; col < row + panel.rows; ++col)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, col); entry; ++entry) {
        skyline[entry.row()] = std::min(skyline[entry.row()], col);
        first[entry.row()] = std::min(first[entry.row()], profile.position[col]);
      }
    panel.offset = profile.stored;
    profile.stored += panel.size();
    profile.panels.push_back(panel);
  }
  for (int i = 0; i < n; ++i) {
    const double height = i - skyline[i] + 1;
    profile.profile += i - skyline[i] + 1;
    profile.factor_flops += height * height;
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
    left = std::max(left, panel.row - panel.column);
  }
  Eigen::MatrixXd scaled(rows, left);
  for (const SkylinePanel& panel : factor.profile.panels) {
    factor_panel(factor, panel, scaled);
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
