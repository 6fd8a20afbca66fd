// SHA-256 (FIPS 180-4): the fingerprint by which records name the mesh they were measured on.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace airybench {

// The hash as 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view bytes);

// The hash of a file's bytes. Throws std::runtime_error "file: why" when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace airybench
