// Contact problems in Siconos' text format: all kinds of matrices, and wrong files.
#include "bench/problems/siconos_text.hpp"

#include <gtest/gtest.h>

#include "bench/problems/problem_files.hpp"
#include "support/errors.hpp"
#include "tests/support/bench_command.hpp"
#include "tests/support/complaint.hpp"

namespace airybench::siconos_text_test {
namespace {

// W of two contacts in the plane, three ways; its blocks are the diagonal ones and the upper right.
const std::string dense = "0\n4\n4\n4\t4\n2 0 0.5 0\n0 3 0 0\n0.5 0 4 0\n0 0 0 5.0e+00\n",
                  blocks =
                      "1\n4\n4\n4\n2\n2\n2\t4\n2\t4\n3\n4\n0\t2\t4\n0\t1\t0\t1\n"
                      "0\n2\n0\n0\n3\n1\n0.5\n0\n0\n0\n2\n0.5\n0\n0\n0\n3\n4\n0\n0\n5\n",
                  header = "2\n4\n4\n2\nCSparse Version 4.0.0, some date\n",
                  columns =
                      header +
                      "4-by-4, nzmax: 6 nnz: 6, 1-norm: 5\n    col 0 : locations 0 to 1\n"
                      "      0 : 2\n      2 : 0.5\n    col 1 : locations 2 to 2\n      1 : 3\n"
                      "    col 2 : locations 3 to 4\n      0 : 0.5\n      2 : 4\n"
                      "    col 3 : locations 5 to 5\n      3 : 5\n",
                  triplets = header +
                             "triplet: 4-by-4, nzmax: 6 nnz: 6\n    0 0 : 2\n    2 0 : 0.5\n"
                             "    1 1 : 3\n    0 2 : 0.5\n    2 2 : 4\n    3 3 : 5\n";
const std::string vectors = "-1 0.5 2 -0.25\n0.3 0\n";

// One contact in space: M has 4 rows, H = M's first columns by columns: u = Hᵀ M⁻¹ (H r + f) + w.
const std::string global =
    "3\n1\n0\n4\n4\n4 4\n2 0 0 0\n0 4 0 0\n0 0 5 0\n0 0 0 1\n"
    "0\n4\n3\n4 3\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
    "2 4 5 7\n-1 -2 -3\n0.4\n";

class SiconosText : public ::testing::Test {
 protected:
  contact::Problem read(const std::string& text) const {
    testing::write_text(bench_.path("p.dat"), text);
    return read_contact_problem(bench_.path("p.dat"));
  }
  const testing::BenchCommand bench_;
};

TEST_F(SiconosText, ReadsEveryKindOfMatrix) {
  Eigen::Matrix4d W = Eigen::Vector4d(2, 3, 4, 5).asDiagonal();
  W(0, 2) = W(2, 0) = 0.5;
  for (const std::string& matrix : {dense, blocks, columns, triplets}) {
    const contact::Problem problem = read("2\n2\n" + matrix + vectors);
    EXPECT_EQ(problem.D, Eigen::MatrixXd(W)) << matrix;
    EXPECT_EQ(problem.G, Eigen::VectorXd(Eigen::Vector4d(-1, 0.5, 2, -0.25)));
    EXPECT_EQ(problem.points.friction, (std::vector<double>{0.3, 0}));
    EXPECT_EQ(problem.points.components, 2);
    EXPECT_EQ(problem.name, "p");
    EXPECT_EQ(problem.how, "dense");
  }
}

TEST_F(SiconosText, ReadsGlobalProblems) {
  const contact::Problem problem = read(global);
  EXPECT_LT((problem.D - Eigen::MatrixXd(Eigen::Vector3d(0.5, 0.25, 0.2).asDiagonal())).norm(),
            1e-15);
  EXPECT_LT((problem.G - Eigen::Vector3d(0, -1, -2)).norm(), 1e-15);
  EXPECT_EQ(problem.how, "condensed, dense");
}

TEST_F(SiconosText, PassesOverAGuess) {
  for (const char* guess : {"0\n", "1\n1 2 3 4\n5 6 7 8\n"})
    EXPECT_EQ(read("2\n2\n" + dense + vectors + guess).D, read("2\n2\n" + dense + vectors).D);
  EXPECT_EQ(read(global + "1 1 2 3 4 5 6").points.count, 1);
}

// Damaged ones: Mutants.
TEST_F(SiconosText, WrongFilesAreRefusedWithTheirLineAndValue) {
  for (const auto& [text, beginning] : std::vector<std::pair<std::string, std::string>>{
           {"", "1: the file ends (allowed: "},
           {"4\n", "1: 4 (allowed: a whole number from 2 to 3)"},
           {"2\n0\n", "2: 0 (allowed: "},
           {"2\n2\n3\n", "3: 3 (allowed: a whole number from 0 to 2)"},
           {"2\n2\n0\n4\n4\n4 5\n", "6: 5 (allowed: 4)"},
           {"2\n2\n0\n4\n4\n4 4\n1 2\n", "7: the file ends before 16 numbers ("},
           {"2\n2\n" + dense + "1 2 x 4\n0.3 0\n", "11: x (allowed: a finite number)"},
           {"2\n2\n" + dense + "1 2 nan 4\n0.3 0\n", "11: nan (allowed: a finite number)"},
           {"2\n2\n" + dense + "1 2 3 4\n0.3 -1\n", " mu: [1] is -1 (allowed: "},
           {"2\n2\n" + dense + "1 2 3 4\n0.3\n", "13: the file ends (allowed: "},
           {"3\n2\n" + dense + vectors, " W: 4 x 4 (allowed: 6 x 6)"},
           {"2\n2\n" + dense + vectors + "1 0.5 x", "13: x (allowed: a finite number)"},
           {"2\n2\n1\n4\n4\n4\n2\n2\n2 5\n", "9: 5 (allowed: a whole number from 3 to 4)"},
           {"2\n2\n" + header + "4-by-5, nzmax: 6 nnz: 6\n", "8: 4-by-5, (allowed: 4-by-4,)"}}) {
    const auto what = testing::complaint_of<FileError>([&, &of = text] { read(of); });
    EXPECT_TRUE(what.starts_with(bench_.path("p.dat").string() + ":" + beginning)) << what;
    EXPECT_FALSE(testing::contains(what, "\n"));
  }
}

TEST_F(SiconosText, IsSolvedByTheCommandAndItsFaultsHaveCodes) {
  testing::write_text(bench_.path("good.dat"), "2\n2\n" + dense + vectors);
  bench_.expect_ok("--problem=good.dat --repetitions=1 --out=o");
  for (const Json& record : bench_.records()) {
    EXPECT_EQ(record["status"], "ok");
    EXPECT_EQ(record["contact_matrix"], "dense");
  }
  testing::write_text(bench_.path("bad.dat"), "2\n2\n9\n");
  bench_.expect_refusal("--problem=bad.dat", "bad.dat:3: 9 (allowed: ");
}

}  // namespace
}  // namespace airybench::siconos_text_test
