#include "meshgen/gmsh_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string>
#include <string_view>

#include "mesh/model_format.hpp"
#include "meshgen/announced_counts.hpp"
#include "meshgen/deck_scene.hpp"
#include "meshgen/foreign_mesh.hpp"
#include "meshgen/med_mesh.hpp"
#include "support/atomic_file.hpp"
#include "support/errors.hpp"
#include "support/file_text.hpp"
#include "support/gzip.hpp"

namespace airybench {
namespace {

// Text without a mark of its encoding, blanks at the ends of lines and, where they mean nothing,
// empty lines; other data as they are.
std::string tidied(const std::string& text, bool has_empty_lines) {
  if (text.find('\0') != text.npos) return text;
  std::string_view left = text;
  left.remove_prefix(text.starts_with("\xef\xbb\xbf") ? 3 : 0);
  std::string out;
  while (!left.empty()) {
    std::string_view line = left.substr(0, left.find('\n'));
    left.remove_prefix(std::min(line.size() + 1, left.size()));
    line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
    if (has_empty_lines || !line.empty()) out.append(line) += '\n';
  }
  return out;
}

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
// or surface. A name of MSH 2.0 has no dimension; Gmsh wants one, and 2.2.
std::string as_gmsh_wants(const std::string& text) {
  if (!text.starts_with("$MeshFormat\n2") || text.find("\n$Elements") == text.npos) return text;
  std::istringstream lines(text);
  std::string out, section;
  std::size_t names_at = 0;  // in the text written
  int names = 0;
  for (std::string line; std::getline(lines, line); out += line + "\n") {
    if (line.starts_with("$")) section = line;
    std::istringstream fields(line);
    long number = 0, type = 0, tags = 0, group = 0;
    std::string rest;
    if (section.starts_with("$PhysicalNames")) {
      if (line == section) names_at = out.size() + line.size() + 1;
      if (!(fields >> number >> std::ws) || fields.peek() != '"') continue;
      std::getline(fields, rest);
      line = fmt::format("1 {0} {1}\n2 {0} {1}", number, rest);
      names += 2;
    } else if (section.starts_with("$Elements")) {
      if (!(fields >> number >> type >> tags) || tags > 1) continue;
      if (tags == 1 && !(fields >> group)) continue;
      std::getline(fields, rest);
      line = fmt::format("{} {} 2 {} {}{}", number, type, group, std::max(group, 1L), rest);
    }
  }
  if (names == 0) return out;
  out.replace(names_at, out.find('\n', names_at) - names_at, std::to_string(names));
  const std::size_t version = out.find('\n') + 1;
  return out.replace(version, out.find('\n', version) - version, "2.2 0 8");
}

// Gmsh passes over what is missing.
void check_stl(const std::string& text) {
  std::istringstream lines(text);
  int facets = 0, vertices = 0;
  std::string word;
  for (std::string line; std::getline(lines, line);) {
    word.clear();
    std::istringstream(line) >> word;
    std::ranges::transform(word, word.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (word == "vertex") ++vertices;
    if (word == "facet") ++facets;
    if (word != "endfacet" && word != "facet" && word != "endsolid") continue;
    const int all = 3 * (facets - (word == "facet"));
    if (vertices != all)
      throw InputError(fmt::format("facet {} has not 3 vertices", facets - (word == "facet")));
  }
  if (word != "endsolid") throw InputError("its last line is not endsolid; is it truncated?");
}

// Where the whole shape, "+1 0", is missing at the end, OpenCASCADE reads on for ever.
void check_brep(const std::string& text) {
  std::size_t end = text.size();
  for (int lines = 0; lines < 2 && end != text.npos; ++lines) {  // a last line "0" may follow
    const std::size_t last = text.find_last_not_of(" \r\n", end - 1);
    if (last == text.npos) break;
    end = text.rfind('\n', last);
    const char sign = text[end + 1];
    if ((sign == '+' || sign == '-' || sign == 'i' || sign == 'e') && text[last] != '*') return;
  }
  throw InputError("its end is missing; is it truncated?");
}

std::filesystem::path folder_of(const std::filesystem::path& model) {
  return std::filesystem::absolute(model).parent_path();
}

void refuse_utf16(const std::string& text) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError("it is UTF-16 text (allowed: UTF-8)");
}

bool is_ascii(const std::string& text) {
  const std::size_t version = text.find('\n') + 1;
  return text.substr(version, text.find('\n', version) - version).find(" 0 ") != text.npos;
}

}  // namespace

GmshInput::GmshInput(const std::filesystem::path& model) : file_(model) {
  const ModelFormat format = format_of(model);
  if (is_gzipped(model)) {
    file_ = folder_.path() / model.stem();
    write_file_atomically(file_, unpacked_text(model));
  }
#ifdef AIRYBENCH_HAS_HDF5
  if (format == ModelFormat::med) {
    const std::string mesh = msh_of_med(file_);
    file_ = folder_.path() / (model_name(model) + ".msh");
    write_file_atomically(file_, mesh);
    return;
  }
#endif
  const std::string text = file_text(file_);
  if (format == ModelFormat::cad || format == ModelFormat::med) {
    if (text.find("CASCADE Topology") < 4096) check_brep(text);
    return;
  }
  const bool is_binary = text.find('\0') != text.npos;
  refuse_utf16(text);
  const auto give = [&](const std::filesystem::path& name, const std::string& other) {
    file_ = folder_.path() / name;
    write_file_atomically(file_, other);
  };
  const std::string mesh_name = model_name(model) + ".msh";
  if (format == ModelFormat::geo) {
    if (text.empty() || text.ends_with('\n')) return;
    // Gmsh passes over a last line that does not end, but not where the file is included.
    const std::filesystem::path whole = std::filesystem::absolute(file_);
    std::string including = fmt::format("Include \"{}\";\n", whole.string());
    if (std::error_code error; std::filesystem::exists(whole.string() + ".opt", error))
      including += fmt::format("Include \"{}.opt\";\n", whole.string());
    give("including.geo", including);
  } else if (format == ModelFormat::abaqus) {
    const Deck deck = read_deck(tidied(text, true), folder_of(model));
    give(mesh_name, msh_of(deck, curves_of(deck)));
  } else if (format == ModelFormat::obj) {
    give(mesh_name, msh_of_obj(text));
  } else if (format == ModelFormat::msh && is_of_freefem(text)) {
    give(mesh_name, msh_of_freefem(text));
  } else if (format == ModelFormat::mesh || format == ModelFormat::outline) {
    const bool is_outline = format == ModelFormat::outline;
    refuse_counts_beyond(text, is_outline);
    if (file_.extension() == ".unv") refuse_unv_counts_beyond(text);
    const std::string tidy = tidied(text, !is_outline);
    if (is_outline && !is_binary) check_stl(tidy);
    for (const char* of_text : {".unv", ".bdf", ".mesh"})
      if (is_binary && file_.extension() == of_text)
        throw InputError("it holds the byte 0 (allowed: text)");
    if (tidy != text) give(is_gzipped(model) ? model.stem() : model.filename(), tidy);
  } else {
    refuse_counts_beyond(text);
    const std::string tidy = tidied(text, false);
    const std::size_t begin = begin_of_mesh(tidy);
    if (begin == tidy.npos)
      throw InputError(fmt::format("no {} (what can be read: {})",
                                   format == ModelFormat::msh ? "mesh" : "model",
                                   model_extensions));
    const std::string mesh = tidy.substr(begin);
    const std::string readable = is_ascii(mesh) ? as_gmsh_wants(mesh) : mesh;
    if (readable != text && readable != text + "\n") give(mesh_name, readable);
  }
}

Deck read_deck_of(const std::filesystem::path& model) {
  const std::string text = is_gzipped(model) ? unpacked_text(model) : file_text(model);
  refuse_utf16(text);
  return read_deck(tidied(text, true), folder_of(model));
}

}  // namespace airybench
