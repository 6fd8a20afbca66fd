// Contact problems in the text format of Siconos' tests (.dat), of numbers between blanks:
//
//   d, contacts, W, q, μ        u = W r + q               d: 2 or 3 components per contact
//   d, contacts, M, H, f, w, μ  M v = H r + f, u = Hᵀ v + w
//
// A matrix is its kind, rows and columns, and then
//
//   0  dense   rows, columns, entries by columns
//   1  blocks  blocks, their rows and columns; where each row and each column of blocks ends; how
//              many of the two lists that follow: for each row of blocks the first of its blocks,
//              and the end; for each block its column of blocks. Then every block: its number, its
//              entries by columns
//   2  sparse  as CSparse prints it, with six digits: its storage (1 to 4), a line about CSparse,
//   "m-by-n,
//              nzmax: z nnz: k, …", with "triplet:" or "csr:" before it, and "row column : x", or
//              "col j : locations a to b" before each column's "row : x" (of csr: "row", "column :
//              x")
//
// Nothing says which of both a file is: the second where a matrix of M's rows and W's columns
// follows the first one. Numbers after μ, a guess of r and u, are passed over.
#pragma once

#include <filesystem>

#include "assembly/contact_problem.hpp"

namespace airybench {

// As read_fclib(). Throws FileError: file, line, value, what is allowed.
contact::Problem read_siconos_text(const std::filesystem::path& file);

}  // namespace airybench
