#include "verify/total_error.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace airybench::total_error_test {
namespace {

// e² in two triangles, and ‖σ‖.
ConstitutiveError error_of(double first, double second, double norm) {
  ConstitutiveError error;
  error.of_triangle_Nmm = {first, second};
  error.body_Nmm = first + second;
  error.stress_norm = norm;
  error.relative = std::sqrt(error.squared_Nmm()) / norm;
  return error;
}

TEST(TotalError, IsTheLargestOfTheSteps) {
  TotalError total;
  total.add(error_of(3, 1, 100), "first: ");
  EXPECT_DOUBLE_EQ(total.relative().value(), 0.02);
  total.add(error_of(0.03, 0.01, 1), "second: ");
  EXPECT_DOUBLE_EQ(total.relative().value(), 0.2);
  EXPECT_DOUBLE_EQ(total.of_mesh(0).value(), 0.02);
  EXPECT_DOUBLE_EQ(total.parts()[0], 0.0003 + 0.03);
  EXPECT_DOUBLE_EQ(total.parts()[1], 0.0001 + 0.01);
}

TEST(TotalError, OfMeshAndMethodIsTheirSumInTheSameStep) {
  TotalError total;
  total.add(error_of(3, 1, 100), "first: ");
  total.add(error_of(0.03, 0.01, 1), "second: ");
  total.add(error_of(1e-22, 1e-22, 1e-11), "unloaded: ");
  total.set_method_errors({0.01, 0.001, 1});
  EXPECT_DOUBLE_EQ(total.relative().value(), 0.201);
  EXPECT_DOUBLE_EQ(total.of_mesh().value(), 0.2);
  total.set_method_errors({0.3});  // of a path that ended early
  EXPECT_DOUBLE_EQ(total.relative().value(), 0.32);
  EXPECT_EQ(total.largest_step(), 1);
}

TEST(TotalError, AnUnloadedStepHasNoneAndIsNotRefinedFor) {
  TotalError total;
  total.add(error_of(3, 1, 100), "");
  total.add(error_of(1e-22, 1e-22, 1e-11), "");
  EXPECT_TRUE(total.is_unloaded(1));
  EXPECT_FALSE(total.of_mesh(1));
  EXPECT_DOUBLE_EQ(total.relative().value(), 0.02);
  EXPECT_DOUBLE_EQ(total.parts()[0] + total.parts()[1], 0.0004);
}

TEST(TotalError, StepsBeforeTheFirstLoadedOneAreNotRefinedFor) {
  TotalError total;
  for (const double norm : {1e-11, 3e-11}) total.add(error_of(1e-23, 1e-22, norm), "");
  total.add(error_of(3, 1, 100), "");
  total.add(error_of(3, 1, 200), "");
  EXPECT_TRUE(total.is_unloaded(0));
  EXPECT_TRUE(total.is_unloaded(1));
  EXPECT_DOUBLE_EQ(total.parts()[0], 0.0003 + 0.000075);
  EXPECT_DOUBLE_EQ(total.parts()[1], 0.0001 + 0.000025);
}

TEST(TotalError, AFlawLeavesNoError) {
  TotalError total;
  total.add(error_of(3, 1, 100), "");
  ConstitutiveError flawed = error_of(3, 1, 100);
  flawed.flaw = "the contact forces pull";
  total.add(flawed, "load step 2 of 2: ");
  EXPECT_FALSE(total.relative());
  EXPECT_FALSE(total.of_mesh(1));
  EXPECT_EQ(total.flaw(), "load step 2 of 2: the contact forces pull");
}

TEST(TotalError, WithoutStressItIsZero) {
  TotalError total;
  ConstitutiveError none;
  none.of_triangle_Nmm = {0, 0};
  total.add(none, "");
  EXPECT_EQ(total.relative().value(), 0);
  EXPECT_FALSE(total.is_unloaded(0));
}

}  // namespace
}  // namespace airybench::total_error_test
