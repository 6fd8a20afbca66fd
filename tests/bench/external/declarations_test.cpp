// Declarations of other people's programs that are refused, each in a line.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/bench/external/programs.hpp"

namespace airybench::declarations_test {
namespace {

using ExternalDeclarations = testing::ExternalPrograms;

TEST_F(ExternalDeclarations, WrongOnesAreRefused) {
  const Json right = declaration("one", "condensed", {"true", "{output}"});
  const auto refused = [&](const std::string& text, const std::string& line) {
    SCOPED_TRACE(line);
    write("one.json", text);
    const auto result = bench_.run("--external=one.json --method='EXTERNAL:*' --mesh=Mesh0");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err.rfind("bench: one.json: " + line, 0), 0u) << result.err;
    EXPECT_EQ(std::ranges::count(result.err, '\n'), 1) << result.err;
  };
  const auto with = [&](const Json& change) {  // null: without
    Json json = right;
    json.merge_patch(change);
    return json.dump();
  };
  refused("", "not JSON: parse error");
  refused("[1]", "the file: [1] (allowed: a JSON object)");
  refused(std::string(100'000, '['), "nested more than 8 deep");
  refused(with({{"colour", 1}}), "colour: unknown key (allowed: name, summary, reads, ");
  refused(with({{"name", nullptr}}), "name: is missing (allowed: a text)");
  refused(with({{"name", ""}}), "name: \"\" (allowed: a text)");
  refused(with({{"name", "a,b"}}), "name: \"a,b\" (allowed: letters, digits, '-', '_' and '.')");
  refused(with({{"name", "../a"}}), "name: \"../a\" (allowed: letters");
  refused(with({{"summary", 3}}), "summary: 3 (allowed: a text)");
  refused(with({{"reads", nullptr}}), "reads: is missing (allowed: airy, body, condensed)");
  refused(with({{"reads", "mind"}}), "reads: \"mind\" (allowed: airy, body, condensed)");
  refused(with({{"returns", "airy_function"}}),
          "returns: \"airy_function\" (allowed: contact_forces, as it reads condensed)");
  refused(with({{"format", "xml"}}), "format: \"xml\" (allowed: matrix-market");
  refused(with({{"reads", "airy"}, {"returns", "airy_function"}, {"format", "fclib"}}),
          "format: \"fclib\" (allowed: matrix-market");
  for (const Json& components : {Json(2), Json::array(), Json::array({2, 4}), Json::array({"2"})})
    refused(with({{"components", components}}), "components: " + components.dump() + " (allowed: ");
  refused(with({{"command", nullptr}}),
          "command: is missing (allowed: a list of texts, the program first)");
  for (const Json& command :
       {Json("true"), Json::array(), Json::array({"", "a"}), Json::array({"true", 1})})
    refused(with({{"command", command}}), "command: " + command.dump() + " (allowed: a list of ");
  refused(with({{"command", {"true", "{outpt}"}}}), "command: \"{outpt}\" (allowed: {input}, ");
  for (const Json& precision : {Json(0), Json(1e-3), Json("7")})
    refused(with({{"reads", "body"}, {"returns", "displacement"}, {"print_precision", precision}}),
            "print_precision: " + precision.dump() +
                " (allowed: with \"returns\": \"displacement\", above 0, up to 5e-6: six digits)");
  refused(with({{"print_precision", 1e-7}}), "print_precision: 1e-07 (allowed: with ");
  const auto refused_of_displacement = [&](const char* key, const Json& wrong, const Json& valid,
                                           const char* allowed) {
    const auto line = [&](const Json& given) {
      return fmt::format("{}: {} (allowed: with \"returns\": \"displacement\", {})", key,
                         given.dump(), allowed);
    };
    refused(with({{"reads", "body"}, {"returns", "displacement"}, {key, wrong}}), line(wrong));
    refused(with({{key, valid}}), line(valid));
  };
  refused_of_displacement("allowed_penetration", 0, 0.1, "above 0, up to 1");
  refused_of_displacement("allowed_penetration", "1 %", 1, "above 0, up to 1");
  refused_of_displacement("weak_contact", 1, true, "true or false");
  refused_of_displacement("joins_bodies", "yes", true, "true or false");
  refused_of_displacement("load_steps", 3, true, "true or false");
  for (const Json& parameter :
       {Json(1), Json({{"a", {1}}, {"b", {1}}}), Json({{"threads", {1}}}), Json({{"A", {1}}}),
        Json({{"a", Json::array()}}), Json({{"a", {1, 0}}}), Json({{"a", {"1"}}})})
    refused(with({{"parameter", parameter}}),
            "parameter: " + parameter.dump() + " (allowed: one name of a to z and _ that ");
  refused(with({{"parameter", {{"a", {1, 1.0}}}}, {"command", {"true", "{a}"}}}),
          "parameter: \"1\" (allowed: every value once)");
  refused(with({{"parameter", {{"a", {1}}}}}),
          "command: [\"true\",\"{output}\"] (allowed: with {a}");
  refused(with({{"parameter", {{"a", {1}}}}, {"command", {"true", "{b}"}}}),
          "command: \"{b}\" (allowed: {input}, ");
  refused(with({{"first_tolerance", 0}}), "first_tolerance: 0 (allowed: a number > 0)");
  refused(with({{"first_tolerance", 0.1}}),
          "first_tolerance: 0.1 (allowed: with {tolerance} in the command)");
  refused(with({{"version", {"false", "it"}}}), "version: false it: ended with exit code 1\n");
  refused(with({{"version", {"true"}}}), "version: true: ended with exit code 0\n");
  refused(with({{"version", {"no-such-program"}}}),
          "version: no-such-program: cannot be started: No such file or directory\n");
}

TEST_F(ExternalDeclarations, TwoOfOneNameAreRefused) {
  declare("one", "airy", "exit 1");
  std::filesystem::copy(bench_.path("one.json"), bench_.path("two.json"));
  const auto result = bench_.run("--external=one.json,two.json --method='EXTERNAL:*' --mesh=Mesh0");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err,
            "bench: --external: two.json: another file declares EXTERNAL:one (allowed: one)\n");
  EXPECT_EQ(bench_.run("--external=none.json --mesh=Mesh0").err,
            "bench: none.json: cannot be opened: No such file or directory\n");
}

}  // namespace
}  // namespace airybench::declarations_test
