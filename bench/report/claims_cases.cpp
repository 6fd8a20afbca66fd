#include "bench/report/claims_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace airybench {
namespace {

std::string scene_of(const std::vector<Record>& records, const std::string& source) {
  std::set<std::string> scenes;
  for (const Record& record : records) scenes.insert(record.scene);
  if (scenes.empty() || scenes.count("default") > 0) return "default";
  if (scenes.size() > 1)
    throw RecordError(
        fmt::format("{}: scene: {} and {} (allowed: default among them, or one scene alone)",
                    source, *scenes.begin(), *std::next(scenes.begin())));
  return *scenes.begin();
}

}  // namespace

CaseTable::CaseTable(const std::vector<Record>& records, const std::string& stop,
                     const std::string& source)
    : scene_(scene_of(records, source)) {
  for (const bool of_this_stop : {false, true})  // the second replaces the first
    for (const Record& record : records) {
      if (record.scene == scene_ && !name_of(record).contact &&
          (name_of(record.stop) == stop) == of_this_stop && (of_this_stop || !record.iterative))
        cases_[{record.mesh, record.general_name}] = record;
    }
  for (const Record& record : records)
    if (!methods(record.mesh).empty() &&
        std::find(meshes_.begin(), meshes_.end(), record.mesh) == meshes_.end())
      meshes_.push_back(record.mesh);
}

const Record* CaseTable::find(const std::string& mesh, const std::string& method) const {
  std::string name = method;
  for (const auto& [of_paper, general] : paper_names)
    if (method == of_paper) name = general;
  const auto found = cases_.find({mesh, name});
  return found == cases_.end() ? nullptr : &found->second;
}

std::vector<std::string> CaseTable::methods(const std::string& mesh) const {
  std::vector<std::string> names;
  for (auto at = cases_.lower_bound({mesh, ""}); at != cases_.end() && at->first.first == mesh;
       ++at)
    names.push_back(at->first.second);
  return names;
}

}  // namespace airybench
