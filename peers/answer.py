"""An answer as the harness reads it: vectors first, answer.json last."""
import json
from pathlib import Path

import numpy as np


def write_answer(folder, vectors, **said):
    for name, values in vectors.items():
        columns = np.atleast_2d(np.transpose(values))
        lines = ["%%MatrixMarket matrix array real general", f"{columns.shape[1]} {columns.shape[0]}"]
        Path(folder, f"{name}.mtx").write_text(
            "\n".join(lines + [f"{value:.17g}" for value in columns.ravel()]) + "\n", encoding="ascii")
    Path(folder, "answer.json").write_text(json.dumps(said), encoding="utf-8")
