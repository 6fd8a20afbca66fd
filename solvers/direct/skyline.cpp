#include "solvers/direct/skyline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "solvers/base/dense_products.hpp"
#include "solvers/base/parallel.hpp"
#include "solvers/direct/factor_counts.hpp"

namespace airybench {
namespace {

// The blocks of a panel; Scalar is double or const double.
template <typename Scalar>
struct PanelBlocks {
  using Block = Eigen::Map<
      std::conditional_t<std::is_const_v<Scalar>, const Eigen::MatrixXd, Eigen::MatrixXd>>;
  Block tall, rest, corner;  // rest: the short rows

  PanelBlocks(Scalar* values, const SkylinePanel& p)
      : tall(values, p.tall, p.row - p.column),
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

// The rows of S that belong to panel k, into its zeroed blocks.
void scatter(const Eigen::SparseMatrix<double>& lower, SkylineFactor& factor, std::size_t k) {
  const SkylineProfile& profile = factor.profile;
  const SkylinePanel& panel = profile.panels[k];
  const int end = panel.row + panel.rows;
  PanelBlocks<double> blocks(factor.values[k].data(), panel);
  for (int col = profile.panels[profile.panel_of_row[panel.column]].row; col < end; ++col) {
    const int j = profile.position[col];
    const int* const last = lower.innerIndexPtr() + lower.outerIndexPtr()[col + 1];
    const int* row =
        std::lower_bound(lower.innerIndexPtr() + lower.outerIndexPtr()[col], last, panel.row);
    for (; row != last && *row < end; ++row) {
      const double value = lower.valuePtr()[row - lower.innerIndexPtr()];
      const int i = profile.position[*row];
      if (j >= panel.row)
        blocks.corner(std::max(i, j) - panel.row, std::min(i, j) - panel.row) = value;
      else if (i - panel.row < panel.tall)
        blocks.tall(i - panel.row, j - panel.column) = value;
      else
        blocks.rest(i - panel.row - panel.tall, j - panel.short_column) = value;
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
    const PanelBlocks<const double> l(factor.values[k].data(), earlier);
    const int reached = std::max(first, earlier.row) - earlier.row;  // its rows from here on
    for (const RowGroup& group : row_groups(earlier)) {
      const int begin = std::max(reached, group.begin), count = group.end - begin;
      const int from = std::max(first, group.column), inner = earlier.row - from;
      if (count <= 0 || inner <= 0) continue;
      const auto& block = group.begin == 0 ? l.tall : l.rest;
      add_times_transposed(-1, w.middleCols(from - first, inner),
                           block.block(begin - group.begin, from - group.column, count, inner),
                           w.middleCols(earlier.row + begin - first, count));
    }
    const int size = earlier.rows - reached;
    solve_lower_transposed_right(l.corner.bottomRightCorner(size, size),
                                 w.middleCols(earlier.row + reached - first, size), Diagonal::unit);
  }
}

// scaled: workspace, at least rows × left columns.
void factor_panel(SkylineFactor& factor, std::size_t k, Eigen::MatrixXd& scaled) {
  const SkylinePanel& panel = factor.profile.panels[k];
  PanelBlocks<double> own(factor.values[k].data(), panel);
  eliminate_left(factor, own.tall, panel.column, panel.row);
  eliminate_left(factor, own.rest, panel.short_column, panel.row);

  // A_II − W D⁻¹ Wᵀ; the short rows meet the tall ones from short_column on.
  const int short_rows = panel.rows - panel.tall, shared = panel.row - panel.short_column;
  auto l_tall = scaled.topLeftCorner(panel.tall, panel.row - panel.column);
  l_tall =
      own.tall *
      factor.diagonal.segment(panel.column, panel.row - panel.column).cwiseInverse().asDiagonal();
  add_times_transposed(-1, l_tall, own.tall, own.corner.topLeftCorner(panel.tall, panel.tall));
  if (short_rows > 0 && shared > 0) {
    add_times_transposed(-1, own.rest, l_tall.rightCols(shared),
                         own.corner.bottomLeftCorner(short_rows, panel.tall));
  }
  own.tall = l_tall;
  if (short_rows > 0 && shared > 0) {
    auto l_rest = scaled.topLeftCorner(short_rows, shared);
    l_rest =
        own.rest * factor.diagonal.segment(panel.short_column, shared).cwiseInverse().asDiagonal();
    add_times_transposed(-1, l_rest, own.rest,
                         own.corner.bottomRightCorner(short_rows, short_rows));
    own.rest = l_rest;
  }
  factor_corner(own.corner, panel.row);
  factor.diagonal.segment(panel.row, panel.rows) = own.corner.diagonal();
}

// Brings the rows of every panel into the panel's order, or back.
void permute_rows(const SkylineProfile& profile, Eigen::Ref<Eigen::MatrixXd> x, bool back) {
  std::array<double, max_panel_rows> buffer;
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

// Panel after panel; done(k) is called when panel k is. Panels that done() empties must not be
// reached by later ones.
void factor_panels(SkylineFactor& factor, const Eigen::SparseMatrix<double>& lower,
                   const Deadline& deadline, const std::function<void(std::size_t)>& done) {
  const std::vector<SkylinePanel>& panels = factor.profile.panels;
  factor.values.resize(panels.size());
  factor.diagonal.resize(factor.profile.n);
  int rows = 0, left = 0;
  for (const SkylinePanel& panel : panels) {
    rows = std::max(rows, panel.rows);
    left = std::max(left, panel.row - panel.column);
  }
  Eigen::MatrixXd scaled(rows, left);
  for (std::size_t k = 0; k < panels.size(); ++k) {
    factor.values[k].assign(static_cast<std::size_t>(panels[k].size()), 0.0);
    scatter(lower, factor, k);
    factor_panel(factor, k, scaled);
    done(k);
    deadline.check("the skyline factorisation");
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

void solve_columns(const SkylineFactor& factor, DenseBlock x, const Deadline& deadline) {
  const SkylineProfile& profile = factor.profile;
  const auto first_row = first_nonzero_row(x);
  if (first_row == profile.n) return;  // all zero
  const int first_panel = profile.panel_of_row[first_row];
  const int first = profile.panels[first_panel].row;  // rows before are zero
  permute_rows(profile, x, false);

  for (std::size_t k = first_panel; k < profile.panels.size(); ++k) {  // L y = b
    const SkylinePanel& panel = profile.panels[k];
    const PanelBlocks<const double> l(factor.values[k].data(), panel);
    for (const RowGroup& group : row_groups(panel)) {
      const int from = std::max(group.column, first), inner = panel.row - from;
      const int count = group.end - group.begin;
      if (count == 0 || inner <= 0) continue;
      const auto& block = group.begin == 0 ? l.tall : l.rest;
      add_product(-1, block.rightCols(inner), x.middleRows(from, inner),
                  x.middleRows(panel.row + group.begin, count));
    }
    solve_lower(l.corner, x.middleRows(panel.row, panel.rows), Diagonal::unit);
  }
  deadline.check("the skyline solves");
  for (Eigen::Index j = 0; j < x.cols(); ++j)  // z = D⁻¹ y
    x.col(j).tail(profile.n - first).array() /= factor.diagonal.tail(profile.n - first).array();
  for (std::size_t k = profile.panels.size(); k-- > 0;) {  // Lᵀ x = z
    const SkylinePanel& panel = profile.panels[k];
    const PanelBlocks<const double> l(factor.values[k].data(), panel);
    auto solved = x.middleRows(panel.row, panel.rows);
    solve_lower_transposed(l.corner, solved, Diagonal::unit);
    for (const RowGroup& group : row_groups(panel)) {
      const int inner = panel.row - group.column, count = group.end - group.begin;
      if (count == 0 || inner == 0) continue;
      const auto& block = group.begin == 0 ? l.tall : l.rest;
      add_transposed_times(-1, block, solved.middleRows(group.begin, count),
                           x.middleRows(group.column, inner));
    }
  }
  permute_rows(profile, x, true);
  deadline.check("the skyline solves");
}

}  // namespace

SkylineFactor factor_ldlt(SkylineProfile profile, const Eigen::SparseMatrix<double>& lower,
                          const Deadline& deadline) {
  SkylineFactor factor{std::move(profile), {}, {}};
  factor_panels(factor, lower, deadline, [](std::size_t) {});
  return factor;
}

SkylineFactor factor_in_stages(const Eigen::SparseMatrix<double>& lower, const Deadline& deadline,
                               Solution& solution) {
  SkylineProfile profile = run_stage(solution.times, Stage::order, MemoryOwner::factor,
                                     [&] { return analyse_skyline(lower); });
  SkylineFactor factor = run_stage(solution.times, Stage::factor, MemoryOwner::factor, [&] {
    return factor_ldlt(std::move(profile), lower, deadline);
  });
  count_factor(factor, solution);
  return factor;
}

double visit_ldlt_rows(const Eigen::SparseMatrix<double>& lower, const VisitRow& visit,
                       const Deadline& deadline) {
  SkylineFactor factor{analyse_skyline(lower, 48, PanelOrder::as_numbered), {}, {}};
  const std::vector<SkylinePanel>& panels = factor.profile.panels;
  // The first panel that any panel from k on reaches.
  std::vector<int> needed(panels.size() + 1, static_cast<int>(panels.size()));
  for (std::size_t k = panels.size(); k-- > 0;)
    needed[k] = std::min(needed[k + 1], factor.profile.panel_of_row[panels[k].column]);
  std::vector<double> row;
  int forgotten = 0;
  factor_panels(factor, lower, deadline, [&](std::size_t k) {
    const SkylinePanel& panel = panels[k];
    const PanelBlocks<const double> l(factor.values[k].data(), panel);
    for (int i = 0; i < panel.rows; ++i) {
      const int left = panel.row - panel.column;
      row.resize(static_cast<std::size_t>(left + i));
      Eigen::Map<Eigen::RowVectorXd>(row.data(), left) = l.tall.row(i);
      Eigen::Map<Eigen::RowVectorXd>(row.data() + left, i) = l.corner.row(i).head(i);
      visit(panel.row + i, panel.column, row.data(), factor.diagonal.data() + panel.column);
    }
    for (; forgotten < needed[k + 1]; ++forgotten)
      std::vector<double>().swap(factor.values[forgotten]);
  });
  return factor.profile.factor_flops;
}

void solve_in_place(const SkylineFactor& factor, Eigen::Ref<Eigen::MatrixXd> X,
                    const Deadline& deadline, int threads) {
  const auto solve_range = [&](int begin, int end) {
    for (int j = begin; j < end; j += skyline_columns_at_once) {
      const int columns = std::min(skyline_columns_at_once, end - j);
      solve_columns(factor, X.middleCols(j, columns), deadline);
    }
  };
  in_parallel(threads, static_cast<int>(X.cols()), std::cref(solve_range));  // allocates nothing
}

}  // namespace airybench
