"""solve_problem.py for the harness:  answer_problem.py INPUT OUTPUT"""
import sys
from pathlib import Path
from time import perf_counter

import numpy as np
from solve_problem import contact_forces, read, responses

sys.path.append(str(Path(__file__).resolve().parents[1]))
from answer import write_answer  # noqa: E402


def solve(problem):
    times = [perf_counter()]
    x, u_C = responses(*(problem[name] for name in ("S", "C_F", "C_C", "q", "F", "F0")))
    times.append(perf_counter())
    F_C = contact_forces(u_C[:, :-1], u_C[:, -1] - problem["gap"], problem["mu"])
    times.append(perf_counter())
    x = x @ np.append(F_C, 1)
    times.append(perf_counter())
    return x, F_C, times


if __name__ == "__main__":
    _, folder, output = sys.argv
    problem = read(folder)
    none = np.zeros(0)
    if "C_C" not in problem:  # no contact
        problem |= {"C_C": problem["C_F"][:0], "F0": none, "gap": none, "mu": none}
    try:
        x, F_C, times = solve(problem)
        stages = dict(zip(("condense", "contact", "recover"), np.diff(times)))
        write_answer(output, {"x": x, "F_C": F_C}, status="ok", message="", time_s=times[-1] - times[0],
                     stages=stages, parameters="SuperLU, one step of refinement; Newton to 1e-13")
    except (ArithmeticError, np.linalg.LinAlgError, RuntimeError) as wrong:
        status = "not_converged" if isinstance(wrong, ArithmeticError) else "breakdown"
        write_answer(output, {}, status=status, message=str(wrong), time_s=0)
