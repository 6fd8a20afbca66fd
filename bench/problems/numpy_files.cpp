#include "bench/problems/numpy_files.hpp"

#include <fmt/format.h>
#include <zip.h>

#include <array>
#include <bit>
#include <memory>
#include <stdexcept>

namespace airybench {
namespace {

static_assert(std::endian::native == std::endian::little, "the types below are little-endian");
constexpr const char* type_of(double) { return "<f8"; }
constexpr const char* type_of(int) { return "<i4"; }

std::string npy(const std::string& type, bool by_columns, const std::string& shape,
                std::string_view bytes) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}), }}", type,
                                   by_columns ? "True" : "False", shape);
  constexpr std::size_t before = 10, alignment = 64;
  header.append(alignment - 1 - (before + header.size()) % alignment, ' ') += '\n';
  std::string file("\x93NUMPY\x01\x00", 8);
  file += static_cast<char>(header.size() % 256);
  file += static_cast<char>(header.size() / 256);
  return file.append(header).append(bytes);
}

template <typename Scalar>
std::string npy_of(const Scalar* values, std::size_t count, const std::string& shape) {
  return npy(type_of(Scalar{}), true, shape,
             {reinterpret_cast<const char*>(values), count * sizeof(Scalar)});
}
template <typename Scalar>
std::string npy_of(const Scalar* values, std::size_t count) {
  return npy_of(values, count, fmt::format("{},", count));
}

using File = std::pair<std::string, std::string>;  // name, bytes

struct Discard {
  void operator()(zip_t* archive) const { zip_discard(archive); }
  void operator()(zip_source_t* source) const { zip_source_free(source); }
};

void check(bool done, const char* what) {
  if (!done) throw std::runtime_error(fmt::format("libzip: {} failed", what));
}

std::string all_of(zip_source_t* source) {
  zip_stat_t stat;
  check(zip_source_stat(source, &stat) == 0, "zip_source_stat");
  std::string bytes(stat.size, '\0');
  check(zip_source_open(source) == 0, "zip_source_open");
  const zip_int64_t read = zip_source_read(source, bytes.data(), bytes.size());
  zip_source_close(source);
  check(read == static_cast<zip_int64_t>(bytes.size()), "zip_source_read");
  return bytes;
}

// No compression and no date, so that the same problem gives the same file.
std::string zip_of(const std::vector<File>& files) {
  const std::unique_ptr<zip_source_t, Discard> buffer(
      zip_source_buffer_create(nullptr, 0, 0, nullptr));
  check(buffer != nullptr, "zip_source_buffer_create");
  std::unique_ptr<zip_t, Discard> archive(
      zip_open_from_source(buffer.get(), ZIP_TRUNCATE, nullptr));
  check(archive != nullptr, "zip_open_from_source");
  zip_source_keep(buffer.get());  // one reference for the archive, one for this function
  for (const auto& [name, bytes] : files) {
    zip_source_t* source = zip_source_buffer(archive.get(), bytes.data(), bytes.size(), 0);
    const zip_int64_t index = zip_file_add(archive.get(), name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) zip_source_free(source);
    check(index >= 0, "zip_file_add");
    const auto place = static_cast<zip_uint64_t>(index);
    constexpr zip_uint16_t midnight = 0, first_of_january_1980 = 1 << 5 | 1;
    check(zip_set_file_compression(archive.get(), place, ZIP_CM_STORE, 0) == 0 &&
              zip_file_set_dostime(archive.get(), place, midnight, first_of_january_1980, 0) == 0,
          "zip_file_set_dostime");
  }
  check(zip_close(archive.get()) == 0, "zip_close");
  archive.release();  // zip_close() has freed it
  return all_of(buffer.get());
}

std::string npy_of(const ProblemArray& array) {
  const std::string shape = array.is_vector()
                                ? fmt::format("{},", array.rows())
                                : fmt::format("{}, {}", array.rows(), array.columns());
  const auto count = static_cast<std::size_t>(array.rows() * array.columns());
  if (const auto* whole = std::get_if<Eigen::MatrixXi>(&array.values))
    return npy_of(whole->data(), count, shape);
  return npy_of(std::get<Eigen::MatrixXd>(array.values).data(), count, shape);
}

}  // namespace

std::string npz_of_arrays(const std::vector<const ProblemArray*>& arrays) {
  std::vector<File> files;
  for (const ProblemArray* array : arrays) files.emplace_back(array->name + ".npy", npy_of(*array));
  return zip_of(files);
}

std::string npz_of_sparse(const SparseRows& matrix) {
  const std::array<int, 2> shape = {static_cast<int>(matrix.rows()),
                                    static_cast<int>(matrix.cols())};
  const auto entries = static_cast<std::size_t>(matrix.nonZeros());
  const auto rows = static_cast<std::size_t>(matrix.rows());
  return zip_of({{"indices.npy", npy_of(matrix.innerIndexPtr(), entries)},
                 {"indptr.npy", npy_of(matrix.outerIndexPtr(), rows + 1)},
                 {"format.npy", npy("|S3", false, "", "csr")},
                 {"shape.npy", npy_of(shape.data(), shape.size())},
                 {"data.npy", npy_of(matrix.valuePtr(), entries)}});
}

}  // namespace airybench
