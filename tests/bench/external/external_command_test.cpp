// Other people's programs through the bench command, on all kinds of scenes.
#include <gtest/gtest.h>

#include "tests/bench/external/programs.hpp"
#include "tests/support/background_run.hpp"
#include "tests/support/environment_variable.hpp"
#include "tests/support/places.hpp"

namespace airybench::external_command_test {
namespace {

class ExternalCommand : public testing::ExternalPrograms {
 protected:
  void declare_honest() const {
    write("right/answer.json",
          R"({"status": "ok", "time_s": 2e-6, "stages": {"contact": 1e-6}, "contact_iterations": 7,
              "parameters": "none"})");
    for (const char* reads : {"airy", "condensed", "body"})
      declare(reads, reads, "cp right/* $2; sleep 0.1",
              {{"version", {"echo", std::string(reads) + " 1.0"}}});
  }
};

TEST_F(ExternalCommand, AnHonestAnswerIsOkWithItsOwnNumbers) {
  write_right();
  declare_honest();
  const auto records = records_of("--fields=histories", 0);
  ASSERT_EQ(records.size(), 3u);
  for (const auto& [name, r] : records) {
    SCOPED_TRACE(name);
    EXPECT_EQ(r["status"], "ok") << r["status_reason"];
    EXPECT_EQ(r["family"], "EXTERNAL:" + name);
    EXPECT_EQ(r["program"], name + " 1.0");
    EXPECT_GE(r["program_s"], 0.1);  // it sleeps so long, which its own clock leaves out
    EXPECT_GT(r["program_solve_s"], 0);
    EXPECT_LT(r["program_solve_s"], r["time_s"]);  // which has our part, too
    EXPECT_GE(r["time_s"], 2e-6);
    EXPECT_GT(r["processor_s"], 0);
    EXPECT_GT(r["peak_rss_bytes"], 0);
    EXPECT_TRUE(r["peak_heap_bytes"].is_null());
    EXPECT_GE(r["stage_contact_s"], 1e-6);
    EXPECT_EQ(r["parameters"], "none");
    EXPECT_EQ(r["contact_iterations"], 7);
    EXPECT_EQ(r["in_displacements"], name == "body");
    EXPECT_EQ(r["error_force"].is_null(), name == "body");
  }
}

// Its own forces balance, and nothing else asks whether it presses where there is a gap.
TEST_F(ExternalCommand, StressWhereThereIsNoneIsInaccurate) {
  Scene pressed;
  pressed.displacement_mm = {0.01, 0};
  pressed.crown_radius_mm.reset();
  write_right(pressed);
  declare("one", "body", "cp right/* $2");
  write("scenes/apart.json",
        R"({"displacement_mm": [0.01, 0], "crown_radius_mm": null, "clearance_mm": 0.02})");
  const Json record = records_of("--scene=scenes/apart.json", 1).at("one");
  EXPECT_EQ(record["status"], "inaccurate") << record["status_reason"];
}

TEST_F(ExternalCommand, ScenesWithoutFrictionAndWithoutContact) {
  for (const char* text : {R"({"friction": 0})", R"({"mesh": {"keep_contact_edges": 0},
                               "boundary": {"force": {"pressure_MPa": 3}}})"}) {
    SCOPED_TRACE(text);
    write("scenes/scene.json", text);
    write_right(read_scene_file(bench_.path("scenes/scene.json")).scene);
    declare_honest();
    const bool contact = std::string_view(text).find("keep") == std::string_view::npos;
    const auto records = records_of("--scene=scenes/scene.json", 0);
    for (const auto& [name, r] : records) {
      const bool skipped = name == "condensed" && !contact;
      EXPECT_EQ(r["status"], skipped ? "skipped" : "ok") << name << r["status_reason"];
      EXPECT_EQ(r["status_reason"] == "no contact boundary: nothing is left for the program",
                skipped);
    }
  }
}

// NumPy's file of it.
std::string npy(const Eigen::MatrixXd& values) {
  std::string header = "{'descr': '<f8', 'fortran_order': True, 'shape': (" +
                       std::to_string(values.rows()) + ", " + std::to_string(values.cols()) +
                       "), }";
  header.resize(117, ' ');
  const std::string bytes(reinterpret_cast<const char*>(values.data()),
                          static_cast<std::size_t>(values.size()) * sizeof(double));
  return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n" + bytes;
}

