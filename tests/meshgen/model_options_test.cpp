#include "meshgen/model_options.hpp"

#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"

namespace airybench::model_options_test {
namespace {

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
  const auto expect_refused = [](const std::string& option, const std::string& wrong,
                                 const auto& action) {
    testing::expect_named(testing::complaint_of<std::invalid_argument>(action),
                          {"--" + option + ": " + wrong, "(allowed: "});
  };
  for (const std::string role : {"clamped", "=force", "clamped=fixed", "a=force:"})
    expect_refused("role", role, [&] { model_options_of({role}, {}, ""); });
  EXPECT_EQ(testing::complaint_of<std::invalid_argument>([] {
              model_options_of({"a=force", "a=contact"}, {}, "");
            }),
            "--role: a is given twice");
  for (const std::string parameter : {"h", "h=1mm", "h=nan"})
    expect_refused("parameter", parameter, [&] { model_options_of({}, {parameter}, ""); });
  for (const std::string size : {"0", "-1", "0%", "1e-9%", "fine", "%", "1e300", "nan"})
    expect_refused("mesh-size", size, [&] { model_options_of({}, {}, size); });
  expect_refused("length-unit", "cm", [] { model_options_of({}, {}, "", "cm"); });
  expect_refused("model-time", "0", [] { model_limits_of("0", ""); });
  expect_refused("model-memory", "4GiB", [] { model_limits_of("", "4GiB"); });
  EXPECT_EQ(model_limits_of("2.5", "").time_s, 2.5);
  EXPECT_EQ(model_limits_of("2.5", "").memory_MiB, default_model_memory_MiB);
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
