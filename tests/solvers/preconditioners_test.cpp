#include "solvers/preconditioners/preconditioner.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "solvers/direct/skyline.hpp"
#include "solvers/preconditioners/drop_tolerance.hpp"
#include "solvers/preconditioners/fill_level.hpp"
#include "solvers/preconditioners/ssor.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/dense_operators.hpp"
#include "tests/support/method_names.hpp"
#include "tests/support/posed.hpp"

namespace airybench::preconditioners_test {
namespace {

using namespace testing;

Eigen::MatrixXd whole(const SparseColumns& lower) {
  return Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
}

// S of a small tooth.
const SparseColumns& tooth() {
  static const SparseColumns S = system_of().S;
  return S;
}

// A sparse random positive definite matrix with unit diagonal and little condition.
SparseColumns random_sparse(int n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = std::max(0, i - 30); j < i; ++j)
      if (uniform(generator) > 0.8) A(i, j) = A(j, i) = 0.15 * uniform(generator);
  return lower_of(A);
}

Eigen::MatrixXd dense(const IncompleteFactor& factor) {
  const auto n = static_cast<Eigen::Index>(factor.inverse_diagonal.size());
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(n, n);
  for (const FactorRows& part : factor.parts)
    for (std::size_t k = 0; k + 1 < part.start.size(); ++k)
      for (int e = part.start[k]; e < part.start[k + 1]; ++e)
        L(part.first + static_cast<int>(k), part.column[e]) = part.value[e];
  for (Eigen::Index i = 0; i < n; ++i) L(i, i) = 1 / factor.inverse_diagonal[i];
  return L;
}

Eigen::MatrixXd cholesky(const SparseColumns& lower) { return cholesky_factor(whole(lower)); }

Eigen::MatrixXd pattern(const Eigen::MatrixXd& L) {
  return (L.array() != 0).cast<double>().matrix();
}

// M⁻¹ as a matrix, from unit vectors.
Eigen::MatrixXd matrix_of(const Preconditioner& preconditioner, Eigen::Index n, int lanes) {
  const Apply apply = preconditioner.applier(lanes);
  Eigen::MatrixXd result(n, n);
  LaneBlock X(n, lanes);
  for (Eigen::Index first = 0; first < n; first += lanes) {
    const Eigen::Index columns = std::min<Eigen::Index>(lanes, n - first);
    X.setZero();
    for (Eigen::Index l = 0; l < columns; ++l) X(first + l, l) = 1;
    apply(X);
    result.middleCols(first, columns) = X.leftCols(columns);
  }
  return result;
}

TEST(LdltRows, AreThoseOfTheDenseFactorisation) {
  for (const SparseColumns& S : {random_sparse(150, 1), random_sparse(1, 2), tooth()}) {
    const Eigen::MatrixXd L = cholesky(S);
    const Eigen::VectorXd pivots = L.diagonal().array().square();
    int next = 0;
    visit_ldlt_rows(S, [&](int i, int j, const double* l, const double* d) {
      EXPECT_EQ(i, next++);
      EXPECT_TRUE(L.row(i).head(j).isZero(0)) << i;
      for (int k = j; k < i; ++k) EXPECT_NEAR(l[k - j], L(i, k) / L(k, k), 1e-9) << i << " " << k;
      for (int k = j; k <= i; ++k) EXPECT_NEAR(d[k - j], pivots(k), 1e-9 * pivots(k));
    });
    EXPECT_EQ(next, S.rows());
  }
}

TEST(DropTolerance, DroppingNothingIsTheCholeskyFactor) {
  for (const int n : {1, 2, 40, 255, 256, 257, 600}) {
    const SparseColumns S = random_sparse(n, 3);
    const IncompleteFactor factor = drop_tolerance_factor(S, 0);
    const Eigen::MatrixXd L = cholesky(S);
    EXPECT_LT(distance(dense(factor), L), 1e-12 * L.norm()) << n;
  }
}

TEST(DropTolerance, IsTheThresholdedCholeskyFactor) {
  const Eigen::MatrixXd L = cholesky(tooth());
  std::size_t before = std::numeric_limits<std::size_t>::max();
  for (int x = 6; x >= 1; --x) {
    const double tolerance = std::pow(10.0, -x);
    const IncompleteFactor factor = drop_tolerance_factor(tooth(), tolerance);
    Eigen::MatrixXd kept = (L.array().abs() >= tolerance).select(L, 0);
    kept.diagonal() = L.diagonal();
    const Eigen::MatrixXd made = dense(factor);
    EXPECT_EQ(pattern(made), pattern(kept)) << x;
    EXPECT_LT(distance(made, kept), 1e-9 * L.norm()) << x;
    EXPECT_EQ(factor.entries(), static_cast<std::size_t>(pattern(kept).sum()));
    EXPECT_LT(factor.entries(), before) << x;
    before = factor.entries();
    if (x == 6) {
      EXPECT_LT(distance(made, L), 1e-4 * L.norm());
    }
  }
}

// Levels of fill by their definition.
Eigen::MatrixXi levels(const SparseColumns& lower) {
  constexpr int absent = 1 << 20;
  const Eigen::MatrixXd S = whole(lower);
  const Eigen::Index n = S.rows();
  Eigen::MatrixXi level = (S.array() != 0).select(Eigen::MatrixXi::Zero(n, n), absent);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index j = k + 1; j < n; ++j)
      if (level(k, j) < absent)
        for (Eigen::Index i = k + 1; i < n; ++i)
          level(i, j) = std::min(level(i, j), level(i, k) + level(k, j) + 1);
  return level.triangularView<Eigen::Lower>();
}

