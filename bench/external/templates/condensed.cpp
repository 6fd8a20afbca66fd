// Contact forces of a condensed problem:  NAME INPUT OUTPUT  (docs/your-program.md)
//
//     r = D F - G - gap      per contact point a normal row, then (with friction) a tangential one
//     F_n <= 0, r_n <= 0, F_n r_n = 0;  |F_t| <= mu |F_n|, F_t r_t <= 0, r_t = 0 unless it slips
//
// Build it with Eigen:  g++ -O2 -std=c++17 -I/usr/include/eigen3 -o NAME NAME.cpp
//
// It takes problems in the plane, with one or two components per point; in space there are three.
// F in N per mm of thickness, r, G and gap in mm, D in mm/N. Replace contact_forces() by your
// method.
#include <chrono>
#include <iostream>

#include "matrix_market.hpp"

#include "contact_forces.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cout << "NAME 1\n";  // its version
    return argc == 2 ? 0 : 2;
  }
  const std::string input = std::string(argv[1]) + "/", output = argv[2];
  const MatrixXd D = read(input + "D.mtx");
  const VectorXd G = read(input + "G.mtx"), gap = read(input + "gap.mtx"),
                 mu = read(input + "mu.mtx");
  const auto start = std::chrono::steady_clock::now();
  std::string status = "ok", message;
  int steps = 0;
  VectorXd F;
  try {
    F = contact_forces(D, -G - gap, mu, steps);
  } catch (const NotConverged& why) {
    status = "not_converged";
    message = why.what();
  } catch (const std::runtime_error& why) {
    status = "breakdown";
    message = why.what();
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  if (status == "ok") write(output + "/F_C.mtx", F);
  write_answer(output, status, message, steps, taken.count());
}
