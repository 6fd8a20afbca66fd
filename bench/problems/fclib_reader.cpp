#include "bench/problems/fclib.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/problems/hdf5_handle.hpp"
#include "support/errors.hpp"

namespace airybench {
namespace {

constexpr int most_rows = 20000;  // a dense W of 3.2 GB

class FclibFile {
 public:
  explicit FclibFile(const std::filesystem::path& path) : path_(path.string()) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // no messages from libhdf5
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      throw FileError(path_ + ": cannot be opened: no such file");
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0) throw FileError(path_ + ": cannot be opened (allowed: an HDF5 file)");
  }
  ~FclibFile() { H5Fclose(file_); }
  FclibFile(const FclibFile&) = delete;
  FclibFile& operator=(const FclibFile&) = delete;

  [[noreturn]] void fail(const std::string& place, const std::string& what,
                         const std::string& allowed) const {
    throw FileError(fmt::format("{}: {}: {} (allowed: {})", path_, place, what, allowed));
  }
  // H5Lexists() fails unless every group on the path exists.
  bool has(const std::string& name) const {
    for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
      if (H5Lexists(file_, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
      if (slash == name.npos) return true;
    }
  }
  std::vector<int> wholes(const std::string& name, int count) const {
    std::vector<int> values(static_cast<std::size_t>(count));
    read(name, H5T_INTEGER, "whole numbers", H5T_NATIVE_INT, count, values.data());
    return values;
  }
  int whole(const std::string& name, int least, int most) const {
    const int value = wholes(name, 1).front();
    if (value < least || value > most)
      fail(name, std::to_string(value),
           least == most ? std::to_string(least)
                         : fmt::format("a whole number from {} to {}", least, most));
    return value;
  }
  Eigen::VectorXd numbers(const std::string& name, int count) const {
    Eigen::VectorXd values(count);
    read(name, H5T_FLOAT, "numbers", H5T_NATIVE_DOUBLE, count, values.data());
    for (int i = 0; i < count; ++i)
      if (!std::isfinite(values(i)))
        fail(name, fmt::format("[{}] is {}", i, values(i)), "finite numbers");
    return values;
  }
  // Empty if there is none, or it is of variable length.
  std::string text(const std::string& name) const {
    if (!has(name)) return {};
    const hid_t opened = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (opened < 0) return {};
    const Handle set(opened, H5Dclose), type(H5Dget_type(set), H5Tclose);
    const Handle space(H5Dget_space(set), H5Sclose);
    constexpr std::size_t most_bytes = 1000;
    const std::size_t size = H5Tget_size(type);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || size > most_bytes ||
        H5Sget_simple_extent_npoints(space) != 1)
      return {};
    std::string value(size, '\0');
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) return {};
    return value.c_str();
  }

 private:
  void read(const std::string& name, H5T_class_t kind, const char* what, hid_t type, int count,
            void* values) const {
    const std::string allowed = fmt::format("{} {}", count, what);
    if (!has(name)) fail(name, "is missing", allowed);
    const hid_t opened = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (opened < 0) fail(name, "is no dataset", allowed);
    const Handle set(opened, H5Dclose);
    const Handle space(H5Dget_space(set), H5Sclose), stored(H5Dget_type(set), H5Tclose);
    const hssize_t there = H5Sget_simple_extent_npoints(space);
    constexpr std::size_t most_bytes = 16;  // per number; libhdf5 accepts any
    if (H5Tget_class(stored) != kind || H5Tget_size(stored) > most_bytes)
      fail(name, "values of another kind", allowed);
    if (there != count) fail(name, fmt::format("{} values", there), allowed);
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      fail(name, "cannot be read", allowed);
  }

  std::string path_;
  hid_t file_ = -1;
};

struct Stored {
  std::vector<int> p;  // starts of rows or columns; for triplets one index per entry
  std::vector<int> i;
  Eigen::VectorXd x;
  enum class Form { rows, columns, triplets } form = Form::rows;
};

void check_indices(const FclibFile& file, const std::string& name, const std::vector<int>& indices,
                   int most) {
  for (std::size_t k = 0; k < indices.size(); ++k)
    if (indices[k] < 0 || indices[k] > most)
      file.fail(name, fmt::format("[{}] is {}", k, indices[k]), fmt::format("0 to {}", most));
}

