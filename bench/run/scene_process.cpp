#include "bench/run/scene_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <sstream>
#include <system_error>

#include "bench/measure/environment.hpp"
#include "bench/measure/heap_probe.hpp"
#include "bench/plan/blank_record.hpp"
#include "bench/records/json.hpp"
#include "support/atomic_file.hpp"
#include "support/text_table.hpp"

namespace airybench {
namespace {

struct Command {
  std::string verb;
  std::size_t k = 0;
};

Command command_of(const std::string& line) {
  Command command;
  std::istringstream(line) >> command.verb >> command.k;
  return command;
}

std::filesystem::path fields_of(const Case& c, const Options& options) {
  if (!options.fields) return {};
  return options.out / "fields" / c.name().file();
}

// programs/CASE.txt: what another's program said of itself.
void keep_log(const Case& c, const Options& options, const std::string& log) {
  if (log.empty()) return;
  make_folder(options.out / "programs");
  write_file_atomically(options.out / "programs" / (c.name().file() + ".txt"), log);
}

// The case's own process.
void serve_case(Channel& channel, const Case& c, const Options& options, Workbench& bench,
                const ActivityBoard& board) {
  set_threads(c.knob.threads.value_or(options.threads));
  const heap::Backstop backstop(options.memory_limit_bytes);
  Record record;
  Workbench::Choice choice;
  while (const auto line = channel.receive()) {
    if (command_of(*line).verb == "examine") {
      try {
        auto examination = bench.examine(c.method, fields_of(c, options));
        record = std::move(examination.record);
        choice = std::move(examination.choice);
        keep_log(c, options, bench.program_log());
      } catch (const FileError& error) {  // of a field or a log
        record = blank_record(c, options);
        record.status = Status::machine_fault;
        record.status_reason = error.what();
      }
      identify(c, record);
      if (is_measured(record) && !record.measured_once)
        bench.measure_memory(c.method, choice, record);
      record.runs_s = board.seconds_in_runs();
      channel.send(json_text(to_json(record)));
    } else {
      TimedRun run = bench.measure_time(c.method, choice);
      run.runs_s = board.seconds_in_runs();
      channel.send(json_text(to_json(run)));
    }
  }
}

// What an activity may take, before the grace.
double limit_s(const ActivityBoard& board, const Options& options) {
  constexpr double least_for_others_s = 900;
  return is_run(board.activity()) ? run_limit_s(board.activity(), options)
                                  : std::max(options.timeout_s, least_for_others_s);
}

struct CaseProcess {
  ActivityBoard board;
  std::unique_ptr<ChildProcess> process;
};

}  // namespace

bool is_overdue(const ActivityBoard& board, const Options& options) {
  return board.seconds() > 1.1 * limit_s(board, options) + 2;
}

TimedRun obituary_of(const ChildEnd& end, const ActivityBoard& board, const Options& options) {
  TimedRun run;
  run.ended_in = board.where();
  run.time_s = board.seconds();
  run.runs_s = board.seconds_in_runs();
  const std::string place = fmt::format("in {} after {}", run.ended_in, show_seconds(run.time_s));
  if (end.stopped) {
    run.status = Status::machine_fault;
    run.message = fmt::format("its process was stopped by somebody {}, and ended", place);
  } else if (end.given_up) {
    run.status = Status::timeout;
    run.message =
        fmt::format("its process was ended {}: the limit is {} s", place, limit_s(board, options));
  } else if (end.exit_code == heap::backstop_exit_code) {
    run.status = Status::out_of_memory;
    run.message = fmt::format("its process was ended {}: it passed the memory limit", place);
  } else if (end.exit_code == no_memory_exit_code) {
    run.status = is_run(board.activity()) ? Status::out_of_memory : Status::machine_fault;
    run.message = fmt::format("its process was ended {}: there was no memory", place);
  } else if ((end.signal == SIGKILL || end.signal == SIGXCPU) && end.used_up_processor_time) {
    run.status = Status::machine_fault;
    run.signal = signal_name(end.signal);
    run.message =
        fmt::format("its process was ended {} by {}: the limit on processor time (ulimit -t)",
                    place, run.signal);
  } else if (end.signal != 0) {
    run.signal = signal_name(end.signal);
    const char* who = "";
    if (end.signal == SIGKILL && !end.lingered) {
      const bool by_somebody = end.oom_killed == false;
      run.status = by_somebody ? Status::machine_fault : Status::out_of_memory;
      who = by_somebody      ? ", not of the kernel for lack of memory"
            : end.oom_killed ? " of the kernel for lack of memory"
                             : ", as the kernel does when memory runs out";
    }
    run.message = fmt::format("its process was ended {} by {}{}", place, run.signal, who);
  } else {
    run.message = fmt::format("its process ended {} with exit code {}", place, end.exit_code);
  }
  return run;
}

void serve_scene(Channel& channel, const std::vector<const Case*>& cases, const Options& options,
                 ActivityBoard& board, const LeftOut& left_out) {
  set_threads(1);  // OpenMP's threads would not be there in the cases' processes
  Workbench bench(cases.front()->posed.problem, options, left_out);
  bench.show_on(&board);
  std::map<std::size_t, CaseProcess> processes;
  while (const auto line = channel.receive()) {
    const auto [verb, k] = command_of(*line);
    const Case& c = *cases[k];
    if (verb == "prepare") {
      bench.prepare(c.method);
      channel.send("{}");
      continue;
    }
    if (verb == "end") {
      processes.erase(k);
      channel.send("{}");
      continue;
    }
    CaseProcess& own = processes[k];
    TimedRun last;
    try {
      if (own.process == nullptr)
        own.process = std::make_unique<ChildProcess>([&](Channel& to_scene) {
          bench.show_on(&own.board);
          const ObservedStages observed(&own.board);
          serve_case(to_scene, c, options, bench, own.board);
        });
      const auto answer = own.process->ask(*line, [&] {
        board.beat();
        return is_overdue(own.board, options);
      });
      if (answer) {
        channel.send(*answer);
        continue;
      }
      last = obituary_of(own.process->end(), own.board, options);
    } catch (const std::system_error& error) {  // no process to be had
      last.status = Status::machine_fault;
      last.message = error.what();
    }
    if (verb != "examine") {
      channel.send(json_text(to_json(last)));
      continue;
    }
    Record record = blank_record(c, options);
    record.status = last.status;
    record.status_reason = last.message;
    record.signal = last.signal;
    record.ended_in = last.ended_in;
    record.time_so_far_s = last.time_s;
    record.runs_s = last.runs_s;
    channel.send(json_text(to_json(record)));
  }
}

}  // namespace airybench
