// The table of named methods: the only place that knows all of them.
//
// A new method is one file in methods/ and one line in methods.cpp; it then appears in
// `bench list`, the runs, the tests and the figures.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solvers/base/method.hpp"

namespace airybench {

// Those of the paper and their kin first. A method may stand there twice, under an alias and under
// its general name.
const std::vector<Method>& methods();

// What solves contact problems that come without a body; it is not in the table.
Method condensed_contact();

// The methods that a comma-separated list selects: names of the table and globs, in the table's
// order and none twice; then general names that are not in the table, as they come:
//   3STEPCG:<preconditioner>[,refine=yes]
//   SYMMLQ:<preconditioner>[,refine=yes]
//   ALM:r=<r>,rho=<rho>
//   HYBRID:k=<degree>, and of HYBRID:CHOLMOD, HYBRID:MUMPS, HYBRID:PDAS: HYBRID:MUMPS,k=<degree>
// others: stand behind the table's. degree: of the stresses of these, unless a name states its own
// ("HYBRID:k=1"). Throws std::invalid_argument: one line with the item that matches nothing and
// what is valid.
std::vector<Method> select_methods(std::string_view selection,
                                   const std::vector<Method>& others = {}, int degree = 1);

// Commas part the items, but for those inside a general name: "ALM:r=20,rho=32" is one.
std::vector<std::string> split_method_list(std::string_view list);

// "HYBRID", "HYBRID:k=2", …, up to the highest degree of stresses.
std::string hybrid_of_degree(int degree);
extern const int highest_degree;
// "P2", "P3", "P4": of the displacements, whose stresses have one degree less.
std::string displacements_of_degree(int degree);

std::vector<std::string> general_names();  // "HYBRID:k=<degree>", as messages and lists have them
// Whether a name is of a family: "SYMMLQ:…", not "3STEPD:FILE".
bool is_general_name(const std::string& name);

}  // namespace airybench
