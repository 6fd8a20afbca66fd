// Solves a frictional contact problem in FCLIB's format with Siconos:
//
//   siconos nsgs|cpg|lemke|nsn_ac|admm INPUT OUTPUT TOLERANCE   |   siconos --version
//
// nsgs takes problems in the plane and in space, cpg and lemke in the plane, nsn_ac and admm in
// space. Of a W with few entries nsgs has in space the blocks, nsn_ac and admm the sparse matrix.
//
//   u = W r + q,  r_n ≥ 0,  u_n ≥ 0,  r_n u_n = 0,  |r_t| ≤ μ r_n,  r_t against u_t when it slips
//
// Status and error_estimate are Siconos' own, unchecked, but for Lemke's status: the version in
// Debian always has info = 0 there, and its pivots may be what rounding left of a zero. A pivoting
// method has no tolerance to reach; above 1e-8 the pivots went wrong. Siconos' error is ‖r − P(r −
// û)‖ / max(‖r‖, ‖u‖, ‖q‖) with û_n = u_n + μ |u_t|.
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <NumericsSparseMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <hdf5.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>
#include <string>
#include <vector>

template <typename Value>
std::vector<Value> read(hid_t file, const std::string& name) {
  const hid_t set = H5Dopen2(file, ("/fclib_local/" + name).c_str(), H5P_DEFAULT);
  const hid_t space = H5Dget_space(set);
  const hid_t type = std::is_integral_v<Value> ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE;
  std::vector<Value> values(H5Sget_simple_extent_npoints(space));
  if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0) std::exit(1);
  H5Sclose(space);
  H5Dclose(set);
  return values;
}

struct Rows {
  std::vector<int> start, column;
  std::vector<double> value;
  int size() const { return static_cast<int>(start.size()) - 1; }
  bool is_sparse() const {
    constexpr std::size_t small = 300, many = 8;
    const std::size_t n = start.size() - 1;
    return n > small && value.size() * many < n * n;
  }
};

// CPG and Lemke need full columns.
NumericsMatrix* dense(const Rows& W, std::vector<double>& columns) {
  const int n = W.size();
  columns.assign(std::size_t(n) * n, 0.0);
  for (int row = 0; row < n; ++row)
    for (int k = W.start[row]; k < W.start[row + 1]; ++k)
      columns[std::size_t(W.column[k]) * n + row] += W.value[k];
  return NM_create_from_data(NM_DENSE, n, n, columns.data());
}

NumericsMatrix* sparse(const Rows& W) {
  const int n = W.size();
  NumericsMatrix* matrix = NM_create(NM_SPARSE, n, n);
  NM_triplet_alloc(matrix, static_cast<CS_INT>(W.value.size()));
  matrix->matrix2->origin = NSM_TRIPLET;
  for (int row = 0; row < n; ++row)
    for (int k = W.start[row]; k < W.start[row + 1]; ++k)
      NM_entry(matrix, row, W.column[k], W.value[k]);
  return matrix;
}

NumericsMatrix* blocks(const Rows& W) {
  NumericsMatrix* of = NM_create(NM_SPARSE_BLOCK, W.size(), W.size());
  SBM_from_csparse(3, NM_csc(sparse(W)), of->matrix1);
  return of;
}

// Siconos' linear complementarity problem (fc2d_tolcp) takes the μ of the row's contact where the
// column's belongs. In r = S r', u' = S u, S = diag(1, μ_i / max μ), all contacts have one μ.
// Returns S's tangential entries.
std::vector<double> make_friction_one(Rows& W, std::vector<double>& q, std::vector<double>& mu) {
  const double largest = *std::max_element(mu.begin(), mu.end());
  std::vector<double> scale(q.size(), 1.0);
  if (*std::min_element(mu.begin(), mu.end()) == largest) return scale;
  for (std::size_t i = 0; i < mu.size(); ++i) scale[2 * i + 1] = mu[i] / largest;
  for (int row = 0; row < W.size(); ++row) {
    q[row] *= scale[row];
    for (int k = W.start[row]; k < W.start[row + 1]; ++k)
      W.value[k] *= scale[row] * scale[W.column[k]];
  }
  mu.assign(mu.size(), largest);
  return scale;
}

int main(int count, char** words) {
  if (count == 2 && words[1] == std::string("--version"))
    return std::puts("Siconos " SICONOS_VERSION) < 0;
  if (count != 5) return 2;
  const std::map<std::string, int> in_plane = {{"nsgs", SICONOS_FRICTION_2D_NSGS},
                                               {"cpg", SICONOS_FRICTION_2D_CPG},
                                               {"lemke", SICONOS_FRICTION_2D_LEMKE}};
  const std::map<std::string, int> in_space = {{"nsgs", SICONOS_FRICTION_3D_NSGS},
                                               {"nsn_ac", SICONOS_FRICTION_3D_NSN_AC},
                                               {"admm", SICONOS_FRICTION_3D_ADMM}};
  const std::string method = words[1], input = words[2], output = words[3];

  const hid_t file = H5Fopen((input + "/problem.hdf5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const int dimension = read<int>(file, "spacedim").front();
  const auto& solvers = dimension == 2 ? in_plane : in_space;
  if (!solvers.contains(method)) return 2;  // the declaration's "components" exclude it
  auto q = read<double>(file, "vectors/q"), mu = read<double>(file, "vectors/mu");
  const int size = static_cast<int>(q.size());
  Rows rows = {read<int>(file, "W/p"), read<int>(file, "W/i"), read<double>(file, "W/x")};
  H5Fclose(file);
  const std::vector<double> scale =
      method == "lemke" ? make_friction_one(rows, q, mu) : std::vector<double>(size, 1.0);
  std::vector<double> r(size), u(size);
  std::vector<double> columns;
  NumericsMatrix* W = dimension == 2 || !rows.is_sparse() ? dense(rows, columns)
                      : method == "nsgs"                  ? blocks(rows)
                                                          : sparse(rows);
  FrictionContactProblem* problem =
      frictionContactProblem_new_with_data(dimension, size / dimension, W, q.data(), mu.data());
  SolverOptions* options = solver_options_create(solvers.at(method));
  options->dparam[SICONOS_DPARAM_TOL] = std::stod(words[4]);
  options->iparam[SICONOS_IPARAM_MAX_ITER] = 1'000'000;

  const auto start = std::chrono::steady_clock::now();
  const int info = dimension == 2 ? fc2d_driver(problem, r.data(), u.data(), options)
                                  : fc3d_driver(problem, r.data(), u.data(), options);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;

  std::ofstream vector(output + "/r.mtx");
  vector << "%%MatrixMarket matrix array real general\n" << size << " 1\n";
  for (int k = 0; k < size; ++k) vector << std::setprecision(17) << scale[k] * r[k] << '\n';
  vector.close();
  const double residual = options->dparam[SICONOS_DPARAM_RESIDU];
  constexpr double max_of_pivots = 1e-8;
  const bool solved = info == 0 && (method != "lemke" || residual <= max_of_pivots);
  std::ofstream answer(output + "/answer.json");
  answer << std::setprecision(17) << R"({"status": ")" << (solved ? "ok" : "not_converged")
         << R"(", "message": "info = )" << info << ", residual " << residual << R"(", "time_s": )"
         << time.count() << R"(, "stages": {"contact": )" << time.count()
         << R"(}, "contact_iterations": )" << options->iparam[SICONOS_IPARAM_ITER_DONE];
  if (std::isfinite(residual)) answer << R"(, "error_estimate": )" << residual;
  answer << R"(, "parameters": "tolerance )" << words[4] << "\"}\n";
}
