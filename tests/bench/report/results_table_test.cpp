// The table of cases for papers: golden texts, from records made up for what could break a format.
#include "bench/report/results_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

#include "tests/support/contains.hpp"

namespace airybench::results_table_test {
namespace {

Record measured(const std::string& method, double time_s, std::int64_t heap, double error) {
  Record record;
  record.mesh = "Mesh3";
  record.scene = "a_b|c";
  record.method = method;
  record.status = Status::ok;
  record.n_phi = 6287;
  record.time_s = time_s;
  record.time_mad_s = time_s / 100;
  record.repetitions = 5;
  record.peak_heap_bytes = heap;
  record.error_stress = error;
  record.error_force = method == "HYBRID" ? 0 : 2 * error;
  return record;
}

std::vector<Record> cases() {
  Record failed = measured("ALM:r=20,rho=20", 1, 0, 1);
  failed.status = Status::not_converged;
  failed.time_s = failed.time_mad_s = failed.error_stress = failed.error_force = {};
  failed.peak_heap_bytes = {};
  Record paper = measured("SSKY", 0.4251, 3 << 20, 3.84e-8);
  paper.stop = Stop::paper;
  paper.repetitions = 1;
  return {measured("3STEPD", 0.1114, 33554432, 2.84e-11), paper,
          measured("HYBRID", 0.00876, 10100000, 1.2e-13), failed};
}

std::string message(const std::vector<std::string>& columns) {
  try {
    paper_table(cases(), columns);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ResultsTables, ARemarkNamesItsSceneOrWhereRemarksDifferItsCase) {
  const auto reasons = [](const std::vector<std::string>& remarks) {
    ResultsTable table;
    for (std::size_t k = 0; k < remarks.size(); ++k) {
      Record record = measured(fmt::format("HYBRID:k={}", k + 1), 1, 1, 1e-9);
      record.status_reason = remarks[k];
      table.add(record);
    }
    const std::string text = table.text();
    return text.substr(text.rfind("ok\n") + 3);
  };
  EXPECT_EQ(reasons({"it slides", "it slides", ""}), "Mesh3/a_b|c: it slides\n");
  EXPECT_EQ(reasons({"it slides", "it rolls", "it slides"}),
            "Mesh3/a_b|c/HYBRID:k=1 and 1 more: it slides\nMesh3/a_b|c/HYBRID:k=2: it rolls\n");
}

TEST(ResultsTables, HaveEightColumnsUnlessAskedForOthers) {
  Record record = measured("HYBRID", 1, 1, 1e-9);
  record.error_total = 0.01;
  record.adapt_time_s = 2;
  record.stage_check_s = 0.1;
  const auto text = [&](const std::vector<std::string>& chosen) {
    ResultsTable table(chosen);
    table.add(record);
    return table.text();
  };
  const auto words = [&](const std::vector<std::string>& chosen) {
    std::istringstream line(text(chosen).substr(0, text(chosen).find('\n')));
    return std::ssize(std::vector<std::string>(std::istream_iterator<std::string>(line), {}));
  };
  EXPECT_EQ(words({}), 10);  // two of them are two words
  EXPECT_TRUE(testing::contains(text({}), "error total  adaptive loop"));
  EXPECT_TRUE(text({}).ends_with(
      "not shown: without_self-check, error_stress, error_force (--columns=NAMES or all)\n"));
  EXPECT_EQ(words({"all"}), 16);
  EXPECT_FALSE(testing::contains(text({"all"}), "not shown"));
  EXPECT_TRUE(text({"error_total", "method"}).starts_with("error total  method"));
  EXPECT_TRUE(text({"time"}).starts_with("case"));
}

TEST(PaperTables, MarkdownHasAUnitPerColumn) {
  EXPECT_EQ(
      markdown_text(paper_table(cases(), {})),
      R"(| case | n\_phi | time, ms | ±, ms | heap, MiB | error stress | error force | status |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |
| Mesh3/a\_b\|c/3STEPD | 6287 | 111 | 1.11 | 32.0 | 2.8e-11 | 5.7e-11 | ok |
| Mesh3/a\_b\|c/SSKY/stop=paper | 6287 | 425 | n=1 | 3.00 | 3.8e-08 | 7.7e-08 | ok |
| Mesh3/a\_b\|c/HYBRID | 6287 | 8.76 | 0.0876 | 9.63 | 1.2e-13 | 0 | ok |
| Mesh3/a\_b\|c/ALM:r=20,rho=20 | 6287 | - | - | - | - | - | not\_converged |
)");
}

TEST(PaperTables, LatexPutsPointsBelowEachOther) {
  EXPECT_EQ(latex_text(paper_table(cases(), {"method", "time", "±", "error_force", "status"})),
            R"(\begin{tabular}{lrrrl}  % \usepackage{booktabs}
\toprule
method & time, ms & $\pm$, ms & error force & status \\
\midrule
3STEPD & 111\phantom{.76} & 1.11\phantom{76} & $5.7\cdot10^{-11}$ & ok \\
SSKY/stop=paper & 425\phantom{.76} & n=1 & $7.7\cdot10^{-8\phantom{1}}$ & ok \\
HYBRID & 8.76 & 0.0876 & 0 & ok \\
ALM:r=20,rho=20 & - & - & - & not\_converged \\
\bottomrule
\end{tabular}
)");
}

TEST(PaperTables, LatexEscapesEverySpecialCharacter) {
  const PaperTable table = {{{"µ %", false}}, {{R"(a\b{c}$d&e#f_g^h~i<j>k|l--m)"}, {"1.5"}}};
  EXPECT_EQ(latex_text(table),
            R"(\begin{tabular}{l}  % \usepackage{booktabs}
\toprule
$\mu$ \% \\
\midrule
a\textbackslash{}b\{c\}\$d\&e\#f\_g\textasciicircum{}h\textasciitilde{}i\textless{}j\textgreater{}k\textbar{}l-{}-{}m \\
1.5 \\
\bottomrule
\end{tabular}
)");
}

TEST(PaperTables, ChosenColumnsNameTheirCases) {
  const auto headers = [](const std::vector<std::string>& chosen) {
    std::string text;
    for (const auto& column : paper_table(cases(), chosen).columns) text += column.header + ";";
    return text;
  };
  EXPECT_EQ(headers({"heap", "time"}), "case;heap, MiB;time, ms;");
  EXPECT_EQ(headers({"heap", "mesh"}), "heap, MiB;mesh;");
  EXPECT_EQ(headers({"time", "case"}), "time, ms;case;");
  EXPECT_EQ(headers({"error_total"}), "case;error total;");  // without values
  EXPECT_TRUE(message({"speed"}).starts_with(
      "--columns: no column is 'speed' (valid: all, case, mesh, scene, method, n_phi, "))
      << message({"speed"});
}

TEST(PaperTables, UnitsFollowTheMedian) {
  const auto header = [](double time_s, std::int64_t heap) {
    const PaperTable table = paper_table({measured("HYBRID", time_s, heap, 0)}, {"time", "heap"});
    return table.columns[1].header + "; " + table.columns[2].header + "; " + table.rows[0][1];
  };
  EXPECT_EQ(header(90e-6, 5 << 20), "time, µs; heap, MiB; 90.0");
  EXPECT_EQ(header(1, 1 << 30), "time, s; heap, GiB; 1.00");
  EXPECT_EQ(header(12345, 1), "time, s; heap, MiB; 12345");
}

}  // namespace
}  // namespace airybench::results_table_test
