// The name of a case in output, options, file names and comparisons:
//
//   MESH/SCENE/METHOD[/study=STUDY][/KNOB=VALUE][/stop=paper][/contact=SOLVER]
//
//   Mesh0/default/3STEPD
//   Mesh3/default/ALM/stop=paper
//   Mesh0/default/SSKY/study=error/tolerance=0.01
//
// Parts in brackets are omitted if they are the default. Record::case_name is the text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "support/status.hpp"

namespace airybench {

inline constexpr std::string_view sweeps_knob = "contact sweeps";

struct CaseName {
  std::string mesh, scene, method;
  std::string study, knob;           // may be empty
  std::optional<double> knob_value;  // empty: the knob is not changed
  Stop stop = Stop::target;
  std::optional<ContactSolver> contact;  // unless implied_contact_solver()

  std::string text() const;
  std::string suffix() const;  // after the method: "/study=error/tolerance=0.01"
  // One-to-one, for file names: "--" for '/', '+' for ':', '~' for '+', and escapes such as "%25".
  std::string file() const;
};

// Gauss–Seidel with the paper's stop or a knob that counts sweeps, else Newton.
ContactSolver implied_contact_solver(Stop stop, std::string_view knob);
std::optional<ContactSolver> unless_implied(std::optional<ContactSolver> solver, Stop stop,
                                            std::string_view knob);

// UTF-8 without '/' and control characters, not empty.
bool is_name(std::string_view text);

std::optional<CaseName> case_name_of(std::string_view text);

}  // namespace airybench
