#include "solvers/condensation/blind.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "assembly/sparse_bytes.hpp"
#include "solvers/direct/condition.hpp"
#include "solvers/direct/dense_factors.hpp"

namespace airybench {
namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

std::vector<int> positions(const AirySystem& system, BlindNumbering numbering) {
  const int n = system.n(), n_f = system.n_f(), size = n + n_f + system.n_c();
  std::vector<int> order(static_cast<std::size_t>(size));  // which unknown stands where
  std::iota(order.begin(), order.end(), 0);
  if (numbering == BlindNumbering::multipliers_after_unknowns) {
    std::vector<int> last(order);  // unknown of φ that an unknown comes with
    const auto note = [&](const SparseRows& C, int first) {
      for (int row = 0; row < C.rows(); ++row) {
        last[first + row] = 0;
        for (SparseRows::InnerIterator entry(C, row); entry; ++entry)
          last[first + row] = std::max(last[first + row], static_cast<int>(entry.col()));
      }
    };
    note(system.C_F, n);
    note(system.C_C, n + n_f);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return last[a] < last[b]; });
  }
  std::vector<int> position(order.size());
  for (int k = 0; k < size; ++k) position[order[k]] = k;
  return position;
}

void add_rows(const SparseRows& C, int first, const std::vector<int>& position, Entries& entries) {
  for (int row = 0; row < C.rows(); ++row)
    for (SparseRows::InnerIterator entry(C, row); entry; ++entry) {
      const auto [low, high] = std::minmax(position[first + row], position[entry.col()]);
      entries.emplace_back(high, low, entry.value());
    }
}

Eigen::VectorXd load(const AirySystem& system, const std::vector<int>& position) {
  if (system.q.size() == 0 && system.F.size() == 0 && system.F0.size() == 0) return {};
  Eigen::VectorXd b = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(position.size()));
  const int n = system.n(), n_f = system.n_f();
  for (int i = 0; i < system.q.size(); ++i) b(position[i]) = system.q(i);
  for (int i = 0; i < system.F.size(); ++i) b(position[n + i]) = system.F(i);
  for (int i = 0; i < system.F0.size(); ++i) b(position[n + n_f + i]) = -system.F0(i);
  return b;
}

// Positions of λ'.
std::vector<int> contact_positions(const AirySystem& system, const BlindSystem& blind) {
  return {blind.position.end() - system.n_c(), blind.position.end()};
}

}  // namespace

std::size_t BlindSystem::bytes() const {
  return bytes_of(lower) + static_cast<std::size_t>(load.size()) * sizeof(double) +
         position.size() * sizeof(int);
}

BlindSystem make_blind_system(const AirySystem& system, BlindNumbering numbering) {
  const OwnerScope scope(MemoryOwner::system_matrix);
  BlindSystem blind;
  blind.position = positions(system, numbering);
  Entries entries;
  entries.reserve(static_cast<std::size_t>(system.S.nonZeros() + system.C_F.nonZeros() +
                                           system.C_C.nonZeros()));
  for (int column = 0; column < system.n(); ++column)
    for (SparseColumns::InnerIterator entry(system.S, column); entry; ++entry)
      entries.emplace_back(blind.position[entry.row()], blind.position[column], entry.value());
  add_rows(system.C_F, system.n(), blind.position, entries);
  add_rows(system.C_C, system.n() + system.n_f(), blind.position, entries);
  const auto size = static_cast<Eigen::Index>(blind.position.size());
  blind.lower.resize(size, size);
  blind.lower.setFromTriplets(entries.begin(), entries.end());
  blind.load = load(system, blind.position);
  return blind;
}

