// Cases whose answer somebody else states: a file NAME.json of the folder validation, beside its
// model. docs/validation.md explains the keys.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/plan/scene_file.hpp"

namespace airybench {

// A number that a source states, or a profile of them, and where it is in our answer: of a face
// (part_answer.hpp, its members, or a column of NAME.faces.csv at points), at points, or of the
// part.
struct PublishedQuantity {
  std::string name, unit;
  std::vector<double> values;          // one, or one per point
  std::vector<Eigen::Vector2d> at_mm;  // empty: of a face or the part as a whole
  std::string formula;                 // of the values, or where they are printed
  double allowed = 0;                  // deviation, relative to the largest
  std::string because;                 // what the source idealises, or how many digits it prints
  std::string face;                    // of a pair its first; empty: none
  std::string of;    // "pressure_MPa", "closed_mm", "sxx_MPa", "ux_mm", "von_mises_MPa" …
  double times = 1;  // our number by this is the published one

  bool is_profile() const { return values.size() > 1; }
  double largest() const;  // of the values, in size
};

struct PublishedCase {
  std::string name;  // of its file
  std::string title, source;
  std::filesystem::path model;     // or a mesh of the catalogue
  std::optional<SceneFile> scene;  // empty: the deck's own
  double error = 0.001;            // total error that the mesh is adapted to
  std::string degree = "auto";
  std::vector<PublishedQuantity> quantities;

  std::vector<Eigen::Vector2d> points_mm() const;  // of its quantities
  bool asks_largest_stress() const;                // of the part, which adaptation then looks at
};

// Throws FileError, one line: file, key, value, what is allowed.
PublishedCase read_published_case(const std::filesystem::path& file);
// All of the folder, or those whose names match a comma-separated list of globs; by name. Throws
// UsageError.
std::vector<PublishedCase> published_cases(const std::string& selection);

}  // namespace airybench
