// What an engineer asks of a part: forces, pressure and contact by face, reactions, the largest
// stress and displacement. Written as NAME.answer.json next to the fields.
//
// Largest values are those of samples of the stresses' polynomials, 28 a third. Where the
// exact stress is infinite (a corner of more than 180°, the end of a support or of a face that
// sticks) they would grow with every refinement; such places are named, and the largest stress is
// that of the body outside their circles (singular_places.hpp), so that it is the same on every
// mesh.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure/field_files.hpp"
#include "bench/measure/singular_places.hpp"
#include "bench/records/json.hpp"

namespace airybench {

struct ValueAt {
  double value = 0;
  Eigen::Vector2d at_mm = {0, 0};
};

struct FaceAnswer {
  std::vector<std::string> labels;        // "contact:sole"; of a pair two
  Eigen::Vector2d force_N = {0, 0};       // on its body, of a pair on the first
  double normal_N = 0, tangential_N = 0;  // Σ F_n, Σ F_t
  double length_mm = 0, closed_mm = 0,
         slipping_mm = 0;               // of it: in contact, of that: slipping (contact_zones.hpp)
  ValueAt pressure_MPa;                 // of a pair on both
  std::optional<FaceIntervals> within;  // empty: not known
};

struct SupportAnswer {
  std::string name;
  Eigen::Vector2d force_N = {0, 0};  // on the body
};

struct LargestStress : ValueAt {  // MPa
  int triangle = -1;              // −1: no stress
  // An estimate of what it is off by, as that of the largest pressure (contact_intervals.hpp):
  // twice the sum of what the largest stress of the displacements differs by, of the mean error
  // that the triangle's e_T² allows, and of what errors elsewhere change.
  std::optional<double> off_MPa;
};

struct LargestStresses {
  LargestStress von_mises, principal;  // principal: the largest by magnitude, with its sign
};

struct PartAnswer {
  std::vector<FaceAnswer> faces;
  std::vector<SupportAnswer> supports;
  std::vector<PointSupport> point_supports;
  std::optional<ValueAt> displacement_mm;
  std::string free_motion;  // that nothing determines, nor the displacement; empty: there is none
  LargestStresses stress;
  // By name; one alone, and those without stress, are left out.
  std::vector<std::pair<std::string, LargestStresses>> bodies;
  std::vector<SingularPlace> unbounded;
};

struct PartFiles {
  PartAnswer answer;
  std::string faces_csv;  // NAME.faces.csv of field_files.hpp
};

// Of the body; stresses are the method's own. contact: of these fields.
PartFiles part_files(const SolvedFields& fields, const ContactPicture& contact);

// How far the largest stress may be off, and where refinement shows it.
struct StressDoubt {
  double relative = 0;         // off_MPa over the value: the worse of von Mises and principal
  std::vector<int> triangles;  // with stresses within off_MPa of the largest
};
// Of those that do not lie at the circle of a singular place; empty: both do, or nothing is known.
std::optional<StressDoubt> stress_doubt(const SolvedFields& fields);

Json to_json(const PartAnswer& answer);

// √(σ:σ 3/2 − …) of (xx, yy, xy) and σ_zz.
double von_mises(const Eigen::Vector3d& stress, double stress_zz);
// At x in a triangle: σ_zz = ν (σ_xx + σ_yy), less that of thermal strain; 0 in plane stress.
double stress_zz(const Problem& problem, int triangle, const Eigen::Vector2d& x,
                 const Eigen::Vector3d& stress);
double von_mises(const Problem& problem, int triangle, const Eigen::Vector2d& x,
                 const Eigen::Vector3d& stress);
// The in-plane principal stresses, the larger first.
Eigen::Vector2d principal_stresses(const Eigen::Vector3d& stress);

}  // namespace airybench
