# %% [markdown]
# # Records in a notebook
# Open this file in Jupyter (with jupytext), VS Code or Spyder, or run it from the root of the repository:
# `python3 docs/notebook.py`. It needs pandas and matplotlib, and reads committed records only.

# %%
from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

RESULTS = Path("results")


def read(folder: str) -> pd.DataFrame:
    """A row per case, a column per key; results/README.md explains the keys."""
    packed = RESULTS / folder / "records.jsonl.gz"
    return pd.read_json(packed if packed.exists() else packed.with_suffix(""), lines=True)


# %% [markdown]
# ## Time and error
# No time without its error: `error_force` is relative, against an accurate solution of the same equations.
# Of each method with the paper's stopping rule there is a second record, `stop` says which.

# %%
paper = read("paper")
one_mesh = paper[(paper.mesh == "Mesh3") & (paper.status != "timeout") & ~paper.method.str.contains(":")]
table = one_mesh[["method", "stop", "status", "time_s", "error_force"]].sort_values(["stop", "time_s"])
print("\nMesh3: median time of one solve and error of the contact forces")
print(table.to_string(index=False, formatters={"time_s": "{:.4f}".format, "error_force": "{:.1e}".format}))

# %% [markdown]
# By the paper's rule the methods that iterate stop early: such a time belongs to a larger error, and is not
# comparable with the time of a direct method until both are read together.

# %% [markdown]
# ## Error against time
# On adapted meshes `error_total` is the error of mesh and method together, and `adapt_time_s` the time of the
# whole adaptive loop. A straight line is a power law: how much time the next digit costs.

# %%
degrees = read("degrees")
tooth = degrees[degrees.mesh.str.startswith("Mesh0+adapt") & (degrees.family == "HYBRID")]
figure, axes = plt.subplots(figsize=(5, 3.5), layout="constrained")
for degree, loop in tooth.sort_values("adapt_time_s").groupby("degree"):
    axes.loglog(loop.adapt_time_s, loop.error_total, marker="o", label=f"degree {degree}")
axes.set(xlabel="time of the loop, s", ylabel="total error", title="One tooth, adapted")
axes.grid(which="major", color="0.9")
axes.legend(frameon=False)
figure.savefig("notebook.png", dpi=120)

# %% [markdown]
# ## Which method is faster?
# Compare methods on the same mesh and *within one run*: machine, libraries and noise are then the same, and a
# ratio says what two times of different runs do not. Where the intervals of two medians overlap, neither is
# known to be faster.

# %%
direct = read("direct")
direct = direct[(direct.status == "ok") & ~direct.mesh.str.contains("+", regex=False)]
times = direct.pivot(index="method", columns="mesh", values="time_s")
ratios = times / times.loc["HYBRID"]
print("\nTime over HYBRID's, same mesh and run")
print(ratios.sort_values("Mesh7").round(1).to_string())

# %%
hybrid = direct[direct.method == "HYBRID"].set_index("mesh")
joined = direct.join(hybrid[["time_low_s", "time_high_s"]], on="mesh", rsuffix="_of_hybrid")
ties = joined[(joined.method != "HYBRID") & (joined.time_low_s <= joined.time_high_s_of_hybrid)
              & (joined.time_high_s >= joined.time_low_s_of_hybrid)]
print("\nTies with HYBRID:", ", ".join(ties.mesh + "/" + ties.method) or "none")

# %% [markdown]
# What machine was it? Every record knows; so does `measured.md` of the folder's figures, in words for a paper.

# %%
print("\n" + "\n".join(f"{key}: {direct.context.iloc[0][key]}" for key in ("cpu", "threads", "compiler", "blas")))