TEST(FillLevel, HasThePatternOfItsDefinition) {
  for (const SparseColumns& S : {random_sparse(80, 4), tooth()}) {
    const Eigen::MatrixXi level = levels(S);
    for (const int most : {0, 1, 2, 3, 5}) {
      const FillLevelFactor made = fill_level_factor(S, most);
      Eigen::Index expected = 0;
      const FactorRows& L = made.factor.parts.front();
      for (Eigen::Index i = 0; i < S.rows(); ++i) {
        std::vector<int> columns;
        for (int j = 0; j < i; ++j)
          if (level(i, j) <= most) columns.push_back(j);
        EXPECT_EQ(columns, std::vector<int>(L.column.begin() + L.start[i],
                                            L.column.begin() + L.start[i + 1]))
            << "level " << most << ", row " << i;
        expected += static_cast<Eigen::Index>(columns.size()) + 1;
      }
      EXPECT_EQ(made.factor.entries(), static_cast<std::size_t>(expected));
    }
  }
}

// The norm of L Lᵀ − S on the pattern of L, S with the shift that was needed.
double error_on_pattern(const FillLevelFactor& made, const SparseColumns& S) {
  const Eigen::MatrixXd L = dense(made.factor);
  Eigen::MatrixXd shifted = whole(S);
  shifted.diagonal() *= 1 + made.shift;
  return (L * L.transpose() - shifted).cwiseProduct(pattern(L)).norm() / shifted.norm();
}

// All levels: the Cholesky factor.
TEST(FillLevel, EqualsTheMatrixOnItsPattern) {
  for (const SparseColumns& S :
       {random_sparse(1, 6), random_sparse(2, 6), random_sparse(80, 6), tooth()})
    for (const int level : {0, 1, 2, 5, static_cast<int>(S.rows())}) {
      const FillLevelFactor made = fill_level_factor(S, level);
      EXPECT_LT(error_on_pattern(made, S), 1e-13) << level;
      if (level < S.rows()) continue;
      EXPECT_EQ(made.shift, 0);
      EXPECT_LT(distance(dense(made.factor), cholesky(S)), 1e-12 * cholesky(S).norm());
    }
}

