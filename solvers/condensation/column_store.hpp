// Room for a matrix that may be too large for memory: on the heap or in a file.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace airybench {

// A temporary file mapped into memory. It has no name from the moment it is opened, so nothing is
// left behind whatever happens, and its room on the disk is reserved at once.
class MappedFile {
 public:
  // In $TMPDIR, else /tmp. Throws Breakdown naming the folder and the reason: no room, no right.
  explicit MappedFile(std::size_t bytes);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  void* data() const { return data_; }

 private:
  void* data_ = nullptr;
  std::size_t bytes_;
};

// A zero matrix in one of the two places.
class ColumnStore {
 public:
  enum class Place { memory, file };
  ColumnStore() = default;
  ColumnStore(Eigen::Index rows, Eigen::Index columns, Place place);

  Eigen::Map<Eigen::MatrixXd> matrix() { return {data(), rows_, columns_}; }
  Eigen::Map<const Eigen::MatrixXd> matrix() const { return {data(), rows_, columns_}; }
  std::size_t bytes() const { return static_cast<std::size_t>(rows_ * columns_) * sizeof(double); }
  std::size_t heap_bytes() const { return file_ ? 0 : bytes(); }

 private:
  double* data() const {
    return file_ ? static_cast<double*>(file_->data()) : const_cast<double*>(memory_.data());
  }
  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::MatrixXd memory_;
  std::unique_ptr<MappedFile> file_;
};

}  // namespace airybench
