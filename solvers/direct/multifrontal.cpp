#include "solvers/direct/multifrontal.hpp"

#include <cblas.h>

#include <algorithm>
#include <cmath>

#include "solvers/direct/dense_cholesky.hpp"
#include "support/huge_pages.hpp"

namespace airybench {
namespace {

using Panel = Eigen::Map<Eigen::MatrixXd>;
using ConstPanel = Eigen::Map<const Eigen::MatrixXd>;

void add(int n, const double* __restrict from, double* __restrict to) {
  for (int i = 0; i < n; ++i) to[i] += from[i];
}

// The fronts of one factorisation, and the updates that wait for their parents: a stack, since
// children are done right before.
class Fronts {
 public:
  Fronts(const Elimination& elimination, const ElementMatrices& K, double* panels)
      : elimination_(elimination),
        K_(K),
        panels_(panels),
        waiting_(std::make_unique_for_overwrite<double[]>(elimination.update_doubles)),
        row_of_(elimination.place.size(), -1) {
    prefer_huge_pages(waiting_.get(), elimination.update_doubles * sizeof(double));
  }

  void eliminate(const Front& front) {
    const int* rows = elimination_.rows.data() + front.rows_at;
    for (int i = 0; i < front.rows; ++i) row_of_[rows[i]] = i;
    Panel panel(panels_ + front.panel_at, front.rows, front.pivots);
    Panel update(waiting_.get() + top_, front.below(), front.below());
    // Their lower triangles: nothing else is read.
    for (int j = 0; j < front.pivots; ++j) std::fill_n(&panel(j, j), front.rows - j, 0.0);
    for (int j = 0; j < front.below(); ++j) std::fill_n(&update(j, j), front.below() - j, 0.0);
    for (const int element : front.elements) add_element(element, panel, update);
    // The last child's update is on top.
    std::size_t base = top_;
    for (std::size_t k = front.children.size(); k-- > 0;) {
      const Front& child = elimination_.fronts[front.children[k]];
      base -= child.update_doubles();
      add_update(child, waiting_.get() + base, panel, update);
    }
    factorise(front, panel, update);
    if (base < top_) std::copy_n(update.data(), update.size(), waiting_.get() + base);
    top_ = base + front.update_doubles();
  }

 private:
  // The column of the front's matrix, to be indexed by the front's rows.
  static double* column(int j, Panel& panel, Panel& update) {
    const auto pivots = panel.cols();
    return j < pivots ? panel.data() + j * panel.rows()
                      : update.data() + (j - pivots) * update.rows() - pivots;
  }

  void add_element(int element, Panel& panel, Panel& update) {
    constexpr int size = ElementMatrices::size;
    std::array<int, size> row;
    std::array<double*, size> at;
    for (int i = 0; i < size; ++i) {
      const int unknown = K_.unknown[element][i];
      row[i] = unknown < 0 ? -1 : row_of_[elimination_.place[unknown]];
      at[i] = unknown < 0 ? nullptr : column(row[i], panel, update);
    }
    const double* entry = K_.lower[element].data();
    for (int j = 0; j < size; ++j)
      for (int i = j; i < size; ++i, ++entry) {
        double* low = row[i] < row[j] ? at[i] : at[j];
        if (low != nullptr) low[std::max(row[i], row[j])] += *entry;
      }
  }

  // What a child left, by runs of rows that are neighbours here too.
  void add_update(const Front& child, const double* left, Panel& panel, Panel& update) {
    const int n = child.below();
    const int* rows = elimination_.rows.data() + child.rows_at + child.pivots;
    to_.resize(static_cast<std::size_t>(n));
    run_end_.resize(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) to_[i] = row_of_[rows[i]];
    for (int i = n - 1; i >= 0; --i)
      run_end_[i] = i + 1 < n && to_[i + 1] == to_[i] + 1 ? run_end_[i + 1] : i + 1;
    for (int j = 0; j < n; ++j, left += n) {
      double* target = column(to_[j], panel, update);
      for (int i = j; i < n;) {
        const int end = run_end_[i];
        add(end - i, left + i, target + to_[i]);
        i = end;
      }
    }
  }

  void factorise(const Front& front, Panel& panel, Panel& update) {
    const int pivots = front.pivots, below = front.below();
    if (!factorise_in_place(panel.topRows(pivots)))
      throw Breakdown(
          "multifrontal Cholesky: the matrix is not positive definite in the front at " +
          std::to_string(front.first + 1) + " of " + std::to_string(elimination_.place.size()) +
          " pivots");
    if (below == 0) return;
    cblas_dtrsm(CblasColMajor, CblasRight, CblasLower, CblasTrans, CblasNonUnit, below, pivots, 1,
                panel.data(), front.rows, panel.data() + pivots, front.rows);
    cblas_dsyrk(CblasColMajor, CblasLower, CblasNoTrans, below, pivots, -1, panel.data() + pivots,
                front.rows, 1, update.data(), below);
  }

