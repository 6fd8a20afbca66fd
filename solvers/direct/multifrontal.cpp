#include "solvers/direct/multifrontal.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "solvers/direct/dense_factors.hpp"
#include "solvers/direct/per_processor.hpp"
#include "support/map_at_once.hpp"

namespace airybench {
namespace {

using Panel = Eigen::Map<Eigen::MatrixXd>;

void add(int n, const double* __restrict from, double* __restrict to) {
  for (int i = 0; i < n; ++i) to[i] += from[i];
}

// The fronts of one factorisation, and the updates that wait for their parents: a stack, since
// children are done right before.
class Fronts {
 public:
  Fronts(const Elimination& elimination, const ElementMatrices& K)
      : elimination_(elimination),
        K_(K),
        waiting_(std::make_unique_for_overwrite<double[]>(elimination.update_doubles)),
        row_of_(elimination.place.size(), -1),
        to_(static_cast<std::size_t>(elimination.max_rows)),
        run_end_(to_.size()),
        element_row_(static_cast<std::size_t>(K.size)),
        element_column_(element_row_.size()) {
    map_at_once(waiting_.get(), elimination.update_doubles * sizeof(double));
  }

  // Into its columns of L.
  void eliminate(int f, double* columns) {
    const Front& front = elimination_.fronts[f];
    const std::span<const int> elements = elimination_.elements[f],
                               children = elimination_.children[f];
    const int* rows = elimination_.rows.data() + front.rows_at;
    for (int i = 0; i < front.rows; ++i) row_of_[rows[i]] = i;
    Panel panel(columns, front.rows, front.pivots);
    Panel update(waiting_.get() + top_, front.below(), front.below());
    for (const int element : elements) fetch(element);
    panel.setZero();
    set_lower_zero(update);
    for (const int element : elements) add_element(element, panel, update);
    // The last child's update is on top.
    std::size_t base = top_;
    for (std::size_t k = children.size(); k-- > 0;) {
      const Front& child = elimination_.fronts[children[k]];
      base -= child.update_doubles();
      add_update(child, waiting_.get() + base, panel, update);
    }
    factorise(front, panel, update);
    if (base < top_) lower_triangle_to(waiting_.get() + base, update);
    top_ = base + front.update_doubles();
  }

 private:
  // Elements lie where the mesh has them: anywhere.
  void fetch(int element) const {
    constexpr std::size_t line = 64;
    const std::span<const double> lower = K_.lower[element];
    const auto* bytes = reinterpret_cast<const char*>(lower.data());
    for (std::size_t b = 0; b < lower.size_bytes(); b += line) __builtin_prefetch(bytes + b);
    __builtin_prefetch(K_.unknown[element].data());
  }

  // Nothing else is read; where there is little, one call does it.
  static void set_lower_zero(Panel& update) {
    constexpr int few = 64;
    const Eigen::Index n = update.rows();
    if (n <= few)
      update.setZero();
    else
      for (Eigen::Index j = 0; j < n; ++j) update.col(j).tail(n - j).setZero();
  }

  // The column of the front's matrix, to be indexed by the front's rows.
  static double* column(int j, Panel& panel, Panel& update) {
    const auto pivots = panel.cols();
    return j < pivots ? panel.data() + j * panel.rows()
                      : update.data() + (j - pivots) * update.rows() - pivots;
  }

