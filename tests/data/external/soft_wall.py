"""Contact with a soft wall, for figures along a parameter:  soft_wall.py STIFFNESS INPUT OUTPUT

STIFFNESS: of the wall at each contact point, over the body's own there.
"""
import sys
from pathlib import Path
from time import perf_counter

import numpy as np

PEERS = Path(__file__).resolve().parents[3] / "peers"
sys.path += [str(PEERS), str(PEERS / "scipy")]
from answer import write_answer  # noqa: E402
from solve_problem import contact_forces  # noqa: E402

stiffness, folder, output = sys.argv[1:]
problem = np.load(Path(folder, "problem.npz"))
D, G, gap, mu = (problem[name] for name in ("D", "G", "gap", "mu"))
start = perf_counter()
F_C = contact_forces(D + np.diag(np.diag(D)) / float(stiffness), -G - gap, mu)
write_answer(output, {"F_C": F_C}, status="ok", message="", time_s=perf_counter() - start)
