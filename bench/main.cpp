#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "bench/commands/commands.hpp"
#include "bench/commands/former_options.hpp"
#include "bench/commands/run_parts.hpp"
#include "bench/run/isolated_scene.hpp"
#include "bench/run/runner.hpp"
#include "bench/run/threads_at_hand.hpp"
#include "solvers/base/blas_library.hpp"
#include "support/errors.hpp"
#include "support/lists.hpp"
#include "support/messages.hpp"
#include "support/this_process.hpp"

namespace {

void refuse_misspelt_command(const std::string& word) {
  std::vector<std::string> names;
  for (const airybench::Command& command : airybench::all_commands())
    names.emplace_back(command.name);
  if (const std::string meant = airybench::perhaps(word, names);
      !meant.empty() && !word.starts_with('-'))
    throw airybench::UsageError(
        fmt::format("{}: no such command{} (allowed: {})", word, meant, fmt::join(names, ", ")));
}

// If standard error is full, the exit code reports it.
int complain(const std::string& what, int exit_code) {
  std::fprintf(stderr, "bench: %s\n", airybench::one_line(what).c_str());
  return exit_code;
}

// What the machine refused.
std::string refusal_of(const std::system_error& error) {
  const auto* const of_file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  if (of_file == nullptr) return error.what();
  return fmt::format("{}: {}", of_file->path1().string(), error.code().message());
}

int run(int argc, char** argv) {
  bool has_resume = false;
  try {
    airybench::restart_without_benchmark_variables(argv);
    airybench::restart_with_better_blas_core(argv);
    const std::vector<std::string> words = airybench::with_command({argv, argv + argc});
    std::vector<const char*> now;
    for (const std::string& word : words) now.push_back(word.c_str());
    const int count = static_cast<int>(now.size());
    if (count > 1) {
      const auto commands = airybench::all_commands();
      const auto found =
          std::ranges::find(commands, std::string_view(now[1]), &airybench::Command::name);
      if (found != commands.end()) return found->run(count - 1, now.data() + 1);
      airybench::refuse_former_command(now[1]);
      refuse_misspelt_command(now[1]);
    }
    has_resume = true;
    return airybench::run_command(count, now.data());
  } catch (const airybench::HelpRequested& help) {
    std::fputs(help.what(), stdout);
    return airybench::all_ok;
  } catch (const airybench::Interrupted& interrupted) {
    return complain(
        fmt::format("{}{}", interrupted.what(),
                    has_resume
                        ? ": what was measured by then is in the output folder; --resume goes on"
                        : ""),
        128 + interrupted.signal);
  } catch (const airybench::InputError& error) {
    return complain(error.what(), airybench::wrong_usage);
  } catch (const std::invalid_argument& error) {
    return complain(error.what(), airybench::wrong_usage);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", airybench::did_not_finish);
  } catch (const std::system_error& error) {
    if (std::ferror(stdout) != 0 || std::ferror(stderr) != 0)  // fmt throws on a failed write
      return airybench::wrong_usage;
    return complain(refusal_of(error), airybench::wrong_usage);
  } catch (const std::exception& error) {
    return complain(fmt::format("a defect of this program: {}", error.what()),
                    airybench::did_not_finish);
  }
}

// Sanitizers start later than this, and reserve more address space than any limit allows.
#ifndef AIRYBENCH_SANITIZED
[[gnu::section(".preinit_array"),
  gnu::used]] void (*before_libraries)(int, char**,
                                       char**) = airybench::end_for_lack_of_address_space;
#endif

}  // namespace

int main(int argc, char** argv) {
  airybench::open_standard_streams();
  airybench::end_for_lack_of_memory_with("bench: out of memory\n", airybench::did_not_finish);
  airybench::show_messages_escaped();
  if (airybench::is_drawn_by_caller()) airybench::interrupt_with_caller();  // who waits for it
  for (const std::string& lack :
       {airybench::lack_of_stack_or_descriptors(), airybench::lack_of_address_space(1)})
    if (!lack.empty())
      std::_Exit(complain(lack, airybench::wrong_usage));  // std::exit() would wait for BLAS
  return airybench::checked_exit_code(run(argc, argv), "bench");
}