// Kershaw's matrix (1978): positive definite, its fourth pivot without fill is −5.
SparseColumns kershaw() {
  Eigen::Matrix4d S;
  S << 3, -2, 0, 2, -2, 3, -2, 0, 0, -2, 3, -2, 2, 0, -2, 3;
  return lower_of(S / 3);
}

TEST(FillLevel, ABreakdownIsMendedByAShiftThatIsReported) {
  const FillLevelFactor made = fill_level_factor(kershaw(), 0);
  EXPECT_GT(made.shift, 0);
  EXPECT_EQ(fill_level_preconditioner(kershaw(), 0).shift, made.shift);
  EXPECT_GT(dense(made.factor).diagonal().minCoeff(), 0);
  EXPECT_LT(error_on_pattern(made, kershaw()), 3e-15);
  // The shift before would not have been enough.
  Eigen::MatrixXd half = whole(kershaw());
  half.diagonal() *= 1 + made.shift / 2;
  EXPECT_GT(fill_level_factor(lower_of(half), 0).shift, 0);
  EXPECT_EQ(fill_level_factor(kershaw(), 1).shift, 0);  // the fill that was missing
}

TEST(FillLevel, NoShiftUpToOneIsABreakdownThatNamesTheLevel) {
  Eigen::Matrix2d S;
  S << 1, 5, 5, 1;
  EXPECT_TRUE(complaint_of<Breakdown>([&] {
                fill_level_factor(lower_of(S), 2);
              }).starts_with("FLIC2: a pivot is not positive"));
  S << 1, 0.5, 0.5, std::nan("");
  EXPECT_THROW(fill_level_factor(lower_of(S), 2), Breakdown);
}

TEST(Ssor, IsTheInverseOfItsFormula) {
  for (const SparseColumns& S : {random_sparse(60, 7), tooth()})
    for (const double omega : {0.1, 0.5, 1.0, 1.7, 1.99}) {
      // Another diagonal than the unit one, which would hide where D stands.
      const Eigen::VectorXd scale = Eigen::VectorXd::LinSpaced(S.rows(), 0.5, 3);
      const Eigen::MatrixXd A = scale.asDiagonal() * whole(S) * scale.asDiagonal();
      const SparseColumns lower = lower_of(A);
      Eigen::MatrixXd DL = omega * Eigen::MatrixXd(A.triangularView<Eigen::StrictlyLower>());
      DL.diagonal() = A.diagonal();
      const Eigen::MatrixXd M =
          DL * A.diagonal().cwiseInverse().asDiagonal() * DL.transpose() / (omega * (2 - omega));
      const Preconditioner made = ssor_preconditioner(lower, omega);
      for (const int lanes : {1, max_lanes}) {
        const Eigen::MatrixXd product = M * matrix_of(made, A.rows(), lanes);
        EXPECT_LT(distance(product, Eigen::MatrixXd::Identity(A.rows(), A.rows())), 1e-9) << omega;
      }
    }
}

class EveryPreconditioner : public ::testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Names, EveryPreconditioner, ::testing::ValuesIn(preconditioner_names()),
                         [](const auto& name) { return readable_name(name.param); });

TEST_P(EveryPreconditioner, IsSymmetricPositiveDefiniteAndTheSameOnAnyNumberOfLanes) {
  for (const SparseColumns& S : {random_sparse(sanitized ? 100 : 300, 8), tooth()}) {
    const Preconditioner made = preconditioner_named(GetParam())(S, {});
    const Eigen::MatrixXd inverse = matrix_of(made, S.rows(), 1);
    EXPECT_LT(distance(inverse, inverse.transpose()), 1e-12 * inverse.norm());
    EXPECT_GT(eigenvalues(inverse)(0), 0);
    EXPECT_LT(distance(inverse, matrix_of(made, S.rows(), max_lanes)), 1e-13 * inverse.norm());
  }
}

