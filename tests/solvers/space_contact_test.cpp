// The contact law with two tangential components: at one point, and for W of rigid and of elastic
// bodies whose answer is known.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <map>
#include <random>

#include "solvers/base/solution.hpp"
#include "solvers/condensation/global_problem.hpp"
#include "solvers/contact/condensed.hpp"
#include "solvers/contact/coulomb_law.hpp"
#include "tests/support/dense_algebra.hpp"

namespace airybench::space_contact_test {
namespace {

// The largest violation of the law's clauses by F and r, each relative to force and motion.
double violation(const Eigen::Vector3d& F, const Eigen::Vector3d& r, double mu, double force,
                 double motion) {
  const Eigen::Vector2d F_t = F.tail<2>() / force, r_t = r.tail<2>() / motion;
  const double F_n = F(0) / force, r_n = r(0) / motion, room = -mu * F_n - F_t.norm();
  const double crossed = std::abs(F_t.x() * r_t.y() - F_t.y() * r_t.x());
  return std::max(
      {F_n, r_n, std::min(-F_n, -r_n), -room, std::min(room, r_t.norm()), F_t.dot(r_t), crossed});
}

enum class Law { open, stick, slip };

Law law_of(const Eigen::Vector3d& F, const Eigen::Vector3d& r) {
  return F.isZero(0) ? Law::open : r.norm() < 1e-10 ? Law::stick : Law::slip;
}

TEST(CoulombLawInSpace, IsMetByRandomPoints) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::map<Law, int> seen;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Matrix3d root = Eigen::Matrix3d::NullaryExpr([&] { return uniform(generator); });
    const Eigen::Matrix3d D = root * root.transpose() + 0.05 * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d b = Eigen::Vector3d::NullaryExpr([&] { return uniform(generator); });
    const double mu = std::abs(uniform(generator));
    const Eigen::Vector3d F = solve_coulomb_law(D, b, mu), r = D * F + b;
    ASSERT_LT(violation(F, r, mu, std::max(F.norm(), 1e-3), b.norm()), 1e-9) << D << "\n" << b;
    ++seen[law_of(F, r)];
  }
  for (const Law law : {Law::open, Law::stick, Law::slip}) EXPECT_GT(seen[law], 500);
}

// A point that tangential forces cannot move along s, or not at all.
TEST(CoulombLawInSpace, IsMetWhereTheComplianceIsSingular) {
  Eigen::Matrix3d D = Eigen::Vector3d(2, 1, 0).asDiagonal();
  for (const double b_s : {0.0, 0.4}) {
    const Eigen::Vector3d b(1, 0.1, b_s), F = solve_coulomb_law(D, b, 0.3), r = D * F + b;
    EXPECT_LT(violation(F, r, 0.3, 0.5, 1), 1e-9) << b_s;
  }
  D(1, 1) = 0;
  const Eigen::Vector3d b(1, 0.3, 0.4), F = solve_coulomb_law(D, b, 0.3);
  EXPECT_LT(violation(F, D * F + b, 0.3, 0.5, 1), 1e-9);
}

TEST(CoulombLawInSpace, WithoutMotionAcrossIsThatOfThePlane) {
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  D.topLeftCorner<2, 2>() << 2, 0.4, 0.4, 1;
  for (const double b_n : {-1.0, 1.0})
    for (const double b_t : {-2.0, -0.1, 0.1, 2.0}) {
      const Eigen::Vector2d plane =
          solve_coulomb_law(Eigen::Matrix2d(D.topLeftCorner<2, 2>()), {b_n, b_t}, 0.3);
      const Eigen::Vector3d space = solve_coulomb_law(D, Eigen::Vector3d(b_n, b_t, 0), 0.3);
      EXPECT_LT((space.head<2>() - plane).norm() + std::abs(space(2)), 1e-13);
    }
}

struct Planted {
  contact::Problem problem;
  Eigen::VectorXd F;  // an answer; of several where W is singular
};

// Contacts of rigid bodies: W = Hᵀ M⁻¹ H with H from random frames, points and pairs of bodies;
// rank at most 6 · bodies. Forces and velocities of every status are chosen, then q.
Planted rigid_bodies(int contacts, int bodies, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> body(0, bodies - 1), status(0, 2);
  const auto vector = [&] {
    return Eigen::Vector3d(Eigen::Vector3d::NullaryExpr([&] { return uniform(generator); }));
  };
  const int m = 3 * contacts;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6 * bodies, m);
  Eigen::VectorXd r(m), u(m);
  Planted planted;
  ContactPoints& points = planted.problem.points;
  points.count = contacts;
  points.components = 3;
  for (int p = 0; p < contacts; ++p) {
    const int first = body(generator), other = (first + 1) % bodies;
    const Eigen::Matrix3d frame =
        Eigen::Quaterniond(Eigen::Vector4d(vector().homogeneous())).normalized().toRotationMatrix();
    for (const auto& [which, sign] : {std::pair(first, 1.0), std::pair(other, -1.0)}) {
      H.block<3, 3>(6 * which, 3 * p) += sign * frame;
      const Eigen::Vector3d arm = vector();
      for (int k = 0; k < 3; ++k)
        H.block<3, 1>(6 * which + 3, 3 * p + k) += sign * arm.cross(frame.col(k));
    }
    const double mu = 0.2 + 0.3 * std::abs(uniform(generator));
    points.friction.push_back(mu);
    const Eigen::Vector2d direction = vector().head<2>().normalized();
    r.segment<3>(3 * p).setZero();
    u.segment<3>(3 * p).setZero();
    switch (static_cast<Law>(status(generator))) {
      case Law::open:
        u.segment<3>(3 * p) << 0.1 + std::abs(uniform(generator)), vector().head<2>();
        break;
      case Law::stick:
        r.segment<3>(3 * p) << 1, 0.7 * mu * direction;
        break;
      case Law::slip:
        r.segment<3>(3 * p) << 1, mu * direction;
        u.segment<2>(3 * p + 1) = -(0.1 + std::abs(uniform(generator))) * direction;
        break;
    }
  }
  planted.problem.D = H.transpose() * H;
  planted.problem.G = u - planted.problem.D * r;
  planted.F = -r;
  return planted;
}

