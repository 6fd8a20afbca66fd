#include "support/sha256.hpp"

// OpenSSL 3.0's newer functions do not survive a refused allocation in their initialisation.
#define OPENSSL_SUPPRESS_DEPRECATED
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/sha.h>

#include <array>

#include "support/file_text.hpp"

namespace airybench {
namespace {

std::string hex_digest(SHA256_CTX& state) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest;
  SHA256_Final(digest.data(), &state);
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

}  // namespace

std::string sha256_hex(std::string_view bytes) {
  SHA256_CTX state;
  SHA256_Init(&state);
  SHA256_Update(&state, bytes.data(), bytes.size());
  return hex_digest(state);
}

std::string sha256_of_file(const std::filesystem::path& file) {
  SHA256_CTX state;
  SHA256_Init(&state);
  read_parts(file, [&](std::string_view part) { SHA256_Update(&state, part.data(), part.size()); });
  return hex_digest(state);
}

}  // namespace airybench
