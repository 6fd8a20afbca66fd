#include "support/sha256.hpp"

// OpenSSL's newer functions set up the library first, which does not survive a refused allocation
// (OpenSSL 3.0).
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>

#include <array>

#include "support/file_text.hpp"

namespace airybench {

namespace {

class Sha256 {
 public:
  Sha256() { SHA256_Init(&state_); }
  void add(std::string_view bytes) { SHA256_Update(&state_, bytes.data(), bytes.size()); }
  std::string hex() {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
    SHA256_Final(digest.data(), &state_);
    constexpr std::string_view digits = "0123456789abcdef";
    std::string hex;
    for (const unsigned char byte : digest) {
      hex += digits[byte >> 4];
      hex += digits[byte & 15];
    }
    return hex;
  }

 private:
  SHA256_CTX state_;
};

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  Sha256 hash;
  read_parts(file, [&](std::string_view part) { hash.add(part); });
  return hash.hex();
}

}  // namespace airybench
