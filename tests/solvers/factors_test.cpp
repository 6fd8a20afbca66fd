// Factors of sparse matrices: what holds for all of them, then what holds for one.
#include <gtest/gtest.h>

#include <limits>

#include "solvers/direct/cholmod.hpp"
#include "solvers/direct/mumps.hpp"
#include "solvers/direct/skyline.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/places.hpp"
#include "tests/support/posed.hpp"

namespace airybench::factors_test {
namespace {

using testing::lower_of;

// [A Cᵀ; C 0] with a shifted grid Laplacian A and rows of C that each join two neighbours:
// indefinite, with zeros on the diagonal.
Eigen::MatrixXd grid_saddle(int side, int constraints) {
  const int n = side * side;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n + constraints, n + constraints);
  for (int i = 0; i < n; ++i) {
    M(i, i) = 4.1;
    if ((i + 1) % side != 0) M(i, i + 1) = M(i + 1, i) = -1;
    if (i + side < n) M(i, i + side) = M(i + side, i) = -1;
  }
  for (int k = 0; k < constraints; ++k) {
    M(n + k, 2 * k) = M(2 * k, n + k) = 1 + k;
    M(n + k, 2 * k + 1) = M(2 * k + 1, n + k) = -0.5;
  }
  return M;
}

Eigen::MatrixXd grid_matrix(int side) { return grid_saddle(side, 0); }

// X ← A⁻¹ X by a factor that is kept.
using SolveWith = std::function<void(Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline)>;

template <typename Factor, auto... arguments>
SolveWith by(const SparseColumns& lower) {
  const auto factor = std::make_shared<Factor>(arguments...);
  factor->analyse(lower);
  factor->factor(lower);
  EXPECT_EQ(factor->bytes() > 0, lower.rows() > 0);
  return [factor](Eigen::Ref<Eigen::MatrixXd> X, const Deadline& deadline) {
    factor->solve_in_place(X, deadline);
  };
}

SolveWith by_skyline(const SparseColumns& lower) {
  return [factor = factor_ldlt(analyse_skyline(lower), lower)](Eigen::Ref<Eigen::MatrixXd> X,
                                                               const Deadline& deadline) {
    solve_in_place(factor, X, deadline);
  };
}

struct Kind {
  const char* name;
  SolveWith (*factorise)(const SparseColumns& lower);
  bool indefinite;  // factorises such matrices
};
std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }

class Factor : public ::testing::TestWithParam<Kind> {
 protected:
  static SolveWith factorise(const Eigen::MatrixXd& A) { return GetParam().factorise(lower_of(A)); }
};
INSTANTIATE_TEST_SUITE_P(
    Kinds, Factor,
    ::testing::Values(Kind{"Skyline", by_skyline, true}, Kind{"Cholmod", by<CholmodFactor>, false},
                      Kind{"Mumps", by<MumpsFactor>, true},
                      Kind{"MumpsDefinite", by<MumpsFactor, MumpsFactor::Definite::yes>, false}),
    [](const auto& kind) { return kind.param.name; });

TEST_P(Factor, SolvesForAnyNumberOfColumnsWithAnOuterStride) {
  for (const int side : {1, 2, 5, 12})
    for (const int constraints : {0, side * side / 3}) {
      if (constraints > 0 && !GetParam().indefinite) continue;
      const Eigen::MatrixXd A = grid_saddle(side, constraints);
      const SolveWith solve = factorise(A);
      for (const int columns : {0, 1, 64, 70, 2 * skyline_columns_at_once + 3}) {
        const Eigen::MatrixXd b = Eigen::MatrixXd::Random(A.rows(), columns);
        Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(A.rows() + 5, columns);
        wide.topRows(A.rows()) = b;
        solve(wide.topRows(A.rows()), {});
        EXPECT_LE(testing::residual(A, wide.topRows(A.rows()), b),
                  (constraints > 0 ? 1e-12 : 1e-13) * b.norm())
            << side << ", " << constraints << " constraints, " << columns << " columns";
        if (columns > 0) {  // a matrix without entries has no rows to point to
          EXPECT_TRUE(wide.bottomRows(5).isZero(0));
        }
      }
      Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(A.rows(), 2);
      solve(zero, {});
      EXPECT_TRUE(zero.isZero(0));
    }
}

