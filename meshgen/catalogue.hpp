// The eight meshes of the paper's Tab. 1.
//
// n_φ = 3V + E = 6V − B − 3 counts all HCT degrees of freedom of V vertices and E edges, B of them
// on the boundary; n_f and n_C are 4 per force and contact edge. Tab. 1 gives no edges on the
// displacement boundary: they are our choice, such that V is whole. Mesh0's printed n_C = 38 is not
// a multiple of 4; the mesh has 40.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "mesh/mesh.hpp"
#include "meshgen/tooth_geometry.hpp"

namespace airybench {

struct CatalogueRow {
  std::string_view name;
  int teeth;
  EdgeCounts edges;
  int vertices;
  int paper_n_phi, paper_n_f, paper_n_c;  // as printed in Tab. 1
};

inline constexpr std::array<CatalogueRow, 8> catalogue = {{
    {"Mesh0", 1, {6, 24, 10}, 134, 761, 96, 38},
    {"Mesh1", 1, {8, 36, 20}, 340, 1973, 144, 80},
    {"Mesh2", 1, {10, 44, 30}, 532, 3105, 176, 120},
    {"Mesh3", 1, {14, 58, 40}, 1067, 6287, 232, 160},
    {"Mesh4", 4, {21, 98, 50}, 1422, 8360, 392, 200},
    {"Mesh5", 4, {30, 147, 120}, 3238, 19128, 588, 480},
    {"Mesh6", 4, {36, 177, 144}, 4483, 26538, 708, 576},
    {"Mesh7", 4, {40, 230, 160}, 8486, 50483, 920, 640},
}};

// What Mesh0 has where Tab. 1 prints 38.
inline constexpr int mesh0_n_c = 40;

// The version of Gmsh that made the files in meshgen/meshes.
inline constexpr std::string_view catalogue_gmsh_version = "4.8.4";

// No mesh of the catalogue has a smaller angle.
inline constexpr double catalogue_least_angle_deg = 20;

// Throws std::invalid_argument for a name not in the catalogue.
const CatalogueRow& catalogue_row(std::string_view name);

// Makes the mesh again; needs a GmshSession. Throws as tooth_mesh does.
Mesh make_catalogue_mesh(const CatalogueRow& row);

}  // namespace airybench
