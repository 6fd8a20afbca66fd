// A solver's work on a mesh of one's own choice, judged: outside MESH [METHOD].
#include <cstdio>
#include <exception>
#include <memory>

#include "assembly/problem/pose.hpp"
#include "mesh/msh_format.hpp"
#include "solvers/methods.hpp"
#include "verify/verifier.hpp"

int main(int count, char** arguments) try {
  using namespace airybench;
  if (count < 2) return 2;
  const auto problem = std::make_shared<const Problem>(pose(Scene{}, read_msh(arguments[1])));
  const Method method = select_methods(count > 2 ? arguments[2] : "HYBRID").front();
  const auto system = assemble(method, problem);
  const Solution solution = run(method, *system, {});
  const Reference reference = compute_reference(contact_system(problem));
  const Verification verified = verify(*system, solution, &reference);
  std::printf("%s: resultant %.6f N, error of the stresses %.1e\n", method.name.c_str(),
              *verified.normal_resultant_N, *verified.error_stress);
  return solution.status == Status::ok && *verified.error_stress < 1e-9 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "outside: %s\n", error.what());
  return 1;
}