Stored read_entries(const FclibFile& file, const std::string& place, int m) {
  constexpr int compressed_rows = -2;
  using enum Stored::Form;
  const int room = file.whole(place + "nzmax", 1, m * m);
  const int nz = file.whole(place + "nz", compressed_rows, room);
  Stored stored;
  stored.form = nz >= 0 ? triplets : nz == compressed_rows ? rows : columns;
  stored.p = file.wholes(place + "p", stored.form == triplets ? room : m + 1);
  stored.i = file.wholes(place + "i", room);
  stored.x = file.numbers(place + "x", room);
  int entries = nz;
  if (stored.form == triplets) {
    stored.p.resize(static_cast<std::size_t>(entries));
    check_indices(file, place + "p", stored.p, m - 1);
  } else {
    if (stored.p.front() != 0 || !std::ranges::is_sorted(stored.p))
      file.fail(place + "p", "does not rise from 0", fmt::format("0 to at most {}", room));
    check_indices(file, place + "p", stored.p, room);
    entries = stored.p.back();
  }
  stored.i.resize(static_cast<std::size_t>(entries));
  check_indices(file, place + "i", stored.i, m - 1);
  return stored;
}

Eigen::MatrixXd read_matrix(const FclibFile& file, const std::string& place) {
  const int m = file.whole(place + "m", 2, most_rows);
  if (m % 2 != 0) file.fail(place + "m", std::to_string(m), "an even number: two per contact");
  file.whole(place + "n", m, m);
  const Stored stored = read_entries(file, place, m);
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(m, m);
  using enum Stored::Form;
  if (stored.form == triplets) {
    for (std::size_t k = 0; k < stored.i.size(); ++k) W(stored.p[k], stored.i[k]) += stored.x(k);
    return W;
  }
  for (int line = 0; line < m; ++line)
    for (int k = stored.p[line]; k < stored.p[line + 1]; ++k)
      (stored.form == rows ? W(line, stored.i[k]) : W(stored.i[k], line)) += stored.x(k);
  return W;
}

void check_law(const FclibFile& file, const contact::Problem& problem) {
  constexpr double rounding = 1e-5;  // some programs write few digits
  const Eigen::VectorXd diagonal = problem.D.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal(i) > 0))
      file.fail("/fclib_local/W", fmt::format("diagonal entry {} is {}", i, diagonal(i)), "> 0");
  const double off = (problem.D - problem.D.transpose()).cwiseAbs().maxCoeff();
  if (off > rounding * diagonal.maxCoeff())
    file.fail("/fclib_local/W", fmt::format("differs from its transpose by {:.3g}", off),
              "a symmetric matrix");
  const std::vector<double>& mu = problem.points.friction;
  for (std::size_t k = 0; k < mu.size(); ++k)
    if (mu[k] < 0)
      file.fail("/fclib_local/vectors/mu", fmt::format("[{}] is {}", k, mu[k]), "at least 0");
}

// Ours are all called problem.hdf5: they are named after their case, "Mesh0-default".
std::string name_of(const FclibFile& file, const std::filesystem::path& path) {
  std::string title;
  if (file.has("/airybench")) title = file.text("/fclib_local/info/title");
  std::ranges::replace(title, '/', '-');
  return title.empty() ? path.stem().string() : title;
}

}  // namespace

contact::Problem read_fclib(const std::filesystem::path& path) {
  const FclibFile file(path);
  const std::string local = "/fclib_local";
  if (!file.has(local))
    file.fail(local,
              file.has("/fclib_global") ? "is missing, there is /fclib_global" : "is missing",
              "a condensed (local) problem");
  file.whole(local + "/spacedim", 2, 2);
  for (const char* name : {"/V", "/R", "/vectors/s"})
    if (file.has(local + name)) file.fail(local + name, "equality constraints", "none");
  contact::Problem problem{.name = name_of(file, path)};
  problem.D = read_matrix(file, local + "/W/");
  const int m = static_cast<int>(problem.D.rows());
  problem.G = file.numbers(local + "/vectors/q", m);
  const Eigen::VectorXd mu = file.numbers(local + "/vectors/mu", m / 2);
  problem.points.count = m / 2;
  problem.points.friction.assign(mu.begin(), mu.end());
  check_law(file, problem);
  return problem;
}

}  // namespace airybench