TEST(ContactInSpace, TheNaturalMapOfAPlantedAnswerVanishes) {
  const Planted planted = rigid_bodies(20, 8, 1);
  EXPECT_LT(relative_natural_map(planted.problem, planted.F), 1e-13);
  Eigen::VectorXd off = planted.F;
  for (int p = 0; p < 20; ++p) {  // turned about the normal
    const Eigen::Vector2d t = off.segment<2>(3 * p + 1);
    off.segment<2>(3 * p + 1) << 0.8 * t.x() - 0.6 * t.y(), 0.6 * t.x() + 0.8 * t.y();
  }
  EXPECT_GT(relative_natural_map(planted.problem, off), 1e-2);
}

double worst_violation(const contact::Problem& problem, const Eigen::VectorXd& F) {
  const Eigen::VectorXd r = problem.D * F - problem.G;
  double worst = 0;
  for (int p = 0; p < problem.points.count; ++p)
    worst = std::max(worst, violation(F.segment<3>(3 * p), r.segment<3>(3 * p),
                                      problem.points.friction_at(p), 1, 1));
  return worst;
}

// W of full rank, of nearly full rank, and with a third more rows than that: what a solver calls
// converged meets the law, and Newton's method solves most.
TEST(ContactInSpace, WhatConvergesMeetsTheLaw) {
  std::map<ContactSolver, int> solved;
  int problems = 0;
  for (const int bodies : {25, 10, 7})
    for (unsigned seed = 1; seed <= 6; ++seed, ++problems) {
      const contact::Problem problem = rigid_bodies(20, bodies, seed).problem;
      for (const ContactSolver solver : all_contact_solvers) {
        SCOPED_TRACE(std::string(name_of(solver)) + ", bodies: " + std::to_string(bodies) +
                     ", seed: " + std::to_string(seed));
        ContactOptions options;
        options.solver = solver;
        options.max_iterations = 3000;
        const ContactResult result = solve_contact(problem, options);
        if (!result.converged) continue;
        ++solved[solver];
        EXPECT_LT(worst_violation(problem, result.F_C), 1e-8);
      }
    }
  std::cout << "solved of " << problems << ":";
  for (const auto& [solver, count] : solved) std::cout << " " << name_of(solver) << " " << count;
  std::cout << "\n";
  EXPECT_GE(solved[ContactSolver::newton], problems - 2);
  EXPECT_GE(solved[ContactSolver::admm], problems / 2);
}

// As some programs write it.
TEST(ContactInSpace, TheSkewPartOfWCounts) {
  contact::Problem problem = rigid_bodies(20, 25, 2).problem;
  std::srand(7);
  const Eigen::MatrixXd noise = Eigen::MatrixXd::Random(60, 60);
  problem.D += 1e-3 * (noise - noise.transpose());
  problem.is_symmetric = false;
  for (const ContactSolver solver : all_contact_solvers) {
    SCOPED_TRACE(name_of(solver));
    ContactOptions options;
    options.solver = solver;
    const ContactResult result = solve_contact(problem, options);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(worst_violation(problem, result.F_C), 1e-8);
  }
}

TEST(GlobalProblem, IsCondensedToForcesAlone) {
  std::srand(5);
  const Eigen::MatrixXd root = Eigen::MatrixXd::Random(12, 12), H = Eigen::MatrixXd::Random(12, 6);
  const Eigen::MatrixXd M = root * root.transpose() + Eigen::MatrixXd::Identity(12, 12);
  const Eigen::VectorXd f = Eigen::VectorXd::Random(12), w = Eigen::VectorXd::Random(6),
                        r = Eigen::VectorXd::Random(6);
  const contact::Problem problem = condense_global(M.sparseView(), H.sparseView(), f, w);
  const Eigen::VectorXd v = M.ldlt().solve(H * r + f);
  EXPECT_LT((problem.D * r + problem.G - (H.transpose() * v + w)).norm(), 1e-12);
  EXPECT_THROW(condense_global((-M).eval().sparseView(), H.sparseView(), f, w), Breakdown);
}

}  // namespace
}  // namespace airybench::space_contact_test