TEST_F(ExternalCommand, EdgeDisplacementsAreJudgedAsHybrids) {
  for (const double friction : {0.2, 0.0}) {
    write("scenes/scene.json", Json{{"friction", friction}}.dump());
    const Scene scene = read_scene_file(bench_.path("scenes/scene.json")).scene;
    write_right(scene);
    const Json returns = {{"returns", "edge_displacements"}};
    declare("text", "body", "cp right/* $2", returns);
    const Eigen::MatrixXd u = testing::right_answer(scene).edge_displacements_mm;
    write("numpy.npy", npy(u));
    write("short.npy", npy(u.topRows(3)));
    const std::string copy = "cp right/* $2; rm $2/edge*; cp ";
    declare("numpy", "body", copy + "numpy.npy $2/edge_displacements_mm.npy", returns);
    declare("short", "body", copy + "short.npy $2/edge_displacements_mm.npy", returns);
    const auto records = records_of("--scene=scenes/scene.json", 1);
    for (const char* name : {"text", "numpy"}) {
      const Json& r = records.at(name);
      EXPECT_EQ(r["status"], "ok") << r["status_reason"];
      EXPECT_FALSE(r["in_displacements"].get<bool>());
      EXPECT_LT(r["error_stress"], 1e-10);
      EXPECT_LT(r["error_force"], 1e-10);
    }
    EXPECT_EQ(records.at("short")["status"], "breakdown");
    EXPECT_TRUE(testing::contains(records.at("short")["status_reason"].get<std::string>(),
                                  "shape (359, 4)"));
  }
}

TEST_F(ExternalCommand, ItsLogIsKept) {
  write_right();
  declare("airy", "airy", "cp right/* $2; echo iterations: 7 > $2/log.txt");
  records_of("", 0);
  EXPECT_EQ(bench_.content("o/programs/Mesh0--default--EXTERNAL+airy.txt"), "iterations: 7\n");
}

TEST_F(ExternalCommand, WhatIsHandedOver) {
  write_right();
  const std::string script =
      "test -s $1/problem.json || exit 3; rmdir $2 && mkdir $2 || exit 4; "
      "ls $1/F_C.mtx && exit 5; cp right/* $2; "  // the answer is not given away
      "echo \"$3 $4 $5 $OMP_NUM_THREADS\" > said";
  const auto with_last = [&](const char* word) {
    declare("one", "condensed", script,
            {{"command",
              {"sh", "-c", script, "sh", "{input}", "{output}", "{threads}", "{threads}{threads}",
               word}}});
  };
  with_last("{braces}");
  EXPECT_EQ(records_of("--threads=1", 2).size(), 0u);
  with_last("{} {\"a\": 1} {threads");
  const auto records = records_of("--threads=1", 0);
  EXPECT_EQ(records.at("one")["status"], "ok") << records.at("one")["status_reason"];
  EXPECT_EQ(bench_.content("said"), "1 11 {} {\"a\": 1} {threads 1\n");
}

// 1e-2 of the target error, then a third of what its own estimate lacks.
TEST_F(ExternalCommand, IsTightenedUntilItsOwnEstimateIsBelowTheTarget) {
  write_right();
  write("right/rough", R"({"status": "inaccurate", "time_s": 1e-6, "error_estimate": 1e-5})");
  const std::string script =
      "cp right/* $2; test -f said || mv $2/rough $2/answer.json; echo $3 >> said";
  declare("one", "condensed", script,
          {{"command", {"sh", "-c", script, "sh", "{input}", "{output}", "{tolerance}"}},
           {"first_tolerance", 1e-2}});
  const Json record = records_of("--target-error=1e-6", 0).at("one");
  EXPECT_EQ(record["status"], "ok") << record["status_reason"];
  std::vector<double> said;
  std::istringstream lines(bench_.content("said"));
  for (std::string line; std::getline(lines, line);) said.push_back(std::stod(line));
  ASSERT_GT(said.size(), 2u);
  EXPECT_DOUBLE_EQ(said[0], 1e-8);
  for (std::size_t k = 1; k < said.size(); ++k) EXPECT_DOUBLE_EQ(said[k], 1e-8 * (0.1 / 3));
  EXPECT_EQ(record["tolerance"], said[1]);
  ASSERT_EQ(record["attempts"].size(), 2u);
  EXPECT_EQ(record["attempts"][0]["claimed_status"], "inaccurate");
  EXPECT_EQ(record["attempts"][0]["error_estimate"], 1e-5);
  EXPECT_LT(record["attempts"][0]["error"], 1e-9);
  EXPECT_EQ(record["attempts"][1]["tolerance"], said[1]);
}