TEST_P(EveryPreconditioner, LeavesTheCallersMatrixAndItsOwnFactorAlone) {
  const SparseColumns S = random_sparse(100, 9);
  const Preconditioner made = preconditioner_named(GetParam())(S, {});
  EXPECT_EQ(whole(S), whole(random_sparse(100, 9)));
  const Apply one = made.applier(1), other = made.applier(max_lanes);
  LaneBlock x = LaneBlock::Ones(100, 1), y = LaneBlock::Ones(100, max_lanes), z = x;
  one(x);
  other(y);
  one(z);
  EXPECT_EQ(x, z);
}

TEST_P(EveryPreconditioner, OutOfTimeIsATimeoutWhereThereIsWorkToDo) {
  const auto make = [](const Deadline& deadline) {
    return preconditioner_named(GetParam())(tooth(), deadline);
  };
  if (make({}).flops) {
    EXPECT_THROW(make(Deadline::after(-1)), TimeoutReached);
  } else {
    EXPECT_NO_THROW(make(Deadline::after(-1)));
  }
}

TEST(Preconditioners, SkyIsTheInverseAndNoneTheIdentity) {
  const Eigen::Index n = 300;
  const SparseColumns S = random_sparse(n, 10);
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  EXPECT_LT(residual(whole(S), matrix_of(preconditioner_named("SKY")(S, {}), n, max_lanes), I),
            1e-12);
  EXPECT_EQ(matrix_of(preconditioner_named("NONE")(S, {}), n, max_lanes), I);
}

TEST(Preconditioners, ADiagonalThatIsNotPositiveIsABreakdown) {
  for (const char* name : {"DTIC3", "SSOR1.0", "SKY"})
    for (const double value : {0.0, -1.0, std::nan("")}) {
      SparseColumns S = tooth();
      S.coeffRef(10, 10) = value;
      EXPECT_THROW(preconditioner_named(name)(S, {}), Breakdown) << name << " " << value;
    }
}

TEST(Preconditioners, MoreOfTheFactorIsABetterPreconditioner) {
  const Eigen::MatrixXd S = whole(tooth());
  const auto condition = [&](const char* name) {
    const Eigen::MatrixXd L = cholesky(tooth());
    const Eigen::MatrixXd inverse =
        matrix_of(preconditioner_named(name)(tooth(), {}), S.rows(), max_lanes);
    const Eigen::MatrixXd similar = L.transpose() * inverse * L;
    const Eigen::VectorXd values = eigenvalues(similar);
    return values(values.size() - 1) / values(0);
  };
  const std::vector<const char*> better = {"SKY", "DTIC6", "DTIC4", "DTIC3", "NONE"};
  for (std::size_t k = 1; k < better.size(); ++k)
    EXPECT_LT(condition(better[k - 1]), condition(better[k])) << better[k];
  EXPECT_LT(condition("FLIC5"), condition("FLIC1"));
  EXPECT_LT(condition("SSOR1.0"), condition("NONE"));
}

TEST(Preconditioners, AWrongNameIsOneLineWithTheValidOnes) {
  for (const char* name :
       {"DTIC7",  "DTIC2",  "DTIC3.5", "DTIC",    "DTIC-3",  "DTICinf", "DTICnan",
        "FLIC0",  "FLIC6",  "FLIC1.5", "SSOR",    "SSOR0",   "SSOR0.0", "SSOR2",
        "SSOR-1", "SSOR1x", "SSOR 1",  "SSORnan", "SSORinf", "SSOR1,5", "sky",
        "SKY ",   "none",   "",        "ILU"})
    expect_named(complaint_of<std::invalid_argument>([&] { preconditioner_named(name); }),
                 {"'" + std::string(name) + "'", "DTIC3..DTIC6, FLIC1..FLIC5, SSOR", "SKY, NONE"});
}

}  // namespace
}  // namespace airybench::preconditioners_test