TEST_P(Factor, MatricesThatAreSingularIndefiniteOrNotFiniteAreBreakdowns) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double pivot : {0.0, -4.0, -1.0, std::nan(""), infinity}) {
    Eigen::MatrixXd A = grid_matrix(9);
    A.row(40).setZero();
    A.col(40).setZero();
    A(40, 40) = pivot;
    if (pivot < 0 && GetParam().indefinite)
      EXPECT_NO_THROW(factorise(A)) << pivot;
    else
      EXPECT_THROW(factorise(A), Breakdown) << pivot;
  }
  for (const double poison : {std::nan(""), infinity}) {
    Eigen::MatrixXd A = grid_matrix(4);
    A(9, 8) = A(8, 9) = poison;
    EXPECT_THROW(factorise(A), Breakdown) << poison;
  }
}

TEST_P(Factor, NothingToSolveAndOutOfTime) {
  Eigen::MatrixXd empty(0, 3), x = Eigen::MatrixXd::Ones(81, 2);
  factorise(Eigen::MatrixXd(0, 0))(empty, {});
  EXPECT_THROW(factorise(grid_matrix(9))(x, Deadline::after(-1)), TimeoutReached);
  EXPECT_NO_THROW(factorise(grid_matrix(9))(x, Deadline::after(1e300)));
}

// A random symmetric positive definite matrix whose row i begins at column first(i).
Eigen::MatrixXd random_skyline(int n, const std::function<int(int i)>& first) {
  static std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = first(i); j < i; ++j) A(i, j) = A(j, i) = uniform(generator);
  for (int i = 0; i < n; ++i) A(i, i) = 1 + A.row(i).cwiseAbs().sum();
  return A;
}

SkylineFactor skyline_factor(const Eigen::MatrixXd& A, int panel_rows,
                             const Deadline& deadline = {}) {
  return factor_ldlt(analyse_skyline(lower_of(A), panel_rows), lower_of(A), deadline);
}

void expect_solved(const Eigen::MatrixXd& A, int panel_rows, const Eigen::MatrixXd& b,
                   double tolerance) {
  Eigen::MatrixXd x = b;
  solve_in_place(skyline_factor(A, panel_rows), x);
  EXPECT_LT(testing::residual(A, x, b), tolerance * A.norm() * x.norm())
      << A.rows() << " rows, " << panel_rows << " in a panel";
}

TEST(Skyline, SolvesEveryShapeOfProfileWithEveryPanelSize) {
  const std::vector<std::function<int(int)>> shapes = {
      [](int) { return 0; }, [](int i) { return i; }, [](int i) { return std::max(0, i - 5); },
      [](int i) { return i % 3 == 0 ? std::max(0, i - 40) : i - i % 2; },
      [](int i) { return i > 60 ? 0 : i; }};  // dense, diagonal, band, alternating, arrow
  for (std::size_t shape = 0; shape < shapes.size(); ++shape)
    for (const int n : {1, 2, 67, 130}) {
      SCOPED_TRACE(shape);
      const Eigen::MatrixXd A = random_skyline(n, shapes[shape]);
      for (const int panel_rows : {1, 3, 16, 48, 200})
        expect_solved(A, panel_rows, Eigen::MatrixXd::Random(n, 7), 1e-14);
    }
}