// TMPDIR may be relative, or look like a placeholder.
TEST_F(ExternalCommand, FoldersOfAllKinds) {
  write_right();
  for (const char* folder : {"tmp", "t m ü p", "{input}", "{output}{threads}"}) {
    SCOPED_TRACE(folder);
    std::filesystem::create_directories(bench_.path(folder) / "of it");
    write(std::string(folder) + "/of it/ö, ne.json",
          declaration("one", "condensed", {"./a program", "{output}", "{input}"}).dump());
    const auto program = std::string(folder) + "/of it/a program";
    write(program, "#!/bin/sh\ntest -d \"$2\" && cp ../../right/* \"$1\"\n");
    std::filesystem::permissions(bench_.path(program), std::filesystem::perms::owner_all);
    const std::string list = std::string(folder) + "/of it/ö\\, ne.json";
    const auto result = bench_.run(
        "--external='" + list + "' --method='EXTERNAL:*' --mesh=Mesh0 --repetitions=1 --out=o",
        "export TMPDIR='" + std::string(folder) + "'; ");
    EXPECT_EQ(result.code, 0) << result.err << result.out;
    std::filesystem::remove_all(bench_.path(folder) / "of it");
    EXPECT_TRUE(std::filesystem::is_empty(bench_.path(folder)));  // nothing is left
  }
}

TEST_F(ExternalCommand, WhatIsNotItsAnswerHasAStatusOfItsOwn) {
  write_right();
  const std::string endless = "exec yes", right = "cp right/* $2";
  declare("endless", "condensed", endless);
  declare("right", "condensed", right);
  declare("space", "condensed", endless, {{"components", {3}}});
  for (const auto& [name, before, status, reason] :
       {std::array{"endless", "ulimit -f 20000; ",  // sooner than at our own limit
                   "crashed",
                   "endless was ended by SIGXFSZ: a file that it wrote became too large: y"},
        {"right", "export TMPDIR=/none; ", "machine_fault", "TMPDIR: /none: no folder can be made"},
        {"space", "", "skipped", "2 components per contact (allowed by the program: 3)"}}) {
    const std::string own = name;
    bench_.run("--external=" + own + ".json --method='EXTERNAL:*' --mesh=Mesh0 --out=of_" + own,
               before);
    const Json record = bench_.record("of_" + own);
    EXPECT_EQ(record["status"], status) << name;
    EXPECT_TRUE(testing::contains(record["status_reason"].get<std::string>(), reason));
  }
}

TEST_F(ExternalCommand, ByDefaultItIsComparedWithHybridAndOnOnesOwnBodyWithP2) {
  write_right();
  declare("airy", "airy", "cp right/* $2");
  std::filesystem::copy_file(testing::mesh_file("Mesh0"), bench_.path("part.msh"));
  for (const std::string mesh : {"Mesh0", "part.msh"}) {
    const auto plan = bench_.expect_ok("--external=airy.json --dry-run --mesh=" + mesh);
    EXPECT_TRUE(testing::contains(plan.out, "/HYBRID "));
    EXPECT_TRUE(testing::contains(plan.out, "/EXTERNAL:airy "));
    EXPECT_EQ(plan.out.find("/P2 ") != std::string::npos, mesh == "part.msh") << plan.out;
    EXPECT_FALSE(testing::contains(plan.out, "3STEPD"));
  }
}

TEST_F(ExternalCommand, ItIsListedAndReplayRefusesIt) {
  write_right();
  declare_honest();
  records_of("", 0);
  EXPECT_TRUE(testing::contains(bench_.run("list --external=airy.json").out, "EXTERNAL:airy"));
  bench_.expect_refusal("replay o:Mesh0/default/EXTERNAL:airy",
                        "o:Mesh0/default/EXTERNAL:airy: EXTERNAL:airy is another program (");
}

TEST_F(ExternalCommand, ResumeTakesNoRecordsOfAnotherVersion) {
  write_right();
  declare("one", "condensed", "cp right/* $2", {{"version", {"echo", "2"}}});
  records_of("", 0);
  EXPECT_EQ(records_of("--resume", 0).size(), 1u);
  declare("one", "condensed", "cp right/* $2", {{"version", {"echo", "3"}}});
  records_of("--resume", 2);
  EXPECT_TRUE(testing::contains(bench_.content("err.txt"), "o/records.jsonl:1: program: another"));
}

