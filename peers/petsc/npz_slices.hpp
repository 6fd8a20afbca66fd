// Arrays of an .npz file without compression, row by row: every rank reads its own rows.
#pragma once

#include <zip.h>

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace airybench {

class NpzSlices {
 public:
  // Throws FileError: the file, and what is wrong.
  explicit NpzSlices(const std::filesystem::path& file);

  std::int64_t rows(const std::string& name) const { return opened(name).rows; }
  // Rows [begin, end), all columns; of <i4 and <f8 arrays.
  Eigen::MatrixXi integers(const std::string& name, std::int64_t begin, std::int64_t end) const {
    return slice<int>(name, begin, end);
  }
  Eigen::MatrixXd numbers(const std::string& name, std::int64_t begin, std::int64_t end) const {
    return slice<double>(name, begin, end);
  }
  Eigen::MatrixXi integers(const std::string& name) const { return integers(name, 0, rows(name)); }
  Eigen::MatrixXd numbers(const std::string& name) const { return numbers(name, 0, rows(name)); }

 private:
  struct Close {
    void operator()(zip_t* archive) const { zip_discard(archive); }
    void operator()(zip_file_t* file) const { zip_fclose(file); }
  };
  struct Array {
    std::unique_ptr<zip_file_t, Close> file;
    std::int64_t start, rows, columns = 1;  // start: byte of the first number
    bool by_columns, whole_numbers;
  };
  Array opened(const std::string& name) const;
  template <typename Scalar>
  Eigen::MatrixX<Scalar> slice(const std::string& name, std::int64_t begin, std::int64_t end) const;
  [[noreturn]] void fail(const std::string& what) const;

  std::string name_;
  std::unique_ptr<zip_t, Close> archive_;
};

}  // namespace airybench
