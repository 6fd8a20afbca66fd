// How methods describe themselves, are selected, and what status their outcomes become.
#include <gtest/gtest.h>

#include <set>

#include "solvers/direct/skyline.hpp"
#include "solvers/preconditioners/preconditioner.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/posed.hpp"
#include "tests/support/solved.hpp"

namespace airybench::method_table_test {
namespace {

// Entries and flops of the factor or preconditioner; none where there is none.
TEST(WorkCounts, AreThoseOfTheFactor) {
  const AirySystem system = testing::system_of();
  const auto counted = [&](const char* name) { return testing::solved_by(name, system); };
  const SkylineProfile profile = analyse_skyline(system.S);
  for (const char* name : {"3STEPD", "3STEPCG:SKY"}) {
    EXPECT_EQ(counted(name).factor_entries, profile.profile) << name;
    EXPECT_EQ(counted(name).factor_flops, profile.factor_flops) << name;
  }
  EXPECT_EQ(counted("3STEPCG:DTIC3").factor_flops, profile.factor_flops);  // then dropped
  EXPECT_LT(counted("3STEPCG:DTIC3").factor_entries, profile.profile);
  EXPECT_LT(counted("3STEPCG:FLIC1").factor_flops, counted("3STEPCG:FLIC3").factor_flops);
  for (const char* name :
       {"3STEPD:CHOLMOD", "HYBRID", "HYBRID:CHOLMOD", "HYBRID:MUMPS", "P2", "BLIND"}) {
    const Solution solution = counted(name);
    EXPECT_GT(solution.factor_flops.value(), static_cast<double>(*solution.factor_entries)) << name;
  }
  EXPECT_FALSE(counted("3STEPCG:NONE").factor_entries);
  EXPECT_FALSE(counted("3STEPCG:SSOR1.0").factor_flops);
}

TEST(StageObservers, OfAllScopesAreToldInsideOut) {
  struct Noting : StageObserver {
    Noting(std::string name, std::string& seen) : name_(std::move(name)), seen_(seen) {}
    void begins(Stage) override { seen_ += name_ + "("; }
    void ends(Stage) override { seen_ += name_ + ")"; }
    std::string name_;
    std::string& seen_;
  };
  std::string seen;
  Noting outer("o", seen), inner("i", seen);
  StageTimes times;
  const ObservedStages observed(&outer);
  {
    const ObservedStages too(&inner);
    const StageTimer timer(times, Stage::factor);
  }
  const StageTimer timer(times, Stage::check);
  EXPECT_EQ(seen, "i(o(i)o)o(");
}

TEST(Methods, SelectionByNamesAndGlobs) {
  EXPECT_EQ(select_methods("3STEPD").size(), 1u);
  std::set<std::string> identities;
  for (const Method& method : methods()) identities.insert(method.identity());
  EXPECT_EQ(select_methods("*").size(), identities.size());
  EXPECT_EQ(select_methods("HYBRID,3STEPD").front().name, "3STEPD");  // in the table's order
  EXPECT_EQ(select_methods("3STEPD,3STEP*,3STEPD").size(), select_methods("3STEP*").size());
  std::string valid;
  for (const Method& method : methods())
    if (method.preconditioner.empty() || !is_general_name(method.name)) valid += method.name + ", ";
  testing::expect_named(
      testing::complaint_of<std::invalid_argument>([] { select_methods("3STEPD,4STEP"); }),
      {"'4STEP', perhaps 3STEPD (valid: " + valid, "SYMMLQ:<preconditioner>", "HYBRID:k=<degree>"});
  EXPECT_THROW(select_methods(""), std::invalid_argument);
}

// What records and figures group methods by.
TEST(Methods, EachSaysItsFamilyAndItsPreconditioner) {
  const std::set<std::string> iterative = {"3STEPCG", "ALM", "HYBRID:CG", "SYMMLQ"};
  const std::vector<std::string>& known = preconditioner_names();
  std::set<std::string> families;
  for (const Method& method : methods()) {
    families.insert(method.family);
    EXPECT_EQ(method.is_iterative(), iterative.contains(method.family)) << method.name;
    EXPECT_TRUE(method.identity().starts_with(method.family)) << method.name;
    const bool has_one = method.family == "3STEPCG" || method.family == "SYMMLQ";
    EXPECT_EQ(std::count(known.begin(), known.end(), method.preconditioner), has_one)
        << method.name << ": " << method.preconditioner;
    if (has_one) {
      EXPECT_EQ(method.identity(), method.family + ":" + method.preconditioner);
    }
    EXPECT_EQ(std::count(method.stages.begin(), method.stages.end(), Stage::precondition),
              has_one || method.family == "HYBRID:CG" || method.name == "HYBRID:PDAS")
        << method.name;
  }
  EXPECT_EQ(families, (std::set<std::string>{"3STEPCG", "3STEPD", "ALM", "BLIND", "HYBRID",
                                             "HYBRID:CG", "P2", "P3", "P4", "SYMMLQ"}));
}

TEST(Methods, APreconditionerHasOneSpelling) {
  for (const auto& [name, spelling] : {std::pair{"SYMMLQ:SSOR1", "SSOR1.0"},
                                       {"SYMMLQ:SSOR1.00,refine=yes", "SSOR1.0"},
                                       {"3STEPCG:SSOR.7,refine=yes", "SSOR0.7"},
                                       {"3STEPCG:DTIC3.0", "DTIC3"},
                                       {"SSKY", "SKY"}})
    EXPECT_EQ(select_methods(name).front().preconditioner, spelling) << name;
}

TEST(Methods, TooFewIterationsAreNotConvergedWithTheirNumber) {
  RunControl control;
  control.max_iterations = 3;
  for (const char* method : {"ALM:AUTO", "3STEPCG:DTIC4", "SYMMLQ:DTIC6"}) {
    const Solution solution = testing::solved_by(method, testing::system_of(), control);
    EXPECT_EQ(solution.status, Status::not_converged) << method;
    EXPECT_NE(solution.message.find("after 3 iterations"), std::string::npos) << solution.message;
  }
}

TEST(Methods, WhateverAMethodDoesBecomesAStatus) {
  const ContactSystem system = contact_system(testing::posed({}));
  const auto status = [&](const Solve& solve) { return run(solve, system, {}).status; };
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw std::bad_alloc(); }),
            Status::out_of_memory);
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw Breakdown("x"); }), Status::breakdown);
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw TimeoutReached("x"); }), Status::timeout);
  EXPECT_EQ(status([](auto&, auto&) -> Solution { throw std::logic_error("x"); }), Status::crashed);
  EXPECT_EQ(status([](auto&, auto&) { return Solution{}; }), Status::crashed);
  const auto claim_success = [](auto change) {
    return [=](const ContactSystem& s, const RunControl&) {
      Solution solution;
      solution.status = Status::ok;
      solution.F_C = Eigen::VectorXd::Zero(s.contact.size());
      solution.stress = StressField(s.problem->mesh.triangles.size());
      solution.stress.values().setZero();
      change(solution);
      return solution;
    };
  };
  EXPECT_EQ(status(claim_success([](Solution&) {})), Status::ok);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.F_C(1) = std::nan(""); })), Status::breakdown);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.stress.values()(1, 29) = INFINITY; })),
            Status::breakdown);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.stress = {}; })), Status::breakdown);
  EXPECT_EQ(status(claim_success([](Solution& s) { s.F_C.resize(1); })), Status::breakdown);
}

}  // namespace
}  // namespace airybench::method_table_test
