#include "bench/problems/fclib.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "solvers/contact/compliance.hpp"
#include "solvers/contact/condensed.hpp"
#include "support/hdf5_handle.hpp"

namespace airybench {
namespace {

void check(herr_t result) {
  if (result < 0) throw std::runtime_error("HDF5: something cannot be written");
}

// No times, so that the same problem gives the same file.
void write(hid_t place, const std::string& name, hid_t type, const Handle& space,
           const void* values) {
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  check(H5Pset_obj_track_times(creation, false));
  const Handle set(H5Dcreate2(place, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT),
                   H5Dclose);
  check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
}

Handle space_of(const std::vector<hsize_t>& shape) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
}

void write(hid_t place, const std::string& name, const std::vector<int>& values) {
  write(place, name, H5T_NATIVE_INT, space_of({values.size()}), values.data());
}
void write(hid_t place, const std::string& name, int value) {
  write(place, name, std::vector<int>{value});
}
void write(hid_t place, const std::string& name, const Eigen::VectorXd& values) {
  write(place, name, H5T_NATIVE_DOUBLE, space_of({static_cast<hsize_t>(values.size())}),
        values.data());
}
void write(hid_t place, const std::string& name, const std::string& text) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  check(H5Tset_size(type, text.size() + 1));
  write(place, name, type, Handle(H5Screate(H5S_SCALAR), H5Sclose), text.c_str());
}

Handle group(hid_t place, const char* name) {
  return {H5Gcreate2(place, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose};
}

void write_array(hid_t place, const ProblemArray& array) {
  std::vector<hsize_t> shape = {static_cast<hsize_t>(array.rows())};
  if (!array.is_vector()) shape.push_back(static_cast<hsize_t>(array.columns()));
  const Handle space = space_of(shape);
  const auto write_rows = [&]<typename Scalar>(const Eigen::MatrixX<Scalar>& values, hid_t type) {
    using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Rows by_rows = values;
    write(place, array.name, type, space, by_rows.data());
  };
  if (const auto* whole = std::get_if<Eigen::MatrixXi>(&array.values))
    write_rows(*whole, H5T_NATIVE_INT);
  else
    write_rows(std::get<Eigen::MatrixXd>(array.values), H5T_NATIVE_DOUBLE);
}

void write_matrix(hid_t place, const SparseRows& W) {
  const Handle matrix = group(place, "W");
  constexpr int compressed_rows = -2;
  const auto entries = static_cast<std::size_t>(W.nonZeros());
  write(matrix, "m", static_cast<int>(W.rows()));
  write(matrix, "n", static_cast<int>(W.cols()));
  write(matrix, "nzmax", static_cast<int>(W.nonZeros()));
  write(matrix, "nz", compressed_rows);
  write(matrix, "p", std::vector<int>(W.outerIndexPtr(), W.outerIndexPtr() + W.rows() + 1));
  write(matrix, "i", std::vector<int>(W.innerIndexPtr(), W.innerIndexPtr() + entries));
  write(matrix, "x",
        Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(W.valuePtr(), W.nonZeros())));
}

// All entries, also zeros.
SparseRows rows_of(const Eigen::MatrixXd& dense) {
  SparseRows rows(dense.rows(), dense.cols());
  rows.reserve(Eigen::VectorXi::Constant(dense.rows(), static_cast<int>(dense.cols())));
  for (Eigen::Index i = 0; i < dense.rows(); ++i)
    for (Eigen::Index j = 0; j < dense.cols(); ++j) rows.insert(i, j) = dense(i, j);
  rows.makeCompressed();
  return rows;
}

// Adds the tangential components: zero in a vector, the identity in a matrix.
Eigen::VectorXd with_tangents(const ContactPoints& contact, const Eigen::VectorXd& vector) {
  if (contact.components > 1) return vector;
  Eigen::VectorXd both = Eigen::VectorXd::Zero(2 * contact.count);
  both(Eigen::seqN(0, contact.count, 2)) = vector;
  return both;
}
Eigen::MatrixXd with_tangents(const ContactPoints& contact, const Eigen::MatrixXd& matrix) {
  if (contact.components > 1) return matrix;
  Eigen::MatrixXd both = Eigen::MatrixXd::Identity(2 * contact.count, 2 * contact.count);
  const auto normal = Eigen::seqN(0, contact.count, 2);
  both(normal, normal) = matrix;
  return both;
}

void write_problem(hid_t file, const contact::Problem& problem, const Eigen::VectorXd& answer,
                   double s, const std::string& title) {
  const ContactPoints& points = problem.points;
  const Handle local = group(file, "fclib_local");
  write(local, "spacedim", std::max(2, points.components));
  const SparseRows W = problem.is_dense()
                           ? rows_of(with_tangents(points, Eigen::MatrixXd(s * problem.D)))
                           : SparseRows(s * problem.rows);
  write_matrix(local, W);
  const Eigen::VectorXd q = s * contact_offset(problem);
  {
    const Handle vectors = group(local, "vectors");
    write(vectors, "q", with_tangents(points, q));
    Eigen::VectorXd mu(points.count);
    for (int p = 0; p < points.count; ++p) mu(p) = points.friction_at(p);
    write(vectors, "mu", mu);
  }
  {
    const Handle info = group(local, "info");
    write(info, "title", title);
    write(info, "description",
          std::string("plane elasticity with dry friction, condensed to the contact points; "
                      "normal first"));
    write(info, "math_info",
          fmt::format("W = s D, q = s (G + gap), r = -F_C in N, u = -s (u_C - gap), s = {} N/mm; "
                      "W symmetric positive definite",
                      s));
  }
  if (answer.size() == 0) return;
  const Handle solution = group(file, "solution");
  const Eigen::VectorXd r = with_tangents(points, Eigen::VectorXd(-answer));
  write(solution, "r", r);
  write(solution, "u", Eigen::VectorXd(W * r + with_tangents(points, q)));
}

std::string image_of(hid_t file) {
  check(H5Fflush(file, H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size <= 0) throw std::runtime_error("HDF5: no image of the file");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) != size)
    throw std::runtime_error("HDF5: no image of the file");
  return bytes;
}

}  // namespace

std::string fclib_file(const contact::Problem& problem, const Eigen::VectorXd& answer,
                       const std::vector<ProblemArray>& arrays, const std::string& title) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // no messages from libhdf5
  const double s = 1 / D_diagonal(problem).mean();
  const Handle in_memory(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  constexpr std::size_t growth_bytes = 1 << 20;
  check(H5Pset_fapl_core(in_memory, growth_bytes, false));
  const Handle file(H5Fcreate("fclib", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory), H5Fclose);
  write_problem(file, problem, answer, s, title);
  {
    const Handle ours = group(file, "airybench");
    write(ours, "scale_N_per_mm", Eigen::VectorXd::Constant(1, s));
    for (const ProblemArray& array : arrays)
      if (array.name != "D") write_array(ours, array);
  }
  return image_of(file);
}

}  // namespace airybench
