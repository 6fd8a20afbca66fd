// What a case is called wherever it is printed, asked for, filed or compared:
//
//   MESH/SCENE/METHOD[/study=STUDY][/KNOB=VALUE][/stop=paper][/contact=SOLVER]
//
//   Mesh0/default/3STEPD
//   Mesh3/default/ALM/stop=paper
//   Mesh3/default/HYBRID/contact=anderson
//   Mesh0/default/SSKY/study=error/tolerance=0.01
//
// The parts in brackets are there where they are not the default. plots/case_names.py is the same.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "support/status.hpp"

namespace airybench {

// The knob of an error study that counts Gauss–Seidel sweeps.
inline constexpr std::string_view sweeps_knob = "contact sweeps";

struct CaseName {
  std::string mesh, scene, method;
  std::string study, knob;           // empty: none
  std::optional<double> knob_value;  // none: the knob is not turned
  Stop stop = Stop::target;
  std::optional<ContactSolver> contact;  // where it is not the implied one

  std::string text() const;
  std::string suffix() const;  // of the method: "/study=error/tolerance=0.01"
  // As a part of a file's name, of each name another: "--" for '/', '+' for ':', and escapes as
  // "%2B" for these themselves.
  std::string file() const;
};

// Newton; with the paper's stop, or where sweeps are counted, Gauss–Seidel.
ContactSolver implied_contact_solver(Stop stop, std::string_view knob);
// For CaseName::contact.
std::optional<ContactSolver> unless_implied(std::optional<ContactSolver> solver, Stop stop,
                                            std::string_view knob);

// Of a mesh, a scene or a method: UTF-8 without '/' and control characters, not empty.
bool is_name(std::string_view text);

// Empty: this is no case's name.
std::optional<CaseName> case_name_of(std::string_view text);

}  // namespace airybench
