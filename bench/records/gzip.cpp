#include "bench/records/gzip.hpp"

#include <zlib.h>

#include <array>
#include <new>

#include "support/errors.hpp"

namespace airybench {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 30;

class Inflation {
 public:
  Inflation() {
    constexpr int gzip_alone = 16 + MAX_WBITS;
    if (inflateInit2(&stream, gzip_alone) != Z_OK) throw std::bad_alloc();
  }
  ~Inflation() { inflateEnd(&stream); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;

  z_stream stream = {};
};

}  // namespace

std::string unpacked(const std::string& bytes, const std::string& file) {
  if (bytes.size() > most_bytes) throw FileError(file + ": larger than 1 GiB");
  Inflation inflation;
  z_stream& stream = inflation.stream;
  // zlib's interface is of C without const; it does not write there.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  std::string text;
  std::array<char, 1 << 16> part;
  for (int state = Z_OK; state != Z_STREAM_END || stream.avail_in > 0;) {
    if (state == Z_STREAM_END) inflateReset(&stream);  // another member follows
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    state = inflate(&stream, Z_NO_FLUSH);
    if (state == Z_MEM_ERROR) throw std::bad_alloc();
    if (state == Z_BUF_ERROR) throw FileError(file + ": ends before what gzip has packed does");
    if (state != Z_OK && state != Z_STREAM_END)
      throw FileError(file + ": is not of gzip, or damaged");
    text.append(part.data(), part.size() - stream.avail_out);
    if (text.size() > most_bytes) throw FileError(file + ": unpacks to more than 1 GiB");
  }
  return text;
}

}  // namespace airybench
