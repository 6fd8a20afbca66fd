// Solves a frictional contact problem in FCLIB's format with Siconos:
//
//   siconos nsgs|cpg|lemke INPUT OUTPUT TOLERANCE   |   siconos --version
//
// nsgs takes problems in the plane and in space, cpg and lemke in the plane.
//
//   u = W r + q,  r_n ≥ 0,  u_n ≥ 0,  r_n u_n = 0,  |r_t| ≤ μ r_n,  r_t against u_t when it slips
//
// Status and error_estimate are Siconos' own, unchecked. Its error is ‖r − P(r − û)‖ / max(‖r‖,
// ‖u‖, ‖q‖) with û_n = u_n + μ |u_t|.
#include <FrictionContactProblem.h>
#include <Friction_cst.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <hdf5.h>

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

// CPG and Lemke need full columns.
std::vector<double> dense(hid_t file, int size) {
  const auto p = read<int>(file, "W/p"), column = read<int>(file, "W/i");
  const auto x = read<double>(file, "W/x");
  std::vector<double> W(std::size_t(size) * size);
  for (int row = 0; row < size; ++row)
    for (int k = p[row]; k < p[row + 1]; ++k) W[std::size_t(column[k]) * size + row] += x[k];
  return W;
}

int main(int count, char** words) {
  if (count == 2 && words[1] == std::string("--version"))
    return std::puts("Siconos " SICONOS_VERSION) < 0;
  if (count != 5) return 2;
  const std::map<std::string, int> in_plane = {{"nsgs", SICONOS_FRICTION_2D_NSGS},
                                               {"cpg", SICONOS_FRICTION_2D_CPG},
                                               {"lemke", SICONOS_FRICTION_2D_LEMKE}};
  const std::map<std::string, int> in_space = {{"nsgs", SICONOS_FRICTION_3D_NSGS}};
  const std::string method = words[1], input = words[2], output = words[3];

  const hid_t file = H5Fopen((input + "/problem.hdf5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const int dimension = read<int>(file, "spacedim").front();
  const auto& solvers = dimension == 2 ? in_plane : in_space;
  if (!solvers.contains(method)) {
    std::ofstream(output + "/answer.json")
        << R"({"status": "breakdown", "message": "Siconos' )" << method
        << R"( takes problems in the plane only", "time_s": 0})"
           "\n";
    return 0;
  }
  auto q = read<double>(file, "vectors/q"), mu = read<double>(file, "vectors/mu");
  const int size = static_cast<int>(q.size());
  auto values = dense(file, size);
  H5Fclose(file);
  std::vector<double> r(size), u(size);
  NumericsMatrix* W = NM_create_from_data(NM_DENSE, size, size, values.data());
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
  for (const double value : r) vector << std::setprecision(17) << value << '\n';
  vector.close();
  const double residual = options->dparam[SICONOS_DPARAM_RESIDU];
  std::ofstream answer(output + "/answer.json");
  answer << std::setprecision(17) << R"({"status": ")" << (info == 0 ? "ok" : "not_converged")
         << R"(", "message": "info = )" << info << ", residual " << residual << R"(", "time_s": )"
         << time.count() << R"(, "stages": {"contact": )" << time.count()
         << R"(}, "contact_iterations": )" << options->iparam[SICONOS_IPARAM_ITER_DONE];
  if (std::isfinite(residual)) answer << R"(, "error_estimate": )" << residual;
  answer << R"(, "parameters": "tolerance )" << words[4] << "\"}\n";
}
