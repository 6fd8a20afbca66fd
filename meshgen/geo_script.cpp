#include "meshgen/geo_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "mesh/model_format.hpp"
#include "meshgen/announced_counts.hpp"
#include "meshgen/deck_blocks.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/gzip.hpp"
#include "support/lists.hpp"
#include "support/numbers.hpp"

namespace airybench {
namespace {

struct Token {
  enum Kind { word, literal, sign } kind;
  std::string_view text;
  bool is(std::string_view other) const { return kind != literal && text == other; }
};

bool is_of_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Words, literals without their quotes, and single signs; no comments. They are parts of the text.
std::vector<Token> tokens_of(std::string_view text, const std::filesystem::path& file) {
  constexpr std::size_t max_tokens = 30'000'000;
  std::vector<Token> tokens;
  const auto cut = [&](std::size_t length) {
    const std::string_view part = text.substr(0, length);
    text.remove_prefix(part.size());
    return part;
  };
  while (!text.empty()) {
    if (tokens.size() > max_tokens)
      throw FileError(file.string() + ": more words and signs than 3e7 (allowed: up to that)");
    if (text.starts_with("//")) {
      cut(text.find('\n'));
    } else if (text.starts_with("/*")) {
      const std::size_t end = text.find("*/", 2);
      cut(end == text.npos ? end : end + 2);
    } else if (text.front() == '"' || text.front() == '\'') {
      const std::size_t end = text.find(text.front(), 1);
      const std::string_view quoted = cut(end == text.npos ? end : end + 1);
      tokens.push_back({Token::literal, quoted.substr(1, quoted.size() - 2)});
    } else if (is_of_word(text.front())) {
      const auto end = std::find_if_not(text.begin(), text.end(), is_of_word);
      tokens.push_back({Token::word, cut(static_cast<std::size_t>(end - text.begin()))});
    } else {
      const std::string_view one = cut(1);
      if (!std::isspace(static_cast<unsigned char>(one.front())))
        tokens.push_back({Token::sign, one});
    }
  }
  return tokens;
}

bool is_one_of(const Token& token, const auto& words) {
  return token.kind == Token::word && std::ranges::find(words, token.text) != words.end();
}

constexpr std::array<std::string_view, 2> readers = {"Include", "Merge"};  // "file";
// What else can make the outcome another than that of the files.
constexpr auto outside = std::to_array<std::string_view>({"MergeFile",
                                                          "MergeWithBoundingBox",
                                                          "ListFromFile",
                                                          "ShapeFromFile",
                                                          "FileExists",
                                                          "FileName",
                                                          "GetEnv",
                                                          "GetNumber",
                                                          "GetString",
                                                          "OnelabRun",
                                                          "ExternalProcess",
                                                          "CommandLine",
                                                          "Rand",
                                                          "Cpu",
                                                          "Memory",
                                                          "TotalMemory",
                                                          "Today",
                                                          "System",
                                                          "SystemCall",
                                                          "NonBlockingSystemCall"});

constexpr std::array<std::string_view, 5> writers = {"Save", "Print", "CreateDir", "Plugin",
                                                     "OnelabRun"};
constexpr std::array<std::string_view, 5> starters = {"SystemCall", "NonBlockingSystemCall",
                                                      "System", "OnelabRun", "ExternalProcess"};

// Words of Gmsh that read nothing and give the same each time. After a dot only these are known.
constexpr const char* harmless_words =
    "Abs Acos Affine Algorithm Alternate Asin Atan Atan2 Attractor AutoCoherence BSpline "
    "Background Ball Beta Bezier BooleanDifference BooleanFragments BooleanIntersection "
    "BooleanUnion Boundary BoundingBox Box Bump Call Ceil Chamfer Characteristic "
    "CharacteristicLengthExtendFromBoundary CharacteristicLengthFactor "
    "CharacteristicLengthFromCurvature CharacteristicLengthFromPoints "
    "CharacteristicLengthMax CharacteristicLengthMin Choices Circle Closed Coherence "
    "CombinedBoundary Compound Cone Constant Cos Cosh Curve CurvesList Cylinder "
    "DefineConstant DefineNumber Delete Dilate Disk DistMax DistMin Distance Duplicata "
    "EdgesList ElementOrder Ellipse Else ElseIf Embed EndFor EndIf Error Exp Extrude F Fabs "
    "FacesList Field FieldsList Fillet Filling Floor Fmod For Function General Geometry Hide "
    "Hypot IField If In InField Include Label Layers LcMax LcMin Left Length LinSpace Line "
    "Log Log10 LogSpace Loop Macro MathEval Max Merge Mesh MeshSize "
    "MeshSizeExtendFromBoundary MeshSizeFactor MeshSizeFromCurvature MeshSizeFromPoints "
    "MeshSizeMax MeshSizeMin Min Modulo MshFileVersion NNodesByEdge Name NodesList "
    "OCCBooleanPreserveNumbering OldNewReg Optimize Periodic Physical Pi Plane Point "
    "PointsList PointsOf Printf Progression Radius RandomFactor Range ReadOnly "
    "RecombinationAlgorithm Recombine RecombineAll Rectangle Restrict Return Reverse Right "
    "Rotate Round Ruled Sampling SaveAll ScalingFactor SecondOrderLinear SetFactory Show "
    "Sigmoid Sin Sinh SizeMax SizeMin Smoothing Sphere Spline Sprintf Sqrt Step "
    "StopAtDistMax Str StrCat SubdivisionAlgorithm Surface SurfacesList Symmetry Tan Tanh "
    "Terminal Thickness Threshold Tolerance Torus Transfinite Translate Unique Using VIn "
    "VOut Verbosity Visible Volume Warning Wedge Wire XCenter XMax XMin YCenter YMax YMin "
    "ZCenter ZMax ZMin newc newcl newf newl newll newp newreg news newsl newv";

const std::set<std::string, std::less<>>& harmless() {
  static const std::set<std::string, std::less<>> words = [] {
    const std::vector<std::string> list = split_list(harmless_words, ' ');
    return std::set<std::string, std::less<>>(list.begin(), list.end());
  }();
  return words;
}

// A longer index may be one, too, that is then not known.
constexpr std::size_t longest_index = 100;

bool is_definition(const std::vector<Token>& tokens, std::size_t at) {
  std::size_t next = at + 1;
  const std::size_t end = std::min(tokens.size(), next + longest_index);
  const auto is = [&](const char* sign) { return next < tokens.size() && tokens[next].is(sign); };
  for (const auto& [open, close] : {std::pair("(", ")"), {"[", "]"}, {"{", "}"}})
    if (is(open)) {
      while (next < end && !is(close)) ++next;
      ++next;
    }
  for (const char* sign : {"+", "-", "*", "/"})
    if (is(sign)) ++next;
  return is("=") && (next + 1 >= tokens.size() || !tokens[next + 1].is("="));
}

// Neither harmless, nor a number, nor a name that the script gives itself.
bool has_unknown_words(const std::vector<Token>& tokens, const GeoScript& script) {
  std::set<std::string_view> own(script.constants.begin(), script.constants.end());
  for (std::size_t at = 0; at < tokens.size(); ++at)
    if (tokens[at].kind == Token::word &&
        (is_definition(tokens, at) ||
         (at > 0 && (tokens[at - 1].is("For") || tokens[at - 1].is("Macro") ||
                     tokens[at - 1].is("Function")))))
      own.insert(tokens[at].text);
  // A script may call them in spite of a definition that Gmsh never comes to.
  for (const std::string_view command : outside) own.erase(command);
  for (const std::string_view command : writers) own.erase(command);
  for (std::size_t at = 0; at < tokens.size(); ++at) {
    const Token& token = tokens[at];
    if (token.kind == Token::literal && token.text.find_first_of("\\\n") != std::string::npos)
      return true;  // where Gmsh ends it is not known
    if (token.kind != Token::word || std::isdigit(static_cast<unsigned char>(token.text.front())))
      continue;
    const bool is_member = at > 0 && tokens[at - 1].is(".");
    if (!harmless().contains(token.text) && (is_member || !own.contains(token.text))) return true;
  }
  return false;
}

// A number of several tokens, "-1.5e+12", from `at` on, which is then behind it.
std::optional<double> number_at(const std::vector<Token>& tokens, std::size_t& at) {
  std::string text;
  std::size_t next = at;
  const auto is = [&](const char* sign) { return next < tokens.size() && tokens[next].is(sign); };
  const auto take = [&] { text += tokens[next++].text; };
  const auto take_word = [&] {
    if (next < tokens.size() && tokens[next].kind == Token::word) take();
  };
  if (is("-")) take();
  take_word();
  if (is(".")) {
    take();
    take_word();
  }
  if ((text.ends_with('e') || text.ends_with('E')) && (is("+") || is("-"))) {
    take();
    take_word();
  }
  const std::optional<double> number = parse_number(text);
  if (number) at = next;
  return number;
}

// Of those written with numbers, first:last:step: Gmsh takes memory for all before it begins. A
// loop's needs none.
void refuse_long_lists(const std::vector<Token>& tokens, const std::filesystem::path& file) {
  for (std::size_t at = 0; at < tokens.size(); ++at) {
    const bool is_loop = at >= 2 && (tokens[at - 2].is("In") || tokens[at - 2].is("For"));
    std::size_t next = at;
    const std::optional<double> first = number_at(tokens, next);
    if (!first || next >= tokens.size() || !tokens[next].is(":")) continue;
    const std::optional<double> last = number_at(tokens, ++next);
    double step = 1;
    if (next < tokens.size() && tokens[next].is(":"))
      step = number_at(tokens, ++next).value_or(step);
    if (last && !is_loop && !(std::abs((*last - *first) / step) <= max_entries))
      throw FileError(
          fmt::format("{}: a list of the numbers {:g} to {:g} (allowed: up to 1e7 numbers)",
                      file.string(), *first, *last));
    if (last) at = next - 1;  // nor is a:b:c also b:c
  }
}

// The names that a definition list [a = …, b = {…}] gives values to; returns the index behind it.
std::size_t read_definitions(const std::vector<Token>& tokens, std::size_t at, GeoScript& script) {
  int depth = 0;
  for (; at < tokens.size(); ++at) {
    const Token& token = tokens[at];
    if (token.is("[") || token.is("{") || token.is("(")) ++depth;
    if (token.is("]") || token.is("}") || token.is(")")) --depth;
    if (depth == 0) break;
    const Token& before = tokens[at - 1];
    if (depth == 1 && token.kind == Token::word && (before.is("[") || before.is(",")))
      script.constants.emplace(token.text);
  }
  return at;
}

std::string script_text(const std::filesystem::path& file) {
  return is_gzipped(file) ? unpacked_text(file) : file_text(file);
}

void read_into(GeoScript& script, const std::filesystem::path& file, const std::string& text);

// Gmsh may never come to where it is included: that it is not there is for Gmsh to say.
void read_included(GeoScript& script, const std::filesystem::path& file) {
  if (std::ranges::find(script.files, file) != script.files.end()) return;
  try {
    read_into(script, file, file_text(file));
  } catch (const FileError&) {
    script.is_self_contained = false;
  }
}

void read_into(GeoScript& script, const std::filesystem::path& file, const std::string& text) {
  script.files.push_back(file);
  const std::vector<Token> tokens = tokens_of(text, file);
  refuse_long_lists(tokens, file);
  bool prints = false;
  for (std::size_t at = 0; at + 1 < tokens.size(); ++at) {
    const Token &token = tokens[at], &next = tokens[at + 1];
    if (is_one_of(token, outside)) script.is_self_contained = false;
    script.may_write |= is_one_of(token, writers);
    script.may_start_programs |= is_one_of(token, starters);
    if (token.is("ExternalProcess")) script.has_external_process = true;
    if (token.is("Name") && next.kind == Token::literal) script.onelab_names.emplace(next.text);
    if (token.is("DefineConstant") && next.is("[")) read_definitions(tokens, at + 1, script);
    if (token.is("Printf") || token.is("Error") || token.is("Warning")) prints = true;
    if (token.is(";")) prints = false;
    script.may_write |= prints && token.is(">");
    if (!is_one_of(token, readers)) continue;
    const bool is_literal =
        next.kind == Token::literal && at + 2 < tokens.size() && tokens[at + 2].is(";");
    if (!is_literal)
      script.is_self_contained = false;
    else
      read_included(script, (file.parent_path() / next.text).lexically_normal());
  }
  script.has_unknown_words |= has_unknown_words(tokens, script);
}

}  // namespace

GeoScript read_geo_script(const std::filesystem::path& file) {
  GeoScript script;
  read_into(script, file.lexically_normal(), script_text(file));
  return script;
}

GeoScript what_is_read(const std::filesystem::path& model) {
  GeoScript script;
  if (format_of(model) == ModelFormat::geo)
    script = read_geo_script(model);
  else
    script.files = {model};
  if (format_of(model) == ModelFormat::abaqus && includes_files(script_text(model)))
    script.is_self_contained = false;
  const std::filesystem::path options = model.string() + ".opt";
  std::error_code error;
  if (std::filesystem::exists(options, error)) read_into(script, options, file_text(options));
  return script;
}

int line_with(const std::filesystem::path& file, const std::string& text) {
  const std::string all = script_text(file);
  const std::size_t at = all.find(text);
  return at == all.npos
             ? 0
             : 1 + static_cast<int>(std::count(
                       all.begin(), all.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

}  // namespace airybench
