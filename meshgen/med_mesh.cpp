#include "meshgen/med_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "meshgen/foreign_mesh.hpp"
#include "support/errors.hpp"
#include "support/hdf5_handle.hpp"

namespace airybench {
namespace {

// A path in the file, whose links lead nowhere else.
class MedFile {
 public:
  explicit MedFile(const std::filesystem::path& path) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // no messages from libhdf5
    H5PLset_loading_state(0);                     // and no filters that it loads
    file_ = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file_ < 0) throw InputError("it cannot be opened (allowed: an HDF5 file)");
  }
  ~MedFile() { H5Fclose(file_); }
  MedFile(const MedFile&) = delete;
  MedFile& operator=(const MedFile&) = delete;

  bool has(const std::string& path) const {
    for (std::size_t slash = path.find('/', 1);; slash = path.find('/', slash + 1)) {
      const std::string part = path.substr(0, slash);
      H5L_info_t link;
      if (H5Lget_info(file_, part.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
        return false;
      if (slash == path.npos) return true;
    }
  }
  std::vector<std::string> children(const std::string& path) const {
    if (!has(path)) return {};
    const Handle group(undamaged(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), path), H5Gclose);
    H5G_info_t info;
    H5Gget_info(group, &info);
    std::vector<std::string> names;
    for (hsize_t k = 0; k < info.nlinks; ++k) {
      char name[256] = "";
      H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT);
      names.emplace_back(name);
    }
    return names;
  }
  std::string only_child(const std::string& path) const {
    const std::vector<std::string> names = children(path);
    if (names.size() != 1)
      throw InputError(fmt::format("{}: {} of them (allowed: one)", path, names.size()));
    return path + "/" + names.front();
  }
  long attribute(const std::string& path, const char* name) const {
    long value = 0;
    const Handle object(undamaged(H5Oopen(file_, path.c_str(), H5P_DEFAULT), path), H5Oclose);
    if (H5Aexists(object, name) <= 0) throw InputError(fmt::format("{}: no {}", path, name));
    const Handle attribute(undamaged(H5Aopen(object, name, H5P_DEFAULT), path), H5Aclose),
        space(undamaged(H5Aget_space(attribute), path), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1 || H5Aread(attribute, H5T_NATIVE_LONG, &value) < 0)
      throw InputError(fmt::format("{}: {} is no whole number", path, name));
    return value;
  }
  template <typename Value>
  std::vector<Value> values(const std::string& path, hid_t type) const {
    return read<Value>(path, [&](hid_t) { return H5Tcopy(type); });
  }
  // Of texts that are arrays of bytes.
  std::vector<std::string> names(const std::string& path) const {
    std::size_t length = 0;
    const std::vector<char> bytes = read<char>(path, [&](hid_t set) {
      const hid_t own = H5Dget_type(set);
      length = H5Tget_size(own);
      return own;
    });
    std::vector<std::string> texts;
    for (std::size_t k = 0; length > 0 && k + length <= bytes.size(); k += length) {
      std::string text(bytes.begin() + static_cast<std::ptrdiff_t>(k),
                       bytes.begin() + static_cast<std::ptrdiff_t>(k + length));
      text = text.c_str();
      texts.push_back(text.substr(0, text.find_last_not_of(' ') + 1));
    }
    return texts;
  }

 private:
  static hid_t undamaged(hid_t id, const std::string& path) {
    if (id < 0) throw InputError(fmt::format("{} is damaged, or of another kind", path));
    return id;
  }
  template <typename Value, typename TypeOf>
  std::vector<Value> read(const std::string& path, const TypeOf& type_of) const {
    constexpr std::size_t max_bytes = 2'000'000'000;
    if (!has(path)) throw InputError(fmt::format("there is no {}", path));
    const Handle set(undamaged(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), path), H5Dclose),
        space(undamaged(H5Dget_space(set), path), H5Sclose),
        made(undamaged(H5Dget_create_plist(set), path), H5Pclose),
        type(undamaged(type_of(set), path), H5Tclose);
    if (H5Pget_layout(made) == H5D_VIRTUAL || H5Pget_external_count(made) > 0)
      throw InputError(fmt::format("{} is in another file", path));
    const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
    const std::size_t bytes = count * H5Tget_size(type);
    if (count > max_bytes || bytes > max_bytes)
      throw InputError(fmt::format("{}: {} values (allowed: up to 2 GB)", path, count));
    // Of one byte deflate makes 1032 at most, and a number of 8; the rest was never written.
    const std::size_t factor = H5Pget_nfilters(made) > 0 ? 8 * 1100 : 8;
    if (H5Dget_storage_size(set) == 0 || H5Dget_storage_size(set) < bytes / factor)
      throw InputError(fmt::format("{}: {} values, which are not in the file", path, count));
    std::vector<Value> values(bytes / sizeof(Value));
    if (H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      throw InputError(fmt::format("{} cannot be read", path));
    return values;
  }

