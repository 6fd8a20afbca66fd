// Large committed records are packed by gzip (RFC 1952); they are read so, never written.
#pragma once

#include <string>

namespace airybench {

// What the bytes of a .gz, of one member or several, unpack to: at most 1 GiB. Throws FileError
// "file: why".
std::string unpacked(const std::string& bytes, const std::string& file);

}  // namespace airybench