  const Elimination& elimination_;
  const ElementMatrices& K_;
  double* panels_;
  std::unique_ptr<double[]> waiting_;
  std::size_t top_ = 0;
  std::vector<int> row_of_;  // of a place, in the front at work
  std::vector<int> to_, run_end_;
};

}  // namespace

void MultifrontalFactor::analyse(const ElementMatrices& K, int trailing) {
  elimination_ = analyse_elimination(K, trailing);
}

void MultifrontalFactor::factor(const ElementMatrices& K, const Deadline& deadline) {
  panels_ = std::make_unique_for_overwrite<double[]>(elimination_.panel_doubles);
  prefer_huge_pages(panels_.get(), elimination_.panel_doubles * sizeof(double));
  Fronts fronts(elimination_, K, panels_.get());
  double since_asked = 0;
  for (const int f : elimination_.order) {
    const Front& front = elimination_.fronts[f];
    fronts.eliminate(front);
    since_asked += static_cast<double>(front.pivots) * front.rows * front.rows;
    if (since_asked > 1e8) {
      deadline.check("the factorisation");
      since_asked = 0;
    }
  }
}

void MultifrontalFactor::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X,
                                        const Deadline& deadline) const {
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    X.col(j) = backward(forward(X.col(j)));
    deadline.check("the solves with the multifrontal factor");
  }
}

Eigen::VectorXd MultifrontalFactor::forward(const Eigen::VectorXd& b) const {
  Eigen::VectorXd y(b.size()), below;
  for (Eigen::Index i = 0; i < b.size(); ++i) y(elimination_.place[i]) = b(i);
  for (const Front& front : elimination_.fronts) {
    const ConstPanel panel(panels_.get() + front.panel_at, front.rows, front.pivots);
    auto x = y.segment(front.first, front.pivots);
    panel.topRows(front.pivots).triangularView<Eigen::Lower>().solveInPlace(x);
    below.noalias() = panel.bottomRows(front.below()) * x;
    const int* rows = elimination_.rows.data() + front.rows_at + front.pivots;
    for (int i = 0; i < front.below(); ++i) y(rows[i]) -= below(i);
  }
  return y;
}

Eigen::VectorXd MultifrontalFactor::backward(const Eigen::VectorXd& z) const {
  Eigen::VectorXd x = z, below;
  for (std::size_t f = elimination_.fronts.size(); f-- > 0;) {
    const Front& front = elimination_.fronts[f];
    const ConstPanel panel(panels_.get() + front.panel_at, front.rows, front.pivots);
    const int* rows = elimination_.rows.data() + front.rows_at + front.pivots;
    below.resize(front.below());
    for (int i = 0; i < front.below(); ++i) below(i) = x(rows[i]);
    auto own = x.segment(front.first, front.pivots);
    own.noalias() -= panel.bottomRows(front.below()).transpose() * below;
    panel.topRows(front.pivots).triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
  Eigen::VectorXd result(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) result(i) = x(elimination_.place[i]);
  return result;
}

Eigen::MatrixXd MultifrontalFactor::trailing_factor() const {
  const int n = elimination_.trailing;
  const int first = static_cast<int>(elimination_.place.size()) - n;
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (const Front& front : elimination_.fronts) {
    const int* rows = elimination_.rows.data() + front.rows_at;
    const double* column = panels_.get() + front.panel_at;
    for (int j = 0; j < front.pivots; ++j, column += front.rows)
      if (front.first + j >= first)
        for (int i = j; i < front.rows; ++i)
          L(rows[i] - first, front.first + j - first) = column[i];
  }
  return L;
}

std::size_t MultifrontalFactor::bytes() const {
  std::size_t elements = 0;
  for (const Front& front : elimination_.fronts)
    elements += front.elements.size() + front.children.size();
  return elimination_.panel_doubles * sizeof(double) +
         elimination_.fronts.size() * (sizeof(Front) + sizeof(int)) +
         (elimination_.rows.size() + 2 * elimination_.place.size() + elements) * sizeof(int);
}

std::int64_t MultifrontalFactor::entries() const { return elimination_.entries(); }

double MultifrontalFactor::flops() const { return elimination_.flops(); }

}  // namespace airybench
