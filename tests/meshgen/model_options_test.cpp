#include "meshgen/model_options.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace airybench::model_options_test {
namespace {

using Texts = std::vector<std::string>;

std::string complaint(const Texts& roles, const Texts& parameters, const std::string& mesh_size) {
  try {
    model_options_of(roles, parameters, mesh_size);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(ModelOptions, FromTheirTexts) {
  const ModelOptions options =
      model_options_of({"clamped=displacement", "a=b=force:top"}, {"h=0.25", "Size/n=-3e1"}, "0.5");
  EXPECT_EQ(options.roles, (std::map<std::string, std::string>{{"clamped", "displacement"},
                                                               {"a=b", "force:top"}}));
  EXPECT_EQ(options.parameters, (std::map<std::string, double>{{"h", 0.25}, {"Size/n", -30}}));
  EXPECT_EQ(options.longest_edge_mm, 0.5);
  EXPECT_FALSE(options.size_factor);
  EXPECT_EQ(model_options_of({}, {}, "50%").size_factor, 0.5);
}

TEST(ModelOptions, WhatIsWrongIsRefusedWithWhatIsAllowed) {
  const std::string of_roles =
      " (allowed: NAME=ROLE with displacement, force, contact, or one of these with a name: "
      "force:top)";
  EXPECT_EQ(complaint({"clamped"}, {}, ""), "--role: clamped" + of_roles);
  EXPECT_EQ(complaint({"=force"}, {}, ""), "--role: =force" + of_roles);
  EXPECT_EQ(complaint({"clamped=fixed"}, {}, ""), "--role: clamped=fixed" + of_roles);
  EXPECT_EQ(complaint({"a=force:"}, {}, ""), "--role: a=force:" + of_roles);
  EXPECT_EQ(complaint({"a=force", "a=contact"}, {}, ""), "--role: a is given twice");
  EXPECT_EQ(complaint({}, {"h"}, ""), "--parameter: h (allowed: NAME=NUMBER)");
  EXPECT_EQ(complaint({}, {"h=1mm"}, ""), "--parameter: h=1mm (allowed: NAME=NUMBER)");
  EXPECT_EQ(complaint({}, {"h=nan"}, ""), "--parameter: h=nan (allowed: NAME=NUMBER)");
  for (const std::string size : {"0", "-1", "0%", "fine", "%", "1e300", "nan"})
    EXPECT_EQ(complaint({}, {}, size),
              "--mesh-size: " + size +
                  " (allowed: the longest edge in mm, as 0.5, or a part of the model's sizes, as "
                  "50%)");
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
  };
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_NE(text_of(all[i]), text_of(all[k])) << i << " " << k;
  EXPECT_EQ(text_of(all.front()), "");
}

}  // namespace
}  // namespace airybench::model_options_test