  hid_t file_;
};

struct CellType {
  const char* name;
  std::size_t nodes, corners;  // corners first, as in Gmsh
};
constexpr auto cell_types = std::to_array<CellType>(
    {{"SE2", 2, 2}, {"SE3", 3, 2}, {"TR3", 3, 3}, {"TR6", 6, 3}, {"QU4", 4, 4}, {"QU8", 8, 4}});

}  // namespace

std::string msh_of_med(const std::filesystem::path& path) {
  const MedFile file(path);
  const std::string whole = file.only_child("/ENS_MAA"),
                    mesh = file.has(whole + "/NOE") ? whole : file.only_child(whole);
  Deck deck;
  // Component by component: all x, then all y.
  const std::vector<double> x = file.values<double>(mesh + "/NOE/COO", H5T_NATIVE_DOUBLE);
  const auto components = static_cast<std::size_t>(file.attribute(whole, "ESP"));
  if (components != 2 && components != 3)
    throw InputError(fmt::format("{} coordinates a node (allowed: 2, 3)", components));
  const std::size_t count = x.size() / components;
  for (std::size_t k = 0; k < count; ++k)
    deck.nodes[static_cast<long>(k) + 1] = {x[k], x[count + k],
                                            components == 3 ? x[2 * count + k] : 0};

  std::map<long, std::vector<std::string>> groups_of_family;
  const std::string families = "/FAS" + whole.substr(whole.rfind('/')) + "/ELEME";
  for (const std::string& family : file.children(families))
    if (const std::string own = families + "/" + family; file.has(own + "/GRO/NOM"))
      groups_of_family[file.attribute(own, "NUM")] = file.names(own + "/GRO/NOM");

  for (const std::string& name : file.children(mesh + "/MAI")) {
    if (name == "PO1") continue;
    const auto* const type = std::ranges::find(cell_types, name, &CellType::name);
    if (type == cell_types.end())
      throw InputError(
          fmt::format("cells of type {} (allowed: of a plane body: TR3, TR6, QU4, QU8)", name));
    const std::string cells_at = mesh + "/MAI/" + name;
    const std::vector<long> nodes = file.values<long>(cells_at + "/NOD", H5T_NATIVE_LONG);
    std::vector<long> family;
    if (file.has(cells_at + "/FAM")) family = file.values<long>(cells_at + "/FAM", H5T_NATIVE_LONG);
    const std::size_t cells = nodes.size() / type->nodes;
    family.resize(cells);
    for (std::size_t k = 0; k < cells; ++k) {
      std::vector<long> own;
      for (std::size_t j = 0; j < type->nodes; ++j) {
        own.push_back(nodes[j * cells + k]);
        if (!deck.nodes.contains(own.back()))
          throw InputError(fmt::format("{}: cell {}: node {} (allowed: 1 to {})", name, k + 1,
                                       own.back(), count));
      }
      const std::vector<std::string>& groups = groups_of_family[family[k]];
      if (type->corners == 2) {
        if (!groups.empty())
          deck.names[deck_edge(own[0], own[1])].insert(groups.begin(), groups.end());
        continue;
      }
      add_plane_element(deck, std::move(own), type->corners,
                        groups.empty() ? "body" : groups.front());
    }
  }
  if (deck.elements.empty()) throw InputError("no triangles or quadrilaterals");
  return msh_of(deck, curves_by_names(deck));
}

}  // namespace airybench
