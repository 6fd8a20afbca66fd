#include "meshgen/gmsh_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "mesh/model_format.hpp"
#include "meshgen/abaqus.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/gzip.hpp"

namespace airybench {
namespace {

// Gmsh knows a mesh by its first line, before which there may be comments.
std::size_t begin_of_mesh(const std::string& text) {
  for (const char* first : {"$MeshFormat", "$NOD", "$Comments"}) {
    if (text.starts_with(first)) return 0;
    const std::size_t at = text.find(fmt::format("\n{}", first));
    if (at < 4096) return at + 1;
  }
  return text.npos;
}

// An element of MSH 2 in ASCII has any number of tags; Gmsh wants the physical group and the curve
// or surface. Text without such elements comes back as it is.
std::string with_two_tags(const std::string& text) {
  if (!text.starts_with("$MeshFormat\n2") || text.find("\n$Elements") == text.npos) return text;
  std::istringstream lines(text);
  std::string out;
  bool in_elements = false;
  for (std::string line; std::getline(lines, line); out += line + "\n") {
    if (line.starts_with("$")) in_elements = line.starts_with("$Elements");
    std::istringstream fields(line);
    long number = 0, type = 0, tags = 0, group = 0;
    if (!in_elements || !(fields >> number >> type >> tags) || tags > 1) continue;
    if (tags == 1 && !(fields >> group)) continue;
    std::string nodes;
    std::getline(fields, nodes);
    line = fmt::format("{} {} 2 {} {}{}", number, type, group, std::max(group, 1L), nodes);
  }
  return out;
}

bool is_ascii(const std::string& text) {
  const std::size_t version = text.find('\n') + 1;
  return text.substr(version, text.find('\n', version) - version).find(" 0 ") != text.npos;
}

}  // namespace

GmshInput::GmshInput(const std::filesystem::path& model) : file_(model) {
  const ModelFormat format = format_of(model);
  const std::filesystem::path place = folder_.path() / model_name(model);
  if (is_gzipped(model)) {
    file_ = folder_.path() / model.stem();
    write_file_atomically(file_, unpacked_text(model));
  }
  if (format == ModelFormat::abaqus) {
    const std::string text = file_text(file_);
    file_ = place.string() + ".msh";
    write_file_atomically(file_, msh_of_abaqus(text));
  } else if (format == ModelFormat::msh || format == ModelFormat::other) {
    const std::string text = file_text(file_);
    const std::size_t begin = begin_of_mesh(text);
    if (begin == text.npos)
      throw InputError(fmt::format("no {} (what can be read: {})",
                                   format == ModelFormat::msh ? "mesh" : "model",
                                   model_extensions));
    const std::string mesh = text.substr(begin);
    const std::string readable = is_ascii(mesh) ? with_two_tags(mesh) : mesh;
    if (readable == text || readable == text + "\n") return;
    file_ = place.string() + ".msh";
    write_file_atomically(file_, readable);
  } else if (format == ModelFormat::geo) {
    const std::string text = file_text(file_);
    if (text.empty() || text.ends_with('\n')) return;
    // Gmsh passes over a last line that does not end, but not where the file is included.
    const std::filesystem::path whole = std::filesystem::absolute(file_);
    std::string including = fmt::format("Include \"{}\";\n", whole.string());
    if (std::error_code error; std::filesystem::exists(whole.string() + ".opt", error))
      including += fmt::format("Include \"{}.opt\";\n", whole.string());
    file_ = folder_.path() / "including.geo";
    write_file_atomically(file_, including);
  }
}

}  // namespace airybench