TEST_F(ExternalCommand, AnInterruptedRunLeavesNothing) {
  write_right();
  std::filesystem::create_directories(bench_.path("tmp"));
  declare("one", "condensed",
          "sleep 1000 & setsid sleep 1000 & echo $! > orphan; echo $$ > new; mv new pid; wait");
  const testing::EnvironmentVariable folder("TMPDIR", bench_.path("tmp").string());
  testing::BackgroundRun run(bench_,
                             "--external=one.json --method='EXTERNAL:*' --mesh=Mesh0 --out=o");
  testing::wait_for([&] { return std::filesystem::exists(bench_.path("pid")); });
  const int status = run.end(SIGINT);
  EXPECT_TRUE(WIFSIGNALED(status) ? WTERMSIG(status) == SIGINT : WEXITSTATUS(status) == 130);
  for (const char* file : {"pid", "orphan"})
    testing::wait_for([&] { return kill(std::stoi(bench_.content(file)), 0) != 0; });
  testing::wait_for([&] { return std::filesystem::is_empty(bench_.path("tmp")); });
}

TEST_F(ExternalCommand, WhatKillsBothOfItsParentsLeavesNothing) {
  write_right();
  std::filesystem::create_directories(bench_.path("tmp"));
  declare("one", "condensed",
          "(setsid sleep 1000 & echo $! > orphan); "
          "kill -KILL $(cut -d' ' -f4 /proc/$PPID/stat) $PPID; sleep 1000");
  const testing::EnvironmentVariable folder("TMPDIR", bench_.path("tmp").string());
  const auto records = records_of("", 1);
  EXPECT_NE(records.at("one")["status"], "ok");
  EXPECT_TRUE(std::filesystem::is_empty(bench_.path("tmp")));
  EXPECT_FALSE(testing::is_there(std::stoi(bench_.content("orphan"))));
}

// All of a run, as a scheduler does, for longer than the limit.
TEST_F(ExternalCommand, ASuspendedRunIsMeasuredAgain) {
  write_right();
  declare("one", "condensed",
          "echo $PPID >> runs; while ! test -e go; do sleep 0.05; done; cp right/* $2");
  testing::BackgroundRun run(
      bench_,
      "--external=one.json --method='EXTERNAL:*' --mesh=Mesh0 --repetitions=1 --timeout=2 --out=o");
  testing::wait_for([&] { return !bench_.content("runs").empty(); });
  std::vector<pid_t> all = {run.pid()};
  while (all.size() < 4) all.push_back(testing::children_of(all.back()).at(0));
  EXPECT_EQ(all.back(), std::stoi(bench_.content("runs")));
  for (const pid_t process : all) kill(process, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::seconds(5));
  write("go", "");
  for (const pid_t process : all) kill(process, SIGCONT);
  const int status = run.end(0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  const Json record = bench_.record();
  EXPECT_EQ(record["status"], "ok") << record["status_reason"];
  EXPECT_GE(testing::lines_of(bench_.content("runs")).size(), 4u);  // 1 + detail, memory, time
}

TEST_F(ExternalCommand, EveryValueOfAParameterIsAMethod) {
  write_right();
  const std::string script =
      "cp right/* $2; [ $3 = 7 ] || printf %s "
      "'{\"status\": \"not_converged\", \"time_s\": 0, \"message\": \"'$3'\"}' > $2/answer.json";
  declare("many", "condensed", script,
          {{"parameter", {{"stiffness", {7, 2.5, 1234567}}}},
           {"command", {"sh", "-c", script, "sh", "{input}", "{output}", "{stiffness}"}}});
  const auto records = records_of("", 1);
  ASSERT_EQ(records.size(), 3u);
  EXPECT_EQ(records.at("many")["status"], "ok");
  for (const std::string value : {"2.5", "1234567"})
    EXPECT_EQ(records.at("many:stiffness=" + value)["status_reason"], value);
  const auto chosen = bench_.expect_ok(
      "--external=many.json --method=EXTERNAL:many:stiffness=2.5 --mesh=Mesh0 --dry-run");
  EXPECT_TRUE(testing::contains(chosen.out, "EXTERNAL:many:stiffness=2.5"));
  EXPECT_FALSE(testing::contains(chosen.out, "1234567"));
}

}  // namespace
}  // namespace airybench::external_command_test
