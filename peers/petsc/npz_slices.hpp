// Arrays of an .npz file without compression, row by row: every rank reads its own rows.
//
// The layout is that of ZIP (with 64-bit sizes where they are needed) around NumPy's .npy, types
// <i4 and <f8.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

namespace airybench {

class NpzSlices {
 public:
  // Throws FileError: the file, and what is wrong.
  explicit NpzSlices(const std::filesystem::path& file);

  std::int64_t rows(const std::string& name) const { return array(name).rows; }
  // Rows [begin, end), all columns.
  Eigen::MatrixXi integers(const std::string& name, std::int64_t begin, std::int64_t end);
  Eigen::MatrixXd numbers(const std::string& name, std::int64_t begin, std::int64_t end);
  Eigen::MatrixXi integers(const std::string& name) { return integers(name, 0, rows(name)); }
  Eigen::MatrixXd numbers(const std::string& name) { return numbers(name, 0, rows(name)); }

 private:
  struct Array {
    std::int64_t at = 0, rows = 0, columns = 1;
    bool by_columns = false, whole_numbers = false;
  };
  const Array& array(const std::string& name) const;
  Array header_at(const std::string& name, std::int64_t at);
  template <typename Scalar>
  Eigen::MatrixX<Scalar> slice(const std::string& name, std::int64_t begin, std::int64_t end);
  template <typename Number>
  Number number_at(std::int64_t at);
  [[noreturn]] void fail(const std::string& what) const;

  std::string name_;
  std::ifstream file_;
  std::map<std::string, Array> arrays_;
};

}  // namespace airybench
