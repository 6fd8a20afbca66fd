#include "support/sha256.hpp"

// OpenSSL's newer functions set up the library first, which does not survive a refused allocation
// (OpenSSL 3.0).
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>

#include <array>

#include "support/file_text.hpp"

namespace airybench {

std::string sha256_hex(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  SHA256_CTX hash;
  SHA256_Init(&hash);
  SHA256_Update(&hash, bytes.data(), bytes.size());
  SHA256_Final(digest.data(), &hash);
  constexpr std::string_view digits = "0123456789abcdef";
  std::string hex;
  for (const unsigned char byte : digest) {
    hex += digits[byte >> 4];
    hex += digits[byte & 15];
  }
  return hex;
}

std::string sha256_of_file(const std::filesystem::path& file) {
  return sha256_hex(file_text(file));
}

}  // namespace airybench
