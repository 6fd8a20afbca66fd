#include "bench/problems/fclib.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>

#include "bench/problems/problem_parts.hpp"
#include "support/errors.hpp"
#include "support/hdf5_handle.hpp"
#include "support/process.hpp"
#include "support/seconds_since.hpp"

namespace airybench {
namespace {

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
  Refuse refuse() const {
    return [this](const auto& place, const auto& what, const auto& allowed) {
      fail(place, what, allowed);
    };
  }
  // H5Lexists() fails unless every group on the path exists.
  bool has(const std::string& name) const {
    for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
      const std::string part = name.substr(0, slash);
      if (H5Lexists(file_, part.c_str(), H5P_DEFAULT) <= 0) return false;
      H5L_info_t link;
      if (H5Lget_info(file_, part.c_str(), &link, H5P_DEFAULT) < 0 ||
          (link.type != H5L_TYPE_HARD && link.type != H5L_TYPE_SOFT))
        fail(part, "is a link to another file", "values in this file");
      if (slash == name.npos) return true;
    }
  }
  std::vector<int> wholes(const std::string& name, int count) const {
    std::vector<int> values;
    read(name, H5T_INTEGER, "whole numbers", count, [&](hid_t set) {
      values.resize(static_cast<std::size_t>(count));
      return H5Dread(set, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    });
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
  // Of the values there: `filled` or `room`.
  int count(const std::string& name, int filled, int room) const {
    return has(name) && values_of(name) == filled ? filled : room;
  }
  Eigen::VectorXd numbers(const std::string& name, int count) const {
    Eigen::VectorXd values;
    read(name, H5T_FLOAT, "numbers", count, [&](hid_t set) {
      values.resize(count);
      return H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    });
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
    const Handle set(opened, H5Dclose), type(undamaged(H5Dget_type(set), name), H5Tclose);
    const Handle space(undamaged(H5Dget_space(set), name), H5Sclose);
    constexpr std::size_t max_bytes = 1000;
    const std::size_t size = H5Tget_size(type);
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || size > max_bytes ||
        H5Sget_simple_extent_npoints(space) != 1 || !why_not_here(set, size).empty())
      return {};
    std::string value(size, '\0');
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) return {};
    return value.c_str();
  }

 private:
  hid_t undamaged(hid_t id, const std::string& name) const {
    if (id < 0) fail(name, "is damaged", "an HDF5 file");
    return id;
  }
  hssize_t values_of(const std::string& name) const {
    const hid_t opened = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (opened < 0) return -1;
    const Handle set(opened, H5Dclose), space(undamaged(H5Dget_space(set), name), H5Sclose);
    return H5Sget_simple_extent_npoints(space);
  }
  // Why a dataset has not all its values in this file; empty: it has. bytes: of the values.
  static std::string why_not_here(hid_t set, std::size_t bytes) {
    const Handle made(H5Dget_create_plist(set), H5Pclose);
    if (H5Pget_layout(made) == H5D_VIRTUAL || H5Pget_external_count(made) > 0)
      return "values in other files";
    // deflate makes 1032 bytes of one at most; what is not stored at all reads as a fill value
    constexpr std::size_t max_unpacked = 1100;
    const std::size_t factor = H5Pget_nfilters(made) > 0 ? max_unpacked : 1;
    return H5Dget_storage_size(set) < bytes / factor ? "values that were never written" : "";
  }
  // read_values: of the dataset; it allocates what it needs.
  template <typename ReadValues>
  void read(const std::string& name, H5T_class_t kind, const char* what, int count,
            const ReadValues& read_values) const {
    const std::string allowed = fmt::format("{} {}", count, what);
    if (!has(name)) fail(name, "is missing", allowed);
    const hid_t opened = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (opened < 0) fail(name, "is no dataset", allowed);
    const Handle set(opened, H5Dclose);
    const Handle space(undamaged(H5Dget_space(set), name), H5Sclose),
        stored(undamaged(H5Dget_type(set), name), H5Tclose);
    const hssize_t there = H5Sget_simple_extent_npoints(space);
    constexpr std::size_t max_bytes = 16;  // per number; libhdf5 accepts any
    if (H5Tget_class(stored) != kind || H5Tget_size(stored) > max_bytes)
      fail(name, "values of another kind", allowed);
    if (there != count) fail(name, fmt::format("{} values", there), allowed);
    const std::size_t bytes = static_cast<std::size_t>(count) * H5Tget_size(stored);
    if (const std::string why = why_not_here(set, bytes); !why.empty()) fail(name, why, allowed);
    if (read_values(set) < 0) fail(name, "cannot be read", allowed);
  }

  std::string path_;
  hid_t file_ = -1;
};

void check_indices(const FclibFile& file, const std::string& name, const std::vector<int>& indices,
                   int most) {
  for (std::size_t k = 0; k < indices.size(); ++k)
    if (indices[k] < 0 || indices[k] > most)
      file.fail(name, fmt::format("[{}] is {}", k, indices[k]), fmt::format("0 to {}", most));
}

