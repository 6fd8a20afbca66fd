#include "meshgen/model_options.hpp"

#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"

namespace airybench::model_options_test {
namespace {

using Texts = std::vector<std::string>;

TEST(ModelOptions, FromTheirTexts) {
  const ModelOptions options =
      model_options_of({"clamped=displacement", "a=b=force:top"}, {"h=0.25", "Size/n=-3e1"}, "0.5");
  EXPECT_EQ(options.roles, (std::map<std::string, std::string>{{"clamped", "displacement"},
                                                               {"a=b", "force:top"}}));
  EXPECT_EQ(options.parameters, (std::map<std::string, double>{{"h", 0.25}, {"Size/n", -30}}));
  EXPECT_EQ(options.longest_edge_mm, 0.5);
  EXPECT_FALSE(options.size_factor);
  EXPECT_EQ(model_options_of({}, {}, "50%").size_factor, 0.5);
  EXPECT_EQ(model_options_of({}, {}, "", "inch").length_unit_mm, 25.4);
}

TEST(ModelOptions, WhatIsWrongIsRefusedWithWhatIsAllowed) {
  const auto complaint = [](const Texts& roles, const Texts& parameters, const std::string& size) {
    return testing::complaint_of<std::invalid_argument>(
        [&] { model_options_of(roles, parameters, size); });
  };
  for (const std::string role : {"clamped", "=force", "clamped=fixed", "a=force:"})
    EXPECT_EQ(complaint({role}, {}, ""),
              "--role: " + role +
                  " (allowed: NAME=ROLE with displacement, force, contact, or one of these with a "
                  "name: force:top)");
  EXPECT_EQ(complaint({"a=force", "a=contact"}, {}, ""), "--role: a is given twice");
  for (const std::string parameter : {"h", "h=1mm", "h=nan"})
    EXPECT_EQ(complaint({}, {parameter}, ""),
              "--parameter: " + parameter + " (allowed: NAME=NUMBER)");
  for (const std::string size : {"0", "-1", "0%", "1e-9%", "fine", "%", "1e300", "nan"})
    EXPECT_EQ(complaint({}, {}, size),
              "--mesh-size: " + size +
                  " (allowed: the longest edge in mm, as 0.5, or a part of the model's sizes, as "
                  "50%, of 0.01% or more)");
}

TEST(ModelOptions, LimitsAreNumbersAboveZero) {
  const ModelLimits limits = model_limits_of("2.5", "");
  EXPECT_EQ(limits.time_s, 2.5);
  EXPECT_EQ(limits.memory_MiB, default_model_memory_MiB);
  EXPECT_EQ(testing::complaint_of<std::invalid_argument>([] { model_limits_of("0", ""); }),
            "--model-time: 0 (allowed: above 0, up to 1e+09)");
  EXPECT_EQ(testing::complaint_of<std::invalid_argument>([] { model_limits_of("", "4GiB"); }),
            "--model-memory: 4GiB (allowed: above 0, up to 1e+09)");
}

TEST(ModelOptions, OtherUnitsAreRefused) {
  EXPECT_EQ(
      testing::complaint_of<std::invalid_argument>([] { model_options_of({}, {}, "", "cm"); }),
      "--length-unit: cm (allowed: mm, m, inch)");
}

TEST(ModelOptions, OtherOptionsHaveAnotherText) {
  const std::vector<ModelOptions> all = {
      {},
      model_options_of({"a=force"}, {}, ""),
      model_options_of({"a=force:b"}, {}, ""),
      model_options_of({"b=force"}, {}, ""),
      model_options_of({}, {"a=1"}, ""),
      model_options_of({}, {"a=1.0000000000000002"}, ""),
      model_options_of({}, {}, "1"),
      model_options_of({}, {}, "100%"),
      model_options_of({}, {}, "", "m"),
      model_options_of({}, {}, "", "inch"),
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_NE(text_of(all[i]), text_of(all[k])) << i << " " << k;
  EXPECT_EQ(text_of(all.front()), "");
}

}  // namespace
}  // namespace airybench::model_options_test
