// Tables for papers: Markdown, and LaTeX with booktabs.
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "bench/report/results_table.hpp"

namespace airybench {
namespace {

std::string escaped_in_markdown(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("\\`*_[]<>|~&$").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string escaped_in_latex(std::string_view text) {
  static const std::vector<std::pair<std::string_view, std::string_view>> commands = {
      {"\\", "\\textbackslash{}"},
      {"^", "\\textasciicircum{}"},
      {"~", "\\textasciitilde{}"},
      {"<", "\\textless{}"},
      {">", "\\textgreater{}"},
      {"|", "\\textbar{}"},
      {"--", "-{}-{}"},
      {"±", "$\\pm$"},
      {"µ", "$\\mu$"},
      {"{", "\\{"},
      {"}", "\\}"},
      {"$", "\\$"},
      {"&", "\\&"},
      {"#", "\\#"},
      {"_", "\\_"},
      {"%", "\\%"}};
  std::string escaped;
  while (!text.empty()) {
    const auto command = std::ranges::find_if(
        commands, [&](const auto& pair) { return text.starts_with(pair.first); });
    const bool is_plain = command == commands.end();
    escaped += is_plain ? text.substr(0, 1) : command->second;
    text.remove_prefix(is_plain ? 1 : command->first.size());
  }
  return escaped;
}

struct Number {
  std::string whole, fraction, exponent;  // "2", "8", "-11"
};

std::optional<Number> parts_of(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789.e+-") != text.npos || text == "-")
    return {};
  const std::size_t e = std::min(text.find('e'), text.size());
  const std::size_t point = std::min(text.find('.'), e);
  Number number = {text.substr(0, point), point < e ? text.substr(point + 1, e - point - 1) : "",
                   ""};
  if (e < text.size()) number.exponent = fmt::format("{}", std::stoi(text.substr(e + 1)));
  return number;
}

// Invisible digits, so that the points of a column flush right are below each other.
std::string padding(std::string digits) {
  return digits.empty() ? "" : fmt::format("\\phantom{{{}}}", digits);
}

// The longest fraction and exponent of the column are `widest`.
std::string number_in_latex(const Number& number, const Number& widest) {
  if (number.exponent.empty() && !widest.exponent.empty()) return number.whole;  // an error of 0
  std::string text = number.whole;
  if (!number.fraction.empty()) text += "." + number.fraction;
  if (number.fraction.size() < widest.fraction.size())
    text += padding((number.fraction.empty() ? "." : "") +
                    widest.fraction.substr(number.fraction.size()));
  if (number.exponent.empty()) return text;
  return fmt::format(
      "${}\\cdot10^{{{}{}}}$", text, number.exponent,
      padding(widest.exponent.substr(std::min(number.exponent.size(), widest.exponent.size()))));
}

std::string in_row(const std::vector<std::string>& cells, const char* separator) {
  return fmt::format("{}", fmt::join(cells, separator));
}

}  // namespace

std::string markdown_text(const PaperTable& table) {
  std::vector<std::string> headers, rules;
  for (const auto& [header, is_flush_right] : table.columns) {
    headers.push_back(escaped_in_markdown(header));
    rules.emplace_back(is_flush_right ? "---:" : "---");
  }
  std::string text = fmt::format("| {} |\n| {} |\n", in_row(headers, " | "), in_row(rules, " | "));
  for (const std::vector<std::string>& row : table.rows) {
    std::vector<std::string> cells;
    std::ranges::transform(row, std::back_inserter(cells), escaped_in_markdown);
    text += fmt::format("| {} |\n", in_row(cells, " | "));
  }
  return text;
}

std::string latex_text(const PaperTable& table) {
  std::vector<std::string> headers;
  std::string alignment;
  std::vector<std::vector<std::string>> rows(table.rows.size());
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const auto& column = table.columns[i];
    headers.push_back(escaped_in_latex(column.header));
    alignment += column.is_flush_right ? 'r' : 'l';
    const auto number_of = [&](const std::vector<std::string>& row) {
      return column.is_flush_right ? parts_of(row[i]) : std::nullopt;
    };
    Number widest;
    for (const std::vector<std::string>& row : table.rows)
      if (const std::optional<Number> number = number_of(row)) {
        if (number->fraction.size() > widest.fraction.size()) widest.fraction = number->fraction;
        if (number->exponent.size() > widest.exponent.size()) widest.exponent = number->exponent;
      }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const std::optional<Number> number = number_of(table.rows[k]);
      rows[k].push_back(number ? number_in_latex(*number, widest)
                               : escaped_in_latex(table.rows[k][i]));
    }
  }
  std::string text = fmt::format(
      "\\begin{{tabular}}{{{}}}  % \\usepackage{{booktabs}}\n\\toprule\n{} \\\\\n"
      "\\midrule\n",
      alignment, in_row(headers, " & "));
  for (const std::vector<std::string>& row : rows) text += in_row(row, " & ") + " \\\\\n";
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace airybench
