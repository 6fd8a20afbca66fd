// A body in contact with walls, in displacements:  NAME INPUT OUTPUT  (docs/your-program.md)
//
// Quadratic triangles; at each node of a contact edge u_n <= gap, F_n <= 0 and Coulomb's law, by
// Newton's method on the condensed nodes. Displacements in mm, forces in N per mm of thickness.
//
// Build it with Eigen:  g++ -O2 -std=c++17 -I/usr/include/eigen3 -o NAME NAME.cpp
//
// Replace what is between reading and writing by your method: it returns displacements at all
// vertices, then at the middles of all edges.
#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <array>
#include <chrono>
#include <iostream>
#include <map>
#include <vector>

#include "matrix_market.hpp"

#include "contact_forces.hpp"

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXi;
using Eigen::Vector2d;
using SparseMatrix = Eigen::SparseMatrix<double>;

struct Body {
  MatrixXd vertices, compliance, u0, traction, gap, normals, friction, body_force;
  MatrixXi triangles, edges, boundary, roles, material, rollers;
  std::map<std::array<int, 2>, int> middle;  // node of an edge, by its low and its high vertex
  Index nodes() const { return vertices.rows() + edges.rows(); }
  int middle_of(int a, int b) const { return middle.at({std::min(a, b), std::max(a, b)}); }
};

Body read_body(const std::string& input) {
  const auto real = [&](const char* name) { return read(input + name + ".mtx"); };
  const auto whole = [&](const char* name) { return MatrixXi(real(name).cast<int>()); };
  Body body{real("vertices_mm"),
            real("compliance_per_MPa"),
            real("u0_mm"),
            real("traction_MPa"),
            real("gap_mm"),
            real("contact_normals"),
            real("friction"),
            real("body_force_N_per_mm3"),
            whole("triangles"),
            whole("edges"),
            whole("boundary"),
            whole("boundary_roles"),
            whole("triangle_body"),
            whole("rollers"),
            {}};
  for (int e = 0; e < body.edges.rows(); ++e)
    body.middle[{body.edges(e, 0), body.edges(e, 1)}] = static_cast<int>(body.vertices.rows()) + e;
  return body;
}

// K and the loads of body force and tractions; unknowns 2 node + 0, 1.
SparseMatrix stiffness(const Body& body, VectorXd& load) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index t = 0; t < body.triangles.rows(); ++t) {
    const std::array<int, 3> v = {body.triangles(t, 0), body.triangles(t, 1), body.triangles(t, 2)};
    Eigen::Matrix3d points;
    for (int k = 0; k < 3; ++k) points.row(k) << 1, body.vertices.row(v[k]);
    const double area = points.determinant() / 2;
    const Eigen::Matrix<double, 2, 3> slope = points.inverse().bottomRows<2>();  // of each lambda
    const Eigen::Matrix3d C = body.compliance.row(body.material(t)).reshaped(3, 3);
    const Eigen::Matrix3d elasticity = C.inverse();
    std::array<int, 6> nodes;
    for (int k = 0; k < 3; ++k) {
      nodes[k] = v[k];
      nodes[3 + k] = body.middle_of(v[k], v[(k + 1) % 3]);
    }
    Eigen::Matrix<double, 12, 12> K = Eigen::Matrix<double, 12, 12>::Zero();
    for (int q = 0; q < 3; ++q) {  // the middles of edges integrate it exactly
      Eigen::Vector3d lambda(0.5, 0.5, 0.5);
      lambda(q) = 0;
      Eigen::Matrix<double, 3, 12> strain = Eigen::Matrix<double, 3, 12>::Zero();
      for (int n = 0; n < 6; ++n) {
        const int i = n % 3, j = (n + 1) % 3;
        const Vector2d g =
            n < 3 ? Vector2d((4 * lambda(i) - 1) * slope.col(i))
                  : Vector2d(4 * (lambda(j) * slope.col(i) + lambda(i) * slope.col(j)));
        strain.col(2 * n) << g.x(), 0, g.y();
        strain.col(2 * n + 1) << 0, g.y(), g.x();
      }
      K += area / 3 * strain.transpose() * elasticity * strain;
    }
    for (int n = 0; n < 12; ++n)
      for (int m = 0; m < 12; ++m)
        entries.emplace_back(2 * nodes[n / 2] + n % 2, 2 * nodes[m / 2] + m % 2, K(n, m));
    for (int n = 3; n < 6; ++n)
      load.segment<2>(2 * nodes[n]) += area / 3 * Vector2d(body.body_force.reshaped());
  }
  for (Index row = 0; row < body.boundary.rows(); ++row) {
    const int a = body.boundary(row, 0), b = body.boundary(row, 1);
    const double length = (body.vertices.row(b) - body.vertices.row(a)).norm();
    const Vector2d ta = body.traction.row(row).head<2>(), tb = body.traction.row(row).tail<2>();
    load.segment<2>(2 * a) += length / 6 * ta;  // Simpson's rule, exact
    load.segment<2>(2 * b) += length / 6 * tb;
    load.segment<2>(2 * body.middle_of(a, b)) += length / 3 * (ta + tb);
  }
  SparseMatrix K(load.size(), load.size());
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

// What is known of a node: its frame (columns: first and second direction), and per direction what
// it is.
struct Node {
  enum Kind { free, held, contact };
  Matrix2d frame = Matrix2d::Identity();
  std::array<Kind, 2> kind = {free, free};
  Vector2d value = {0, 0};  // displacement that is given, or the gap
  double friction = 0;
};