TEST(Skyline, CountsTheClassicalProfile) {
  // Rows begin at columns 0, 0, 2, 1: heights 1, 2, 1, 3.
  Eigen::MatrixXd A = 4 * Eigen::MatrixXd::Identity(4, 4);
  A(1, 0) = A(0, 1) = A(3, 1) = A(1, 3) = 1;
  const SkylineProfile profile = analyse_skyline(lower_of(A), 2);
  EXPECT_EQ(profile.profile, 7);
  EXPECT_EQ(profile.factor_flops, 1 + 4 + 1 + 9);
  EXPECT_EQ(profile.solve_flops(), 28);
  EXPECT_GE(profile.stored, profile.profile);
}

TEST(Skyline, TakesRegularLeadingBlocksThatAreIndefiniteAndLeadingZerosOfTheRightHandSide) {
  Eigen::MatrixXd A(3, 3), b = Eigen::MatrixXd::Zero(300, 3);
  A << 1, 2, 0, 2, 1, 3, 0, 3, 5;  // leading minors 1, −3, −24
  expect_solved(A, 1, Eigen::Vector3d(1, 2, 3), 1e-15);
  b.bottomRows(40).setRandom();
  expect_solved(random_skyline(300, [](int i) { return std::max(0, i - 30); }), 16, b, 1e-15);
}

TEST(Skyline, RefusesImpossiblePanelSizesAndNamesAPivot) {
  SparseColumns S = lower_of(Eigen::MatrixXd::Identity(5, 5));
  EXPECT_THROW(analyse_skyline(S, 0), std::invalid_argument);
  EXPECT_THROW(analyse_skyline(S, max_panel_rows + 1), std::invalid_argument);
  S.coeffRef(2, 2) = std::nan("");
  EXPECT_EQ(testing::complaint_of<Breakdown>([&] { factor_ldlt(analyse_skyline(S, 2), S); }),
            "skyline LDLT: pivot 3 is nan");
  S.coeffRef(2, 2) = 0;
  EXPECT_THROW(factor_ldlt(analyse_skyline(S, 2), S), Breakdown);
}

TEST(Mumps, CountsNegativePivotsOfSeveralAtOnce) {
  const std::array<SparseColumns, 3> matrices = {
      lower_of(grid_saddle(2, 1)), lower_of(grid_saddle(5, 8)), lower_of(grid_saddle(12, 48))};
  std::array<MumpsFactor, 3> factors;
  for (std::size_t k = 0; k < 3; ++k) factors[k].analyse(matrices[k]);
  for (std::size_t k = 0; k < 3; ++k) factors[k].factor(matrices[k]);
  for (const auto& [k, constraints] : {std::pair(0, 1), {1, 8}, {2, 48}}) {
    EXPECT_EQ(factors[k].negative_pivots(), constraints);
    EXPECT_EQ(factors[k].schur().size(), 0);
  }
}

TEST(Mumps, SchurComplementReductionAndExpansionAreThoseOfDenseAlgebra) {
  for (const int side : {2, 7, 15}) {
    const Eigen::MatrixXd M = grid_saddle(side, side * side / 3);
    const auto size = M.rows();
    for (const Eigen::Index trailing :
         {Eigen::Index{1}, Eigen::Index{side * side / 3}, size - 1}) {  // multipliers, and more
      SCOPED_TRACE(::testing::Message() << trailing << " of " << size);
      const Eigen::Index inner = size - trailing;
      const Eigen::MatrixXd A_II = M.topLeftCorner(inner, inner);
      const Eigen::MatrixXd A_CI = M.bottomLeftCorner(trailing, inner);
      const auto lu = testing::factorised(A_II);
      const Eigen::MatrixXd schur =
          M.bottomRightCorner(trailing, trailing) - A_CI * lu(A_CI.transpose());
      MumpsFactor factor;
      factor.analyse(lower_of(M), static_cast<int>(trailing));
      factor.factor(lower_of(M));
      ASSERT_EQ(factor.schur().rows(), trailing);
      EXPECT_LT(testing::distance(factor.schur(), schur), 1e-13 * M.norm());
      EXPECT_EQ(testing::distance(factor.schur(), factor.schur().transpose()), 0);
      EXPECT_EQ(factor.negative_pivots(), (testing::eigenvalues(A_II).array() < 0).count());

      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(size, -1, 2);
      const Eigen::VectorXd reduced = factor.reduce(b);
      EXPECT_LT(testing::distance(reduced, b.tail(trailing) - A_CI * lu(b.head(inner))),
                1e-12 * b.norm());
      const Eigen::VectorXd x = factor.expand(testing::solved(schur, reduced));
      EXPECT_LT(testing::residual(M, x, b), 1e-11 * b.norm());
      // Whatever the trailing unknowns are, the inner equations hold.
      factor.reduce(b);
      const Eigen::VectorXd other = factor.expand(Eigen::VectorXd::Ones(trailing));
      EXPECT_LT(testing::distance(other.tail(trailing), Eigen::VectorXd::Ones(trailing)), 1e-15);
      EXPECT_LT(testing::residual(M.topRows(inner), other, b.head(inner)), 1e-11 * b.norm());
    }
  }
}

