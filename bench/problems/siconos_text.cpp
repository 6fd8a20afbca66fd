#include "bench/problems/siconos_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string_view>

#include "bench/problems/problem_parts.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

// Word by word.
class Words {
 public:
  explicit Words(const std::filesystem::path& path)
      : path_(path.string()), text_(std::make_shared<const std::string>(file_text(path))) {
    find();
  }
  [[noreturn]] void fail(const std::string& what, const std::string& allowed) const {
    throw FileError(fmt::format("{}:{}: {} (allowed: {})", path_, line_, what, allowed));
  }
  Refuse refuse() const {
    return [this](const auto& place, const auto& what, const auto& allowed) {
      throw FileError(fmt::format("{}: {}: {} (allowed: {})", path_, place, what, allowed));
    };
  }
  std::string_view peek() const { return word_; }
  // Whether these are the next words.
  bool next_are(std::initializer_list<std::string_view> words) const {
    Words ahead = *this;
    for (const std::string_view word : words) {
      if (ahead.word_ != word) return false;
      ahead.find();
    }
    return true;
  }
  void take() { find(); }
  void expect(std::string_view word) {
    if (word_ != word) fail(shown(), std::string(word));
    find();
  }
  void skip_line() {
    const std::size_t end = text_->find('\n', next_ - word_.size());
    next_ = end == std::string::npos ? text_->size() : end;
    find();
  }
  int whole(std::int64_t least, std::int64_t most) {
    std::string_view word = word_;
    while (!word.empty() && (word.back() == ',' || word.back() == ':')) word.remove_suffix(1);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value < least || value > most)
      fail(shown(), least == most ? std::to_string(least)
                                  : fmt::format("a whole number from {} to {}", least, most));
    find();
    return static_cast<int>(value);
  }
  double number() {
    std::string_view word = word_;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() ||
        !std::isfinite(value))
      fail(shown(), "a finite number");
    find();
    return value;
  }
  Eigen::VectorXd numbers(Eigen::Index count) {
    need(count);
    return Eigen::VectorXd::NullaryExpr(count, [&] { return number(); });
  }
  std::vector<int> wholes(std::int64_t count, std::int64_t least, std::int64_t most) {
    need(count);
    std::vector<int> values(static_cast<std::size_t>(count));
    for (int& value : values) value = whole(least, most);
    return values;
  }
  // Before memory for so many is taken: each has a character and a blank.
  void need(std::int64_t count) const {
    if (count > static_cast<std::int64_t>(text_->size() - next_ + word_.size()) / 2 + 1)
      fail(fmt::format("the file ends before {} numbers", count), "as many as it announces");
  }

 private:
  std::string shown() const {
    return word_.empty() ? "the file ends" : shortened(std::string(word_));
  }
  void find() {
    const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (next_ < text_->size() && is_blank((*text_)[next_])) line_ += (*text_)[next_++] == '\n';
    const std::size_t first = next_;
    while (next_ < text_->size() && !is_blank((*text_)[next_])) ++next_;
    word_ = std::string_view(*text_).substr(first, next_ - first);
  }

  std::string path_;
  std::shared_ptr<const std::string> text_;
  std::string_view word_;  // the next one; empty at the end
  std::size_t next_ = 0;   // after it
  int line_ = 1;
};

struct Shape {
  int rows, columns;
};
using Entries = std::vector<Eigen::Triplet<double>>;

void read_dense(Words& words, const Shape& shape, Entries& entries) {
  words.whole(shape.rows, shape.rows);
  words.whole(shape.columns, shape.columns);
  words.need(static_cast<std::int64_t>(shape.rows) * shape.columns);
  for (int j = 0; j < shape.columns; ++j)
    for (int i = 0; i < shape.rows; ++i)
      if (const double x = words.number(); x != 0) entries.emplace_back(i, j, x);
}

// Where each of the rows or columns of blocks begins, and the end: `size`.
std::vector<int> block_starts(Words& words, int count, int size) {
  std::vector<int> starts = {0};
  words.need(count);
  for (int k = 0; k < count; ++k) {
    const int end = words.whole(starts.back() + 1, size);
    starts.push_back(end);
  }
  if (starts.back() != size)
    words.fail(fmt::format("the last block ends at {}", starts.back()), std::to_string(size));
  return starts;
}

