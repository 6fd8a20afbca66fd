// Writes the fields of a path of load steps, step by step.
//
//   NAME.steps/0001.*  step 1: the files of write_fields(), without error and mean. Of a path of
//                      more than max_step_bodies steps so many, evenly spread, have all files; the
//                      others have those of the contact points
//   NAME.pvd, NAME.contact.pvd  ParaView's series of their .vtu; the time is the number of the step
//   NAME.steps.csv     step, normal_resultant_N, tangential_resultant_N, dissipation_Nmm, n_open,
//                      n_stick, n_slip, held_x_mm, held_y_mm, loaded_x_mm, loaded_y_mm, piece,
//                      same_loads_as, fields
//
// piece: of the mesh, from 1, with contact, that the path moves: the one whose supports are moved
// farthest, else the first with a traction, else the first. held, loaded: mean displacement of its
// supports that are moved, of all if none is, and of its edges of Γ_F with a traction in any step;
// empty if unknown. same_loads_as: the first step with the loads, prescribed displacements and gaps
// of this one, itself if they are new. fields: body or contact. Series and table are replaced after
// each step, when its files are complete: a killed process leaves those of the steps so far.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/measure/field_files.hpp"
#include "bench/measure/load_step_runs.hpp"

namespace airybench {

inline constexpr int max_step_bodies = 100;

// step: from 0. True for all steps of a path of at most max_step_bodies, and for every last one.
bool keeps_body(int step, int count);

// Removes what an earlier path left under this name; files of other names stay.
void remove_step_fields(const std::filesystem::path& folder, const std::string& name);
// And what write_fields() left.
void remove_fields(const std::filesystem::path& folder, const std::string& name);

class StepFields {
 public:
  StepFields(std::filesystem::path folder, std::string name, const Problem& first);

  // In the order of the steps; throws FileError. Returns the table's word in `fields`.
  std::string write(int step, const SolvedFields& fields, const JudgedStep& judged);

 private:
  std::filesystem::path folder_;
  std::string name_;
  int count_;
  int piece_ = 0;                   // from 0
  std::vector<int> held_, loaded_;  // rows of Mesh::boundary
  std::string series_, contact_series_, table_;
  std::vector<int> first_with_loads_;  // per step, from 0
};

}  // namespace airybench