TEST(Mumps, ASingularOrNotFiniteSaddleIsABreakdown) {
  const auto factorise = [](double poison, int trailing) {
    Eigen::MatrixXd M = grid_saddle(4, 5);
    M(9, 8) = M(8, 9) = poison;
    if (poison == 0) {
      M.row(17).setZero();
      M.col(17).setZero();
    }
    MumpsFactor factor;
    factor.analyse(lower_of(M), trailing);
    factor.factor(lower_of(M));
  };
  EXPECT_THROW(factorise(0, 0), Breakdown);
  for (const double poison : {std::nan(""), std::numeric_limits<double>::infinity()})
    for (const int trailing : {0, 3})
      EXPECT_THROW(factorise(poison, trailing), Breakdown) << poison << ", " << trailing;
}

// Of the star c–p, a–p, a–s, p–s with C = {c, p, s} the factor has c before a, and small supernodes
// are merged.
Eigen::MatrixXd star_matrix() {
  Eigen::MatrixXd A = 4 * Eigen::MatrixXd::Identity(4, 4);  // a, c, p, s
  for (const auto& [i, j] : {std::pair(0, 2), {0, 3}, {2, 3}, {1, 2}}) A(i, j) = A(j, i) = -1;
  return A;
}

TEST(Cholmod, InvertsTheSchurComplementOfTheLastUnknownsAndIsFactorisedAgain) {
  for (Eigen::MatrixXd A :
       {grid_matrix(1), grid_matrix(2), grid_matrix(9), grid_matrix(16), star_matrix()}) {
    const auto size = A.rows();
    const Eigen::MatrixXd inverse = testing::solved(A, Eigen::MatrixXd::Identity(size, size));
    for (const Eigen::Index trailing : {Eigen::Index{0}, (size + 2) / 3, size * 3 / 4, size}) {
      CholmodFactor factor;
      factor.analyse(lower_of(A), static_cast<int>(trailing));
      factor.factor(lower_of(A));
      const Eigen::MatrixXd found = factor.inverse_of_schur();
      ASSERT_EQ(found.rows(), trailing);
      EXPECT_LE(testing::distance(found, inverse.bottomRightCorner(trailing, trailing)), 1e-13)
          << size << " " << trailing;
      const Eigen::MatrixXd b = Eigen::MatrixXd::Random(size, 3);
      Eigen::MatrixXd x = b;
      factor.solve_in_place(x);
      EXPECT_LT(testing::residual(A, x, b), 1e-13 * b.norm());
      Eigen::MatrixXd indefinite = A;
      indefinite(size / 2, size / 2) = -4;
      EXPECT_THROW(factor.factor(lower_of(indefinite)), Breakdown);
    }
  }
}

}  // namespace
}  // namespace airybench::factors_test
