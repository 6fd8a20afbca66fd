// Arrays of an uncompressed .npz file, <i4 or <f8; every rank reads its own rows.
#pragma once

#include <zip.h>

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <regex>
#include <string>

#include "support/errors.hpp"

namespace airybench {

class NpzSlices {
 public:
  // Throws FileError with the file and the reason.
  explicit NpzSlices(const std::filesystem::path& file) : name_(file.string()) {
    int error = 0;
    archive_.reset(zip_open(name_.c_str(), ZIP_RDONLY, &error));
    if (!archive_) fail(error == ZIP_ER_NOZIP ? "is no .npz file" : "cannot be read");
  }

  std::int64_t rows(const std::string& name) const { return opened(name).rows; }
  // Rows [begin, end), all columns; Scalar: int or double, as in the file.
  static constexpr std::int64_t all = -1;
  template <typename Scalar>
  Eigen::MatrixX<Scalar> read(const std::string& name, std::int64_t begin = 0,
                              std::int64_t end = all) const {
    const Array of = opened(name);
    if (end == all) end = of.rows;
    if (of.whole_numbers != std::is_integral_v<Scalar>) fail(name + ": is of another type");
    constexpr auto width = static_cast<std::int64_t>(sizeof(Scalar));
    // Columns in the file's memory: those of the array, or its rows.
    const std::int64_t lines = of.by_columns ? of.columns : 1;
    const std::int64_t first = of.by_columns ? begin : begin * of.columns;
    Eigen::MatrixX<Scalar> values(of.by_columns ? end - begin : of.columns,
                                  of.by_columns ? of.columns : end - begin);
    for (std::int64_t line = 0; line < lines; ++line)
      if (zip_fseek(of.file.get(), of.start + (line * of.rows + first) * width, SEEK_SET) != 0 ||
          !of.read(values.data() + line * values.rows(),
                   static_cast<std::size_t>(values.size() / lines * width)))
        fail(name + ": the file ends too early");
    if (of.by_columns) return values;
    return values.transpose();
  }

 private:
  struct Close {
    void operator()(zip_t* archive) const { zip_discard(archive); }
    void operator()(zip_file_t* file) const { zip_fclose(file); }
  };
  struct Array {
    std::unique_ptr<zip_file_t, Close> file;
    std::int64_t start, rows, columns = 1;  // start: byte of the first number
    bool by_columns, whole_numbers;
    bool read(void* to, std::size_t bytes) const {
      return zip_fread(file.get(), to, bytes) == static_cast<zip_int64_t>(bytes);
    }
  };

  [[noreturn]] void fail(const std::string& what) const { throw FileError(name_ + ": " + what); }

  // A .npy file: "\x93NUMPY", version 1 0, two bytes of length, the header as a Python dictionary,
  // the numbers (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html).
  Array opened(const std::string& name) const {
    static const std::regex form(
        R"(.*'descr': '(<f8|<i4)', 'fortran_order': (True|False), 'shape': \((\d+),? ?(\d*),?\).*\s*)");
    zip_stat_t stat;
    if (zip_stat(archive_.get(), (name + ".npy").c_str(), 0, &stat) != 0)
      fail("there is no array " + name);
    if (stat.comp_method != ZIP_CM_STORE) fail(name + ": is compressed (allowed: stored as it is)");
    Array array;
    array.file.reset(zip_fopen_index(archive_.get(), stat.index, 0));
    std::array<unsigned char, 10> first{};
    bool is_read = array.file && array.read(first.data(), first.size()) && first[6] == 1;
    std::string header(first[8] + 256U * first[9], '\0');
    is_read = is_read && array.read(header.data(), header.size());
    std::smatch found;
    if (!is_read || !std::regex_match(header, found, form))
      fail(name + ": its header (allowed: <f8 or <i4, one or two dimensions)");
    array.start = static_cast<std::int64_t>(first.size() + header.size());
    array.whole_numbers = found[1] == "<i4";
    array.by_columns = found[2] == "True";
    array.rows = std::stoll(found[3]);
    if (found[4].length() > 0) array.columns = std::stoll(found[4]);
    return array;
  }

  std::string name_;
  std::unique_ptr<zip_t, Close> archive_;
};

}  // namespace airybench
