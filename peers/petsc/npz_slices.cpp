#include "peers/petsc/npz_slices.hpp"

#include <regex>

#include "support/errors.hpp"

namespace airybench {

void NpzSlices::fail(const std::string& what) const { throw FileError(name_ + ": " + what); }

NpzSlices::NpzSlices(const std::filesystem::path& file) : name_(file.string()) {
  int error = 0;
  archive_.reset(zip_open(name_.c_str(), ZIP_RDONLY, &error));
  if (!archive_) fail(error == ZIP_ER_NOZIP ? "is no .npz file" : "cannot be read");
}

// A .npy file: "\x93NUMPY", its version, the length of its header, a Python dictionary, the numbers
// (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
NpzSlices::Array NpzSlices::opened(const std::string& name) const {
  static const std::regex form(
      R"(.*'descr': '(<f8|<i4)', 'fortran_order': (True|False), 'shape': \((\d+),? ?(\d*),?\).*\s*)");
  zip_stat_t stat;
  if (zip_stat(archive_.get(), (name + ".npy").c_str(), 0, &stat) != 0)
    fail("there is no array " + name);
  if (stat.comp_method != ZIP_CM_STORE) fail(name + ": is compressed (allowed: stored as it is)");
  Array array;
  array.file.reset(zip_fopen_index(archive_.get(), stat.index, 0));
  std::string header(10, '\0');
  const auto read = [&](char* to, std::size_t count) {
    return array.file && zip_fread(array.file.get(), to, count) == static_cast<zip_int64_t>(count);
  };
  const auto byte = [&](int at) { return static_cast<unsigned char>(header[at]); };
  std::smatch found;
  bool is_read = read(header.data(), header.size()) && byte(6) == 1;
  header.resize(byte(8) + 256U * byte(9));
  is_read = is_read && read(header.data(), header.size());
  if (!is_read || !std::regex_match(header, found, form))
    fail(name + ": its header (allowed: <f8 or <i4, one or two dimensions)");
  array.start = 10 + static_cast<std::int64_t>(header.size());
  array.whole_numbers = found[1] == "<i4";
  array.by_columns = found[2] == "True";
  array.rows = std::stoll(found[3]);
  if (found[4].length() > 0) array.columns = std::stoll(found[4]);
  return array;
}

template <typename Scalar>
Eigen::MatrixX<Scalar> NpzSlices::slice(const std::string& name, std::int64_t begin,
                                        std::int64_t end) const {
  const Array of = opened(name);
  if (of.whole_numbers != std::is_integral_v<Scalar>) fail(name + ": is of another type");
  const auto read = [&](Scalar* to, std::int64_t first, std::int64_t count) {
    const std::int64_t bytes = count * static_cast<std::int64_t>(sizeof(Scalar));
    const std::int64_t at = of.start + first * static_cast<std::int64_t>(sizeof(Scalar));
    if (zip_fseek(of.file.get(), at, SEEK_SET) != 0 ||
        zip_fread(of.file.get(), to, static_cast<zip_uint64_t>(bytes)) != bytes)
      fail(name + ": the file ends too early");
  };
  if (of.by_columns) {
    Eigen::MatrixX<Scalar> values(end - begin, of.columns);
    for (Eigen::Index j = 0; j < of.columns; ++j)
      read(values.col(j).data(), j * of.rows + begin, end - begin);
    return values;
  }
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values(end - begin,
                                                                                of.columns);
  read(values.data(), begin * of.columns, values.size());
  return values;
}

template Eigen::MatrixXi NpzSlices::slice(const std::string&, std::int64_t, std::int64_t) const;
template Eigen::MatrixXd NpzSlices::slice(const std::string&, std::int64_t, std::int64_t) const;

}  // namespace airybench
