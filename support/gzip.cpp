#include "support/gzip.hpp"

#include <zlib.h>

#include <array>
#include <new>

#include "support/errors.hpp"
#include "support/file_text.hpp"

namespace airybench {
namespace {

// Passes on what the parts of a file unpack to.
class Inflation {
 public:
  using Take = std::function<void(std::string_view part)>;
  Inflation(std::string file, const Take& take) : file_(std::move(file)), take_(take) {
    constexpr int gzip_alone = 16 + MAX_WBITS;
    if (inflateInit2(&stream_, gzip_alone) != Z_OK) throw std::bad_alloc();
  }
  ~Inflation() { inflateEnd(&stream_); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;

  void add(std::string_view packed) {
    // zlib's interface lacks const; inflate() does not write to its input.
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream_.avail_in = static_cast<uInt>(packed.size());
    packed_bytes_ += packed.size();
    do {
      if (state_ == Z_STREAM_END && stream_.avail_in == 0) return;
      if (state_ == Z_STREAM_END) inflateReset(&stream_);  // another member follows
      stream_.next_out = reinterpret_cast<Bytef*>(part_.data());
      stream_.avail_out = static_cast<uInt>(part_.size());
      state_ = inflate(&stream_, Z_NO_FLUSH);
      if (state_ == Z_MEM_ERROR) throw std::bad_alloc();
      if (state_ == Z_BUF_ERROR) return;  // wants more
      if (state_ != Z_OK && state_ != Z_STREAM_END)
        throw FileError(file_ + ": is not of gzip, or damaged");
      const std::size_t size = part_.size() - stream_.avail_out;
      bytes_ += size;
      if (bytes_ > max_bytes)
        throw FileError(file_ + ": unpacks to more than 1 GiB (allowed: up to 1 GiB)");
      if (bytes_ > any_bytes && bytes_ / max_times > packed_bytes_)
        throw FileError(file_ +
                        ": unpacks to more than 200 times its length (allowed: up to that)");
      take_({part_.data(), size});
    } while (stream_.avail_in > 0 || stream_.avail_out == 0);
  }
  void end() const {
    if (state_ != Z_STREAM_END) throw FileError(file_ + ": ends before what gzip has packed does");
  }

 private:
  static constexpr std::size_t max_bytes = std::size_t{1} << 30;
  static constexpr std::size_t any_bytes = std::size_t{1} << 26, max_times = 200;
  std::string file_;
  const Take& take_;
  z_stream stream_ = {};
  int state_ = Z_OK;
  std::size_t bytes_ = 0, packed_bytes_ = 0;
  std::array<char, 1 << 16> part_;
};

}  // namespace

void read_unpacked_parts(const std::filesystem::path& file,
                         const std::function<void(std::string_view part)>& take) {
  Inflation inflation(file.string(), take);
  read_parts(file, [&](std::string_view part) { inflation.add(part); });
  inflation.end();
}

std::string unpacked_text(const std::filesystem::path& file) {
  std::string text;
  read_unpacked_parts(file, [&](std::string_view part) { text += part; });
  return text;
}

}  // namespace airybench
