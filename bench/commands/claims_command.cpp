#include "bench/commands/commands.hpp"

#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>
#include <cstdio>
#include <filesystem>

#include "bench/commands/command_line.hpp"
#include "bench/report/claims.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/lists.hpp"
#include "support/this_process.hpp"

namespace airybench {
namespace {

constexpr const char* claims_footer = R"(
Verdicts  reproduced
          not reproduced  one part of the claim is contradicted
          undecided       a record is missing or of no use, or an interval straddles the threshold;
                          "open" says which

Two cases are compared by the ratio of their median times with its 95 % bootstrap interval (none
where both have one sample); over several meshes by geometric mean and range. ~: a case ran out of
time, and its extrapolated time is the figure; only the time it did spend counts for the verdict.

Exit status  0  whatever the verdicts
             2  wrong usage, or records that cannot be read: one line on standard error

Example
  {bench} claims results/paper --stop=target --out=results/paper/claims.md
)";

std::string cell(const std::vector<std::string>& lines) {
  return boost::replace_all_copy(joined(lines, "<br>"), "|", "\\|");
}

std::string claims_text(const std::vector<Claim>& claims) {
  std::string text;
  int number = 0;
  for (const Claim& claim : claims) {
    text += fmt::format("{:>2}  {:<14}  {}\n", ++number, name_of(claim.verdict), claim.sentence);
    for (const auto& [name, lines] :
         {std::pair("figures", &claim.figures), std::pair("interval", &claim.intervals),
          std::pair("open", &claim.open)})
      for (const std::string& line : *lines) text += fmt::format("    {:<8}  {}\n", name, line);
  }
  return text;
}

std::string claims_markdown(const std::vector<Claim>& claims) {
  std::string text =
      "| | claim (section of the paper) | figures | interval | verdict |\n|---|---|---|---|---|\n";
  int number = 0;
  for (const Claim& claim : claims) {
    std::vector<std::string> verdict = claim.open;
    verdict.insert(verdict.begin(), "**" + std::string(name_of(claim.verdict)) + "**");
    text += fmt::format("| {} | {} | {} | {} | {} |\n", ++number, cell({claim.sentence}),
                        cell(claim.figures), cell(claim.intervals), cell(verdict));
  }
  return text;
}

}  // namespace

int claims_command(int argc, const char* const* argv) {
  std::filesystem::path folder, out;
  std::string stop = "target";
  CLI::App app("The paper's claims on time and memory, tested against the records of a run.",
               "{bench} claims");
  app.footer(claims_footer);
  app.add_option("DIR", folder, "folder with records.jsonl")->required();
  app.add_option("--stop", stop, "use the records with this stop of the iterative methods")
      ->check(CLI::IsMember({"target", "paper"}))
      ->capture_default_str();
  app.add_option("--out", out, "also write the table to this file, *.md");
  parse_command_line(app, argc, argv);
  if (out.empty()) require_standard_output();
  if (!out.empty() && out.extension() != ".md")
    throw UsageError(fmt::format("--out: {} (allowed: a name that ends in .md)", out.string()));

  const std::string file = records_file_in(folder).string();
  const CaseTable cases(read_records(file), stop, file);
  const std::vector<Claim> claims = check_claims(cases);
  const std::string mesh = cases.preconditioner_mesh();
  const std::string title =
      fmt::format("{}: {} cases, stop {}, scene {}, preconditioners on {}", file, cases.size(),
                  stop, cases.scene(), mesh.empty() ? "no mesh" : mesh);
  if (!out.empty()) write_file_atomically(out, title + "\n\n" + claims_markdown(claims));
  fmt::print("{}\n\n{}", title, claims_text(claims));
  return 0;
}

}  // namespace airybench
