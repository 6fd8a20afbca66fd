// The cases of one stop and one scene, found under any of their method's names.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/records/record_reader.hpp"

namespace airybench {

// The paper's names for methods that have a general one, as its sentences use them.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 5> paper_names = {{
    {"SDTIC3", "SYMMLQ:DTIC3"},
    {"SDTIC6", "SYMMLQ:DTIC6"},
    {"SSKY", "SYMMLQ:SKY"},
    {"3STEPCG3", "3STEPCG:DTIC3"},
    {"3STEPCG6", "3STEPCG:DTIC6"},
}};

class CaseTable {
 public:
  // Keeps the records of the stop and of the default scene, or of the only scene there is; a direct
  // method (no stop of its own to choose) that has none of this stop serves with the other one's.
  // Of several records of a case the last one counts. Throws RecordError: several scenes, none of
  // them the default one; `source` is the file that it names.
  CaseTable(const std::vector<Record>& records, const std::string& stop, const std::string& source);

  const Record* find(const std::string& mesh, const std::string& method) const;  // or null
  const std::vector<std::string>& meshes() const { return meshes_; }  // as they first appear
  std::vector<std::string> methods(const std::string& mesh) const;    // general names, sorted
  const std::string& scene() const { return scene_; }
  std::size_t size() const { return cases_.size(); }

 private:
  std::string scene_ = "default";
  std::vector<std::string> meshes_;
  std::map<std::pair<std::string, std::string>, Record> cases_;  // (mesh, general name)
};

}  // namespace airybench