std::vector<Node> boundary_nodes(const Body& body) {
  constexpr int displacement = 0, contact = 2;
  std::vector<Node> nodes(static_cast<std::size_t>(body.nodes()));
  const auto in_frame = [](const Vector2d& n) { return Matrix2d{{n.x(), -n.y()}, {n.y(), n.x()}}; };
  const auto visit = [&](int role, auto use) {
    for (Index row = 0; row < body.boundary.rows(); ++row) {
      const int a = body.boundary(row, 0), b = body.boundary(row, 1);
      if (body.roles(row) != role) continue;
      const Vector2d side = body.vertices.row(b) - body.vertices.row(a);
      int k = 0;
      for (const int node : {a, body.middle_of(a, b), b})
        use(nodes[static_cast<std::size_t>(node)], row, k++,
            Vector2d(side.y(), -side.x()).normalized());
    }
  };
  visit(contact, [&](Node& node, Index row, int k, const Vector2d&) {
    const bool is_second = node.kind[0] == Node::contact;
    const Vector2d n = body.normals.row(row).segment<2>(2 * k);
    node.frame = in_frame((is_second ? Vector2d(node.frame.col(0) + n) : n).normalized());
    node.kind = {Node::contact, Node::contact};
    node.value(0) = is_second ? std::min(node.value(0), body.gap(row, k)) : body.gap(row, k);
    const double mu = body.friction(row);
    node.friction = is_second ? std::min(node.friction, mu) : mu;
  });
  visit(displacement, [&](Node& node, Index row, int k, const Vector2d& normal) {
    if (body.rollers(row) == 0) return;
    const Vector2d u = body.u0.row(row).segment<2>(2 * k);
    node.frame = in_frame(normal);
    node.kind = {Node::held, Node::free};
    node.value = {normal.dot(u), 0};
  });
  visit(displacement, [&](Node& node, Index row, int k, const Vector2d&) {
    if (body.rollers(row) == 1) return;
    node.frame.setIdentity();
    node.kind = {Node::held, Node::held};
    node.value = body.u0.row(row).segment<2>(2 * k);
  });
  return nodes;
}

// Displacements, a row per node.
MatrixXd solve(const Body& body, int& steps) {
  const Index size = 2 * body.nodes();
  VectorXd load = VectorXd::Zero(size);
  SparseMatrix K = stiffness(body, load);
  const std::vector<Node> nodes = boundary_nodes(body);
  std::vector<Eigen::Triplet<double>> turned;
  VectorXd u = VectorXd::Zero(size);  // in the nodes' frames
  std::vector<Index> free, contact;
  std::vector<double> gap, mu;
  for (Index node = 0; node < body.nodes(); ++node) {
    const Node& own = nodes[static_cast<std::size_t>(node)];
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) turned.emplace_back(2 * node + i, 2 * node + j, own.frame(i, j));
      if (own.kind[i] == Node::held)
        u(2 * node + i) = own.value(i);
      else
        free.push_back(2 * node + i);
      if (own.kind[i] == Node::contact) contact.push_back(static_cast<Index>(free.size()) - 1);
    }
    if (own.kind[0] == Node::contact) {
      gap.insert(gap.end(), {own.value(0), 0});
      mu.push_back(own.friction);
    }
  }
  SparseMatrix T(size, size), chosen(size, static_cast<Index>(free.size()));
  T.setFromTriplets(turned.begin(), turned.end());
  std::vector<Eigen::Triplet<double>> ones;
  for (std::size_t k = 0; k < free.size(); ++k)
    ones.emplace_back(free[k], static_cast<Index>(k), 1);
  chosen.setFromTriplets(ones.begin(), ones.end());
  K = T.transpose() * K * T;
  const SparseMatrix inner = chosen.transpose() * K * chosen;
  Eigen::SimplicialLDLT<SparseMatrix> factor(inner);
  if (factor.info() != Eigen::Success) throw std::runtime_error("the body is not held");
  VectorXd b = chosen.transpose() * (T.transpose() * load - K * u);
  const auto count = static_cast<Index>(contact.size());
  MatrixXd D(count, count);
  for (Index c = 0; c < count; ++c)
    D.col(c) = factor.solve(VectorXd::Unit(b.size(), contact[c]))(contact);
  const VectorXd without = factor.solve(b);
  const VectorXd F =
      contact_forces(D, without(contact) - Eigen::Map<VectorXd>(gap.data(), count),
                     Eigen::Map<VectorXd>(mu.data(), static_cast<Index>(mu.size())), steps);
  for (Index c = 0; c < count; ++c) b(contact[c]) += F(c);
  u += chosen * factor.solve(b);
  return (T * u).reshaped(2, body.nodes()).transpose();
}

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cout << "NAME 1\n";  // its version
    return argc == 2 ? 0 : 2;
  }
  const std::string output = argv[2];
  const Body body = read_body(std::string(argv[1]) + "/");
  const auto start = std::chrono::steady_clock::now();
  std::string status = "ok", message;
  int steps = 0;
  MatrixXd u;
  try {
    u = solve(body, steps);
  } catch (const NotConverged& why) {
    status = "not_converged";
    message = why.what();
  } catch (const std::runtime_error& why) {
    status = "breakdown";
    message = why.what();
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  if (status == "ok") write(output + "/displacement_mm.mtx", u);
  write_answer(output, status, message, steps, taken.count());
}
