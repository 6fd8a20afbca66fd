#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "solvers/direct/skyline.hpp"

namespace airybench {
namespace {

// Splits a panel's rows, given their first columns, into tall and short so that the least is
// stored; returns the panel's rows in their new order.
std::vector<int> split_rows(SkylinePanel& panel, const std::vector<int>& first) {
  std::vector<int> order(static_cast<std::size_t>(panel.rows));
  std::iota(order.begin(), order.end(), panel.row);
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

std::vector<int> rows_as_numbered(SkylinePanel& panel, const std::vector<int>& first) {
  std::vector<int> order(static_cast<std::size_t>(panel.rows));
  std::iota(order.begin(), order.end(), panel.row);
  for (const int i : order) panel.column = std::min(panel.column, first[i]);
  panel.tall = panel.rows;
  return order;
}

}  // namespace

SkylineProfile analyse_skyline(const Eigen::SparseMatrix<double>& lower, int panel_rows,
                               PanelOrder panel_order) {
  if (panel_rows < 1 || panel_rows > max_panel_rows)
    throw std::invalid_argument("analyse_skyline: panel_rows is " + std::to_string(panel_rows) +
                                " (allowed: 1 to " + std::to_string(max_panel_rows) + ")");
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
    const std::vector<int> order = panel_order == PanelOrder::tall_first
                                       ? split_rows(panel, first)
                                       : rows_as_numbered(panel, first);
    for (int i = 0; i < panel.rows; ++i) {
      profile.position[order[i]] = row + i;
      profile.panel_of_row[row + i] = static_cast<int>(profile.panels.size());
    }
    for (int col = row; col < row + panel.rows; ++col)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(lower, col); entry; ++entry) {
        skyline[entry.row()] = std::min(skyline[entry.row()], col);
        first[entry.row()] = std::min(first[entry.row()], profile.position[col]);
      }
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

}  // namespace airybench