  void add_element(int element, Panel& panel, Panel& update) {
    const int size = K_.size;
    int* const row = element_row_.data();
    double** const at = element_column_.data();
    const std::span<const int> unknowns = K_.unknown[element];
    for (int i = 0; i < size; ++i) {
      const int unknown = unknowns[i];
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
    if (!factorise_in_place(panel))
      throw Breakdown(
          "multifrontal Cholesky: the matrix is not positive definite in the front at " +
          std::to_string(front.first + 1) + " of " + std::to_string(elimination_.place.size()) +
          " pivots");
    add_square(-1, panel.bottomRows(front.below()), update);
  }

  // The place is below, and may overlap.
  static void lower_triangle_to(double* to, const Panel& update) {
    const Eigen::Index n = update.rows();
    for (Eigen::Index j = 0; j < n; ++j) std::copy_n(&update(j, j), n - j, to + j * n + j);
  }

  const Elimination& elimination_;
  const ElementMatrices& K_;
  std::unique_ptr<double[]> waiting_;
  std::size_t top_ = 0;
  std::vector<int> row_of_;  // of a place, in the front at work
  std::vector<int> to_, run_end_;
  std::vector<int> element_row_;  // of each unknown of the element at work, and its column
  std::vector<double*> element_column_;
};

template <typename Entry>
std::unique_ptr<Entry[]> room_for(const Elimination& elimination) {
  auto panels = std::make_unique_for_overwrite<Entry[]>(elimination.panel_entries);
  map_at_once(panels.get(), elimination.panel_entries * sizeof(Entry));
  return panels;
}

// Calls eliminate(index of the front) for all of them.
template <typename Eliminate>
void visit_fronts(const Elimination& elimination, const Deadline& deadline, Eliminate eliminate) {
  double since_asked = 0;
  for (const int f : elimination.order) {
    const Front& front = elimination.fronts[f];
    eliminate(f);
    since_asked += static_cast<double>(front.pivots) * front.rows * front.rows;
    if (since_asked > 1e8) {
      deadline.check("the factorisation");
      since_asked = 0;
    }
  }
}

// Columns of L, four at a time: a solve reads all of L, and does little else.
constexpr int abreast = 4;

// y −= Σ_k x_k L_k.
template <typename Entry>
AIRYBENCH_PER_PROCESSOR void subtract_columns(const Entry* L, int stride, int count,
                                              const double* x, int rows, double* y) {
  if (count == abreast) {
    const Entry *a = L, *b = a + stride, *c = b + stride, *d = c + stride;
    for (int i = 0; i < rows; ++i)
      y[i] -= (a[i] * x[0] + b[i] * x[1]) + (c[i] * x[2] + d[i] * x[3]);
    return;
  }
  for (int k = 0; k < count; ++k, L += stride)
    for (int i = 0; i < rows; ++i) y[i] -= L[i] * x[k];
}

// x_k −= L_k · y.
template <typename Entry>
AIRYBENCH_PER_PROCESSOR void subtract_products(const Entry* L, int stride, int count,
                                               const double* y, int rows, double* x) {
  constexpr int lanes = 4;
  double sum[abreast][lanes] = {};
  const int whole = rows / lanes * lanes;
  if (count == abreast) {
    const Entry *a = L, *b = a + stride, *c = b + stride, *d = c + stride;
    for (int i = 0; i < whole; i += lanes)
      for (int l = 0; l < lanes; ++l) {
        sum[0][l] += a[i + l] * y[i + l];
        sum[1][l] += b[i + l] * y[i + l];
        sum[2][l] += c[i + l] * y[i + l];
        sum[3][l] += d[i + l] * y[i + l];
      }
  } else {
    for (int k = 0; k < count; ++k)
      for (int i = 0; i < whole; i += lanes)
        for (int l = 0; l < lanes; ++l)
          sum[k][l] += L[static_cast<std::size_t>(k) * stride + i + l] * y[i + l];
  }
  for (int k = 0; k < count; ++k, L += stride) {
    double of_column = (sum[k][0] + sum[k][1]) + (sum[k][2] + sum[k][3]);
    for (int i = whole; i < rows; ++i) of_column += L[i] * y[i];
    x[k] -= of_column;
  }
}

// Of a front, those before `end`.
int pivots_before(int end, const Front& front) {
  return std::clamp(end - front.first, 0, front.pivots);
}

// y ← L⁻¹ y, in the factor's order, by the columns before `end`.
template <typename Entry>
void solve_forward(const Elimination& elimination, const Entry* panels, int end,
                   Eigen::VectorXd& y) {
  std::vector<double> of_front(elimination.max_rows);  // its pivots and the rows below
  for (const Front& front : elimination.fronts) {
    const int pivots = pivots_before(end, front);
    if (pivots == 0) continue;
    const int* rows = elimination.rows.data() + front.rows_at;
    double* x = of_front.data();
    std::copy_n(y.data() + front.first, pivots, x);
    std::fill_n(x + pivots, front.rows - pivots, 0.0);
    const Entry* L = panels + front.panel_at;
    for (int j = 0; j < pivots; j += abreast) {
      const int count = std::min(abreast, pivots - j), after = j + count;
      for (int k = j; k < after; ++k) {
        const Entry* column = L + static_cast<std::size_t>(k) * front.rows;
        x[k] /= column[k];
        for (int i = k + 1; i < after; ++i) x[i] -= column[i] * x[k];
      }
      subtract_columns(L + static_cast<std::size_t>(j) * front.rows + after, front.rows, count,
                       x + j, front.rows - after, x + after);
    }
    std::copy_n(x, pivots, y.data() + front.first);
    for (int i = pivots; i < front.rows; ++i) y(rows[i]) += x[i];
  }
}

// x ← L⁻ᵀ x, by the columns before `end`: what comes after them is x already.
template <typename Entry>
void solve_backward(const Elimination& elimination, const Entry* panels, int end,
                    Eigen::VectorXd& of_all) {
  std::vector<double> of_front(elimination.max_rows);
  for (std::size_t f = elimination.fronts.size(); f-- > 0;) {
    const Front& front = elimination.fronts[f];
    const int pivots = pivots_before(end, front);
    if (pivots == 0) continue;
    const int* rows = elimination.rows.data() + front.rows_at;
    double* x = of_front.data();
    for (int i = 0; i < front.rows; ++i) x[i] = of_all(rows[i]);
    const Entry* L = panels + front.panel_at;
    for (int j = (pivots - 1) / abreast * abreast; j >= 0; j -= abreast) {
      const int count = std::min(abreast, pivots - j), after = j + count;
      subtract_products(L + static_cast<std::size_t>(j) * front.rows + after, front.rows, count,
                        x + after, front.rows - after, x + j);
      for (int k = after; k-- > j;) {
        const Entry* column = L + static_cast<std::size_t>(k) * front.rows;
        for (int i = k + 1; i < after; ++i) x[k] -= column[i] * x[i];
        x[k] /= column[k];
      }
    }
    std::copy_n(x, pivots, of_all.data() + front.first);
  }
}

// L_CC of the last n unknowns.
template <typename Entry>
Eigen::MatrixXd trailing_columns(const Elimination& elimination, const Entry* panels) {
  const int n = elimination.trailing;
  const int first = static_cast<int>(elimination.place.size()) - n;
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (const Front& front : elimination.fronts) {
    const int* rows = elimination.rows.data() + front.rows_at;
    const Entry* column = panels + front.panel_at;
    for (int j = 0; j < front.pivots; ++j, column += front.rows)
      if (front.first + j >= first)
        for (int i = j; i < front.rows; ++i)
          L(rows[i] - first, front.first + j - first) = column[i];
  }
  return L;
}

}  // namespace

void MultifrontalFactor::analyse(const ElementMatrices& K, int trailing) {
  elimination_ = analyse_elimination(K, trailing);
}

void MultifrontalFactor::factor(const ElementMatrices& K, const Deadline& deadline) {
  rounded_.reset();
  panels_.reset();  // that of another matrix goes before
  panels_ = room_for<double>(elimination_);
  Fronts fronts(elimination_, K);
  visit_fronts(elimination_, deadline, [&](int f) {
    fronts.eliminate(f, panels_.get() + elimination_.fronts[f].panel_at);
  });
}

void MultifrontalFactor::factor_rounded(const ElementMatrices& K, const Deadline& deadline) {
  constexpr double most = 0.1;
  panels_.reset();
  rounded_ = room_for<float>(elimination_);
  {
    std::vector<double> columns;
    Fronts fronts(elimination_, K);
    visit_fronts(elimination_, deadline, [&](int f) {
      const Front& front = elimination_.fronts[f];
      columns.resize(static_cast<std::size_t>(front.rows) * front.pivots);
      fronts.eliminate(f, columns.data());
      std::copy(columns.begin(), columns.end(), rounded_.get() + front.panel_at);
    });
  }
  if (!(error_in_soft_modes(K) <= most)) factor(K, deadline);
}

double MultifrontalFactor::error_in_soft_modes(const ElementMatrices& K) const {
  std::mt19937 bits;
  const Eigen::VectorXd r =
      Eigen::VectorXd::NullaryExpr(K.order, [&] { return bits() < bits.max() / 2 ? -1.0 : 1.0; });
  const Eigen::VectorXd z = backward(forward(r));
  Eigen::VectorXd Kz = Eigen::VectorXd::Zero(K.order);
  add_product(K, z, Kz);
  return std::abs(1 - z.dot(Kz) / z.dot(r));
}

void MultifrontalFactor::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X,
                                        const Deadline& deadline) const {
  for (Eigen::Index j = 0; j < X.cols(); ++j) {
    X.col(j) = backward(forward(X.col(j)));
    deadline.check("the solves with the multifrontal factor");
  }
}

Eigen::VectorXd MultifrontalFactor::forward(const Eigen::VectorXd& b, Columns columns) const {
  Eigen::VectorXd y(b.size());
  for (Eigen::Index i = 0; i < b.size(); ++i) y(elimination_.place[i]) = b(i);
  visit_panels([&](const auto* panels) { solve_forward(elimination_, panels, end(columns), y); });
  return y;
}

Eigen::VectorXd MultifrontalFactor::backward(const Eigen::VectorXd& z, Columns columns) const {
  Eigen::VectorXd x = z, result(z.size());
  visit_panels([&](const auto* panels) { solve_backward(elimination_, panels, end(columns), x); });
  for (Eigen::Index i = 0; i < x.size(); ++i) result(i) = x(elimination_.place[i]);
  return result;
}

int MultifrontalFactor::end(Columns columns) const {
  const auto all = static_cast<int>(elimination_.place.size());
  return columns == Columns::all ? all : all - elimination_.trailing;
}

Eigen::MatrixXd MultifrontalFactor::trailing_factor() const {
  return visit_panels([&](const auto* panels) { return trailing_columns(elimination_, panels); });
}

std::size_t MultifrontalFactor::bytes() const {
  return elimination_.panel_entries * (rounded() ? sizeof(float) : sizeof(double)) +
         elimination_.fronts.size() * (sizeof(Front) + sizeof(int)) +
         elimination_.children.bytes() + elimination_.elements.bytes() +
         (elimination_.rows.size() + 2 * elimination_.place.size()) * sizeof(int);
}

std::int64_t MultifrontalFactor::entries() const { return elimination_.entries(); }

double MultifrontalFactor::flops() const { return elimination_.flops(); }

}  // namespace airybench
