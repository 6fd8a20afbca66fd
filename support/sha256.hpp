// SHA-256 (FIPS 180-4), by which records identify their mesh.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace airybench {

std::string sha256_hex(std::string_view bytes);

// Throws std::runtime_error "file: why" if the file cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace airybench
