// Declarations of other people's programs that are refused, each in a line.
#include <gtest/gtest.h>

#include "tests/bench/external/programs.hpp"

namespace airybench::declarations_test {
namespace {

using ExternalDeclarations = testing::ExternalPrograms;

TEST_F(ExternalDeclarations, WrongOnesAreRefused) {
  const auto refused = [&](const std::string& text, const std::string& named) {
    write("one.json", text);
    bench_.expect_refusal("--external=one.json --method='EXTERNAL:*' --mesh=Mesh0",
                          "one.json: " + named);
  };
  refused("", "not JSON: parse error");
  refused("[1]", "the file: [1] (allowed: a JSON object)");
  refused(std::string(100'000, '['), "nested more than 10 deep");

  const Json right = declaration("one", "condensed", {"true", "{output}"}),
             body = {{"reads", "body"}, {"returns", "displacement"}};
  // A change of it, null: without; and what is named, "" where it is the change itself.
  std::vector<std::pair<Json, std::string>> wrong = {
      {{{"colour", 1}}, "colour: unknown key (allowed: name, summary, reads, "},
      {{{"name", nullptr}}, "name: is missing (allowed: a text)"},
      {{{"name", ""}}, ""},
      {{{"name", "a,b"}}, ""},
      {{{"name", "../a"}}, ""},
      {{{"summary", 3}}, ""},
      {{{"reads", nullptr}}, "reads: is missing (allowed: airy, body, condensed)"},
      {{{"reads", "mind"}}, ""},
      {{{"returns", "airy_function"}}, ""},
      {{{"format", "xml"}}, ""},
      {{{"reads", "airy"}, {"returns", "airy_function"}, {"format", "fclib"}},
       "format: \"fclib\" ("},
      {{{"command", nullptr}}, "command: is missing (allowed: a list of texts"},
      {{{"command", {"true", "{outpt}"}}}, "command: \"{outpt}\" (allowed: {input}, "},
      {{{"parameter", {{"a", {1, 1.0}}}}, {"command", {"true", "{a}"}}}, "parameter: \"1\" (allow"},
      {{{"parameter", {{"a", {1}}}}}, "command: [\"true\",\"{output}\"] (allowed: with {a}"},
      {{{"parameter", {{"a", {1}}}}, {"command", {"true", "{b}"}}}, "command: \"{b}\" (allowed: "},
      {{{"first_tolerance", 0}}, ""},
      {{{"first_tolerance", 0.1}}, "first_tolerance: 0.1 (allowed: with {tolerance} in the comm"},
      {{{"version", {"false", "it"}}}, "version: false it: ended with exit code 1\n"},
      {{{"version", {"true"}}}, "version: true: ended with exit code 0\n"},
      {{{"version", {"no-such-program"}}}, "version: no-such-program: cannot be started: "}};
  for (const auto& [key, values] : std::vector<std::pair<std::string, std::vector<Json>>>{
           {"components", {2, Json::array(), Json::array({2, 4}), Json::array({"2"})}},
           {"command", {"true", Json::array(), Json::array({"", "a"}), Json::array({"true", 1})}},
           {"parameter",
            {1, Json{{"a", {1}}, {"b", {1}}}, Json{{"threads", {1}}}, Json{{"A", {1}}},
             Json{{"a", Json::array()}}, Json{{"a", {1, 0}}}, Json{{"a", {"1"}}}}}})
    for (const Json& value : values) wrong.emplace_back(Json{{key, value}}, "");
  // Right ones need a program that gives displacements.
  for (const auto& [key, values, valid] :
       std::vector<std::tuple<std::string, std::vector<Json>, Json>>{
           {"print_precision", {0, 1e-3, "7"}, 1e-7},
           {"allowed_penetration", {0, "1 %"}, 0.1},
           {"weak_contact", {1}, true},
           {"joins_bodies", {"yes"}, true},
           {"load_steps", {3}, true}}) {
    wrong.emplace_back(Json{{key, valid}}, "");
    for (const Json& value : values) {
      wrong.emplace_back(body, key + ": " + value.dump() + " (allowed: with \"returns\": ");
      wrong.back().first[key] = value;
    }
  }
  for (const auto& [change, named] : wrong) {
    Json json = right;
    json.merge_patch(change);
    const auto first = change.items().begin();
    refused(json.dump(),
            named.empty() ? first.key() + ": " + first.value().dump() + " (allowed: " : named);
  }
}

TEST_F(ExternalDeclarations, TwoOfOneNameAreRefused) {
  declare("one", "airy", "exit 1");
  std::filesystem::copy(bench_.path("one.json"), bench_.path("two.json"));
  bench_.expect_refusal(
      "--external=one.json,two.json --method='EXTERNAL:*' --mesh=Mesh0",
      "--external: two.json: another file declares EXTERNAL:one (allowed: one)\n");
  bench_.expect_refusal("--external=none.json --mesh=Mesh0", "none.json: cannot be opened");
}

}  // namespace
}  // namespace airybench::declarations_test