contact::Problem condense_blindly(const AirySystem& system, const BlindSystem& blind,
                                  const BlindSolve& solve, int columns_at_once) {
  const int n_c = system.n_c();
  if (n_c == 0) return {};
  const std::vector<int> contact = contact_positions(system, blind);
  const auto contact_part = [&](const auto& x) {
    Eigen::VectorXd part(n_c);
    for (int i = 0; i < n_c; ++i) part(i) = x(contact[i]);
    return part;
  };
  contact::Problem condensed{.points = system.contact};
  condensed.G.setZero(n_c);
  if (blind.load.size() > 0) {
    Eigen::VectorXd x = blind.load;
    solve(x);
    condensed.G = contact_part(x);
  }
  // In the order of their positions, so that neighbouring right-hand sides begin alike.
  std::vector<int> order(static_cast<std::size_t>(n_c));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return contact[a] < contact[b]; });
  Eigen::MatrixXd D(n_c, n_c), X(blind.lower.rows(), std::min(columns_at_once, n_c));
  for (int first = 0; first < n_c; first += columns_at_once) {
    auto block = X.leftCols(std::min(columns_at_once, n_c - first));
    block.setZero();
    for (int k = 0; k < block.cols(); ++k) block(contact[order[first + k]], k) = 1;
    solve(block);
    for (int k = 0; k < block.cols(); ++k) D.col(order[first + k]) = -contact_part(block.col(k));
  }
  condensed.D = (D + D.transpose()) / 2;
  cholesky(condensed.D, "blind condensation: D");
  return condensed;
}

contact::Problem condense_blindly(const ContactPoints& points, const Eigen::MatrixXd& schur,
                                  const Eigen::VectorXd& reduced_load) {
  contact::Problem condensed{.points = points};
  if (schur.size() == 0) return condensed;
  Eigen::MatrixXd L = cholesky(-schur, "blind condensation: W");
  condensed.G = -reduced_load;
  solve_by_cholesky(L, condensed.G);
  condensed.D = inverse_from_factor(std::move(L));
  return condensed;
}

Eigen::VectorXd blind_right_hand_side(const AirySystem& system, const BlindSystem& blind,
                                      const Eigen::VectorXd& F_C) {
  Eigen::VectorXd b =
      blind.load.size() > 0
          ? blind.load
          : Eigen::VectorXd(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(blind.lower.rows())));
  const std::vector<int> contact = contact_positions(system, blind);
  for (int i = 0; i < F_C.size(); ++i) b(contact[i]) += F_C(i);
  return b;
}

SaddleVector by_blocks(const AirySystem& system, const BlindSystem& blind,
                       const Eigen::VectorXd& solution) {
  const int n = system.n(), n_f = system.n_f(), n_c = system.n_c();
  SaddleVector v{Eigen::VectorXd(n), Eigen::VectorXd(n_f), Eigen::VectorXd(n_c)};
  const int* position = blind.position.data();
  for (Eigen::VectorXd* part : {&v.x, &v.lambda_F, &v.lambda_C})
    for (double& value : *part) value = solution(*position++);
  return v;
}

Eigen::VectorXd in_one(const AirySystem& system, const BlindSystem& blind, const SaddleVector& v) {
  Eigen::VectorXd all(system.n() + system.n_f() + system.n_c());
  const int* position = blind.position.data();
  for (const Eigen::VectorXd* part : {&v.x, &v.lambda_F, &v.lambda_C})
    for (const double value : *part) all(*position++) = value;
  return all;
}

void solve_blindly(const AirySystem& system, const RunControl& control, const BlindSystem& blind,
                   const BlindSolve& solve, int columns_at_once, Solution& solution,
                   const std::shared_ptr<const void>& owner) {
  if (control.condition) solution.condition_estimate = estimate_condition(blind.lower, solve);
  contact::Problem condensed;
  if (system.n_c() > 0)
    condensed = run_stage(solution.times, Stage::condense, MemoryOwner::condensed,
                          [&] { return condense_blindly(system, blind, solve, columns_at_once); });
  finish_in_airy_function(
      system, control, condensed,
      [&](const Eigen::VectorXd& F_C) {
        Eigen::VectorXd x = blind_right_hand_side(system, blind, F_C);
        solve(x);
        return by_blocks(system, blind, x);
      },
      [&blind, solve](const AirySystem& body, SaddleVector& v) {
        Eigen::VectorXd x = in_one(body, blind, v);
        solve(x);
        v = by_blocks(body, blind, x);
      },
      Refine::no, solution, owner);
}

void check_inertia(int negative_pivots, int expected) {
  if (negative_pivots != expected)
    throw Breakdown("blind condensation: " + std::to_string(negative_pivots) +
                    " negative pivots instead of " + std::to_string(expected));
}

}  // namespace airybench