void read_blocks(Words& words, const Shape& shape, Entries& entries) {
  const int blocks = words.whole(0, std::numeric_limits<int>::max());
  if (blocks == 0) return;
  const int block_rows = words.whole(1, shape.rows), block_columns = words.whole(1, shape.columns);
  const std::vector<int> row = block_starts(words, block_rows, shape.rows),
                         column = block_starts(words, block_columns, shape.columns);
  words.whole(block_rows + 1, block_rows + 1);
  words.whole(blocks, blocks);
  words.whole(0, 0);
  std::vector<int> first = {0};
  for (int k = 0; k < block_rows; ++k) first.push_back(words.whole(first.back(), blocks));
  if (first.back() != blocks)
    words.fail(fmt::format("the rows have {} blocks", first.back()), std::to_string(blocks));
  const std::vector<int> of_block = words.wholes(blocks, 0, block_columns - 1);
  for (int I = 0; I < block_rows; ++I)
    for (int b = first[I]; b < first[I + 1]; ++b) {
      words.whole(b, b);
      const int J = of_block[b];
      for (int j = column[J]; j < column[J + 1]; ++j)
        for (int i = row[I]; i < row[I + 1]; ++i) entries.emplace_back(i, j, words.number());
    }
}

void read_csparse(Words& words, const Shape& shape, Entries& entries) {
  words.whole(1, 4);
  words.skip_line();  // "CSparse Version …"
  const bool triplets = words.peek() == "triplet:", by_rows = words.peek() == "csr:";
  if (triplets || by_rows) words.take();
  words.expect(fmt::format("{}-by-{},", shape.rows, shape.columns));
  words.expect("nzmax:");
  words.whole(0, std::numeric_limits<int>::max());
  words.expect("nnz:");
  const int count = words.whole(0, std::numeric_limits<int>::max());
  words.need(2 * std::int64_t{count});
  if (words.peek() == "1-norm:") {
    words.take();
    words.number();
  }
  const auto index = [&](int size) { return words.whole(0, size - 1); };
  const auto value = [&] {
    words.expect(":");
    return words.number();
  };
  if (triplets) {
    for (int k = 0; k < count; ++k) {
      const int i = index(shape.rows), j = index(shape.columns);
      entries.emplace_back(i, j, value());
    }
    return;
  }
  const int lines = by_rows ? shape.rows : shape.columns;
  for (int line = 0, k = 0; line < lines; ++line) {
    words.expect(by_rows ? "row" : "col");
    words.whole(line, line);
    words.expect(":");
    words.expect("locations");
    words.whole(k, k);
    words.expect("to");
    const int end = words.whole(k - 1, count - 1) + 1;
    for (; k < end; ++k) {
      const int other = index(by_rows ? shape.columns : shape.rows);
      const double x = value();
      if (by_rows)
        entries.emplace_back(line, other, x);
      else
        entries.emplace_back(other, line, x);
    }
  }
}

SparseRows read_matrix(Words& words) {
  const int kind = words.whole(0, 2);
  Shape shape{};
  shape.rows = words.whole(1, max_unknowns);
  shape.columns = words.whole(1, max_unknowns);
  Entries entries;
  (kind == 0 ? read_dense : kind == 1 ? read_blocks : read_csparse)(words, shape, entries);
  SparseRows matrix(shape.rows, shape.columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

void check_shape(const Words& words, const char* place, const SparseRows& matrix, Eigen::Index rows,
                 Eigen::Index columns) {
  if (matrix.rows() != rows || matrix.cols() != columns)
    words.refuse()(place, fmt::format("{} x {}", matrix.rows(), matrix.cols()),
                   fmt::format("{} x {}", rows, columns));
}

}  // namespace

contact::Problem read_siconos_text(const std::filesystem::path& file) {
  Words words(file);
  const int dimension = words.whole(2, 3);
  const int contacts = words.whole(1, max_contact_rows / dimension), m = dimension * contacts;
  SparseRows first = read_matrix(words);
  const auto points = [&] {
    ContactPoints result = points_of(dimension, words.numbers(contacts), "mu", words.refuse());
    while (!words.peek().empty()) words.number();  // whether there is a guess, and that
    return result;
  };
  const auto is_matrix = [&](int kind) {
    return words.next_are({std::to_string(kind), std::to_string(first.rows()), std::to_string(m)});
  };
  contact::Problem problem;
  if (!is_matrix(0) && !is_matrix(1) && !is_matrix(2)) {
    check_shape(words, "W", first, m, m);
    Eigen::VectorXd q = words.numbers(m);
    problem = local_problem(std::move(first), std::move(q), points(), "W", words.refuse());
  } else {
    GlobalArrays arrays;
    check_shape(words, "M", first, first.rows(), first.rows());
    arrays.M = std::move(first);
    arrays.H = read_matrix(words);
    arrays.f = words.numbers(arrays.M.rows());
    arrays.w = words.numbers(m);
    problem = global_problem(std::move(arrays), points(), "M", "H", words.refuse());
  }
  problem.name = file.stem().string();
  return problem;
}

}  // namespace airybench