// In compressed rows (nz = −2), compressed columns (−1) or triplets, columns in p, rows in i, as in
// CSparse. Entries that occur twice are added.
SparseRows read_matrix(const FclibFile& file, const std::string& place, int rows, int columns) {
  constexpr int compressed_rows = -2;
  const auto full = static_cast<std::int64_t>(rows) * columns;
  const int room =
      file.whole(place + "nzmax", 1,
                 static_cast<int>(std::min<std::int64_t>(full, std::numeric_limits<int>::max())));
  const int nz = file.whole(place + "nz", compressed_rows, room);
  const int lines = nz == compressed_rows ? rows : columns;
  const auto room_of = [&](const char* name) {  // programs write nz or nzmax triplets
    return nz >= 0 ? file.count(place + name, nz, room) : room;
  };
  std::vector<int> p = file.wholes(place + "p", nz >= 0 ? room_of("p") : lines + 1);
  std::vector<int> i = file.wholes(place + "i", room_of("i"));
  const Eigen::VectorXd x = file.numbers(place + "x", room_of("x"));
  if (nz >= 0) {
    p.resize(static_cast<std::size_t>(nz));
    check_indices(file, place + "p", p, columns - 1);
  } else {
    if (p.front() != 0 || !std::ranges::is_sorted(p))
      file.fail(place + "p", "does not rise from 0", fmt::format("0 to at most {}", room));
    check_indices(file, place + "p", p, room);
  }
  i.resize(static_cast<std::size_t>(nz >= 0 ? nz : p.back()));
  check_indices(file, place + "i", i, (nz == compressed_rows ? columns : rows) - 1);

  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(i.size());
  if (nz >= 0) {
    for (std::size_t k = 0; k < i.size(); ++k) entries.emplace_back(i[k], p[k], x(k));
  } else {
    for (int line = 0; line < lines; ++line)
      for (int k = p[line]; k < p[line + 1]; ++k)
        if (nz == compressed_rows)
          entries.emplace_back(line, i[k], x(k));
        else
          entries.emplace_back(i[k], line, x(k));
  }
  SparseRows matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Rows of W, columns of H.
int read_size(const FclibFile& file, const std::string& name, int dimension) {
  const int size = file.whole(name, dimension, max_contact_rows);
  check_rows(size, dimension, name, file.refuse());
  return size;
}

ContactPoints read_points(const FclibFile& file, const std::string& place, int dimension,
                          int count) {
  const std::string mu = place + "/vectors/mu";
  return points_of(dimension, file.numbers(mu, count), mu, file.refuse());
}

contact::Problem read_local(const FclibFile& file, const std::string& place, int dimension) {
  const int m = read_size(file, place + "/W/m", dimension);
  file.whole(place + "/W/n", m, m);
  SparseRows W = read_matrix(file, place + "/W/", m, m);
  Eigen::VectorXd q = file.numbers(place + "/vectors/q", m);
  return local_problem(std::move(W), std::move(q),
                       read_points(file, place, dimension, m / dimension), place + "/W",
                       file.refuse());
}

enum class Until { arrays, condensed };

contact::Problem read_global(const FclibFile& file, const std::string& place, int dimension,
                             Until until) {
  GlobalArrays arrays;
  const int n = file.whole(place + "/M/m", 1, max_unknowns);
  file.whole(place + "/M/n", n, n);
  arrays.M = read_matrix(file, place + "/M/", n, n);
  file.whole(place + "/H/m", n, n);
  const int m = read_size(file, place + "/H/n", dimension);
  arrays.H = read_matrix(file, place + "/H/", n, m);
  arrays.f = file.numbers(place + "/vectors/f", n);
  arrays.w = file.numbers(place + "/vectors/w", m);
  ContactPoints points = read_points(file, place, dimension, m / dimension);
  if (until == Until::arrays) return {};
  return global_problem(std::move(arrays), std::move(points), place + "/M", place + "/H",
                        file.refuse());
}

// Ours are all called problem.hdf5: they are named after their case, "Mesh0-default".
std::string name_of(const FclibFile& file, const std::filesystem::path& path) {
  std::string title;
  if (file.has("/airybench")) title = file.text("/fclib_local/info/title");
  std::ranges::replace(title, '/', '-');
  return title.empty() ? path.stem().string() : title;
}

contact::Problem read(const std::filesystem::path& path, Until until) {
  const FclibFile file(path);
  const std::string local = "/fclib_local", global = "/fclib_global";
  const bool is_local = file.has(local);
  const std::string& place = is_local ? local : global;
  if (!file.has(place)) file.fail(local, "is missing", "a group of this name, or /fclib_global");
  const int dimension = file.whole(place + "/spacedim", 2, 3);
  for (const char* name : {"/V", "/R", "/G", "/vectors/s", "/vectors/b"})
    if (file.has(place + name)) file.fail(place + name, "equality constraints", "none");
  contact::Problem problem =
      is_local ? read_local(file, place, dimension) : read_global(file, place, dimension, until);
  problem.name = name_of(file, path);
  return problem;
}

// libhdf5 crashes on some damaged files: a child process reads them first. It condenses nothing:
// CHOLMOD's threads are its parent's, and it would wait for them.
void try_to_read(const std::filesystem::path& path) {
  constexpr double max_s = 300;
  const auto begun = std::chrono::steady_clock::now();
  ChildProcess child([&](Channel& channel) {
    channel.receive();
    std::string why_not;
    try {
      read(path, Until::arrays);
    } catch (const InputError& error) {
      why_not = error.what();
    }
    channel.send(why_not);
  });
  const auto answer = child.ask("read", [&](double) { return seconds_since(begun) > max_s; });
  if (answer && answer->empty()) return;
  if (answer) throw FileError(*answer);
  if (child.end().exit_code == no_memory_exit_code) throw std::bad_alloc();
  throw FileError(fmt::format("{}: damaged: libhdf5, which read it, {} (allowed: an HDF5 file)",
                              path.string(), how_it_ended(child.end(), max_s)));
}

}  // namespace

contact::Problem read_fclib_in_this_process(const std::filesystem::path& path) {
  return read(path, Until::condensed);
}

contact::Problem read_fclib(const std::filesystem::path& path) {
  try_to_read(path);
  return read_fclib_in_this_process(path);
}

}  // namespace airybench
