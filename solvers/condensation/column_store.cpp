#include "solvers/condensation/column_store.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

#include "solvers/base/solution.hpp"

namespace airybench {

MappedFile::MappedFile(std::size_t bytes) : bytes_(bytes) {
  if (bytes == 0) return;
  const char* folder = std::getenv("TMPDIR");
  if (folder == nullptr || *folder == '\0') folder = "/tmp";
  std::string name = std::string(folder) + "/airybench-XXXXXX";
  const auto refuse = [&](int error) {
    throw Breakdown("no room for " + std::to_string(bytes) + " bytes in a temporary file in " +
                    folder + ": " + std::strerror(error) + " (TMPDIR names another folder)");
  };
  const int file = mkostemp(name.data(), O_CLOEXEC);
  if (file < 0) refuse(errno);
  unlink(name.c_str());
  int error = posix_fallocate(file, 0, static_cast<off_t>(bytes));
  if (error == 0) {
    data_ = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (data_ == MAP_FAILED) error = errno;
  }
  close(file);
  if (error != 0) {
    data_ = nullptr;
    refuse(error);
  }
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) munmap(data_, bytes_);
}

ColumnStore::ColumnStore(Eigen::Index rows, Eigen::Index columns, Place place)
    : rows_(rows), columns_(columns) {
  if (place == Place::file)
    file_ = std::make_unique<MappedFile>(bytes());  // zero, as files are
  else
    memory_.setZero(rows, columns);
}

}  // namespace airybench
