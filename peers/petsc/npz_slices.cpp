#include "peers/petsc/npz_slices.hpp"

#include <algorithm>
#include <cstring>
#include <regex>

#include "support/errors.hpp"

namespace airybench {
namespace {

// Signatures and places of the ZIP format (APPNOTE.TXT, 4.3).
constexpr std::uint32_t end_signature = 0x06054b50, entry_signature = 0x02014b50;
constexpr std::int64_t end_size = 22, longest_comment = 65535;
constexpr std::uint32_t elsewhere = 0xffffffff;  // the value is in the record of 64 bits

template <typename Number>
Number number_in(const std::string& bytes, std::size_t at) {
  Number number{};
  if (at + sizeof number <= bytes.size()) std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

}  // namespace

void NpzSlices::fail(const std::string& what) const { throw FileError(name_ + ": " + what); }

template <typename Number>
Number NpzSlices::number_at(std::int64_t at) {
  Number number{};
  file_.seekg(at).read(reinterpret_cast<char*>(&number), sizeof number);
  if (!file_) fail("the file ends too early");
  return number;
}

NpzSlices::NpzSlices(const std::filesystem::path& file)
    : name_(file.string()), file_(file, std::ios::binary | std::ios::ate) {
  if (!file_) fail("cannot be read");
  const std::int64_t size = file_.tellg();
  const std::int64_t first = std::max<std::int64_t>(0, size - end_size - longest_comment);
  std::string tail(static_cast<std::size_t>(size - first), '\0');
  file_.seekg(first).read(tail.data(), static_cast<std::streamsize>(tail.size()));
  std::int64_t end = static_cast<std::int64_t>(tail.size()) - end_size;
  while (end >= 0 && number_in<std::uint32_t>(tail, static_cast<std::size_t>(end)) != end_signature)
    --end;
  if (end < 0) fail("is no .npz file");
  const auto place = static_cast<std::size_t>(end);
  std::int64_t entries = number_in<std::uint16_t>(tail, place + 10),
               at = number_in<std::uint32_t>(tail, place + 16);
  if (at == elsewhere || entries == 0xffff) {
    const auto record = number_at<std::int64_t>(first + end - 20 + 8);
    entries = number_at<std::int64_t>(record + 32);
    at = number_at<std::int64_t>(record + 48);
  }
  for (; entries > 0; --entries) {
    if (number_at<std::uint32_t>(at) != entry_signature) fail("its directory is damaged");
    const auto method = number_at<std::uint16_t>(at + 10);
    const auto stored = number_at<std::uint32_t>(at + 20),
               whole = number_at<std::uint32_t>(at + 24);
    const auto name_size = number_at<std::uint16_t>(at + 28),
               more = number_at<std::uint16_t>(at + 30), note = number_at<std::uint16_t>(at + 32);
    std::int64_t local = number_at<std::uint32_t>(at + 42);
    std::string name(name_size, '\0');
    file_.seekg(at + 46).read(name.data(), name_size);
    if (local == elsewhere)  // after the two sizes, those that are elsewhere, too
      local = number_at<std::int64_t>(at + 46 + name_size + 4 + 8 * (whole == elsewhere) +
                                      8 * (stored == elsewhere));
    at += 46 + name_size + more + note;
    if (!name.ends_with(".npy")) continue;
    name.resize(name.size() - 4);
    if (method != 0) fail(name + ": is compressed (allowed: stored as it is)");
    const std::int64_t data =
        local + 30 + number_at<std::uint16_t>(local + 26) + number_at<std::uint16_t>(local + 28);
    arrays_[name] = header_at(name, data);
  }
}

NpzSlices::Array NpzSlices::header_at(const std::string& name, std::int64_t at) {
  const auto version = number_at<std::uint8_t>(at + 6);
  const std::int64_t before = version == 1 ? 10 : 12;
  const std::int64_t length =
      version == 1 ? number_at<std::uint16_t>(at + 8) : number_at<std::uint32_t>(at + 8);
  if (length > 10'000) fail(name + ": its header is damaged");
  std::string header(static_cast<std::size_t>(length), '\0');
  file_.seekg(at + before).read(header.data(), length);
  static const std::regex form(
      R"(.*'descr': '(<f8|<i4)', 'fortran_order': (True|False), 'shape': \((\d+),? ?(\d*),?\).*\s*)");
  std::smatch found;
  if (!file_ || !std::regex_match(header, found, form))
    fail(name + ": its header (allowed: <f8 or <i4, one or two dimensions)");
  Array array;
  array.at = at + before + length;
  array.whole_numbers = found[1] == "<i4";
  array.by_columns = found[2] == "True";
  array.rows = std::stoll(found[3]);
  if (found[4].length() > 0) array.columns = std::stoll(found[4]);
  return array;
}

const NpzSlices::Array& NpzSlices::array(const std::string& name) const {
  const auto found = arrays_.find(name);
  if (found == arrays_.end()) fail("there is no array " + name);
  return found->second;
}

template <typename Scalar>
Eigen::MatrixX<Scalar> NpzSlices::slice(const std::string& name, std::int64_t begin,
                                        std::int64_t end) {
  const Array& of = array(name);
  if (of.whole_numbers != std::is_integral_v<Scalar>) fail(name + ": is of another type");
  Eigen::MatrixX<Scalar> values(end - begin, of.columns);
  const auto read = [&](Scalar* to, std::int64_t first, std::int64_t count) {
    constexpr auto width = static_cast<std::int64_t>(sizeof(Scalar));
    file_.seekg(of.at + first * width).read(reinterpret_cast<char*>(to), count * width);
    if (!file_) fail(name + ": the file ends too early");
  };
  if (of.by_columns || of.columns == 1) {
    for (Eigen::Index j = 0; j < of.columns; ++j)
      if (end > begin) read(values.col(j).data(), j * of.rows + begin, end - begin);
    return values;
  }
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_rows(end - begin,
                                                                                 of.columns);
  if (end > begin) read(by_rows.data(), begin * of.columns, by_rows.size());
  return by_rows;
}

Eigen::MatrixXi NpzSlices::integers(const std::string& name, std::int64_t begin, std::int64_t end) {
  return slice<int>(name, begin, end);
}
Eigen::MatrixXd NpzSlices::numbers(const std::string& name, std::int64_t begin, std::int64_t end) {
  return slice<double>(name, begin, end);
}

}  // namespace airybench
