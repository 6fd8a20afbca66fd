"""Names of methods: the paper's are aliases of general ones, KRYLOV:PRECONDITIONER."""
from __future__ import annotations

ALIASES = {"SDTIC3": "SYMMLQ:DTIC3", "SDTIC6": "SYMMLQ:DTIC6", "SSKY": "SYMMLQ:SKY",
           "3STEPCG3": "3STEPCG:DTIC3", "3STEPCG6": "3STEPCG:DTIC6"}
PAPER_NAMES = {general: alias for alias, general in ALIASES.items()}
# Of Figs 4 and 5, in their order, and ours beside them.
SEVEN = ("SDTIC3", "3STEPCG3", "SDTIC6", "3STEPCG6", "SSKY", "3STEPD", "ALM")
COMPARED = (*SEVEN, "BLIND", "HYBRID")
KRYLOV = ("SYMMLQ", "3STEPCG")
FAMILIES = {"DTIC": range(3, 7), "FLIC": range(1, 6)}  # and SSOR, SKY, NONE


def general(method: str) -> str:
    """SDTIC3 -> SYMMLQ:DTIC3, SYMMLQ:SSOR1 -> SYMMLQ:SSOR1.0; others as they are."""
    krylov, colon, preconditioner = ALIASES.get(method, method).partition(":")
    omega = relaxation(preconditioner)
    return f"{krylov}:SSOR{omega!r}" if omega is not None else krylov + colon + preconditioner


def compared(method: str) -> str | None:
    """The method's name in Figs 4 and 5; None: it is not there."""
    name = PAPER_NAMES.get(general(method), method)
    return name if name in COMPARED else None


def relaxation(preconditioner: str) -> float | None:
    """omega of SSOR<omega>, 0 < omega < 2; None: another preconditioner."""
    try:
        omega = float(preconditioner.removeprefix("SSOR"))
    except ValueError:
        return None
    return omega if preconditioner.startswith("SSOR") and 0 < omega < 2 else None


def preconditioned(method: str) -> tuple[str, str, float] | None:
    """Krylov method, family and parameter (SKY, NONE: 0) of Fig. 3; None: it is not there."""
    krylov, _, name = general(method).partition(":")
    if krylov not in KRYLOV:
        return None
    if name in ("SKY", "NONE"):
        return krylov, name, 0
    for family, levels in FAMILIES.items():
        if name in [f"{family}{level}" for level in levels]:
            return krylov, family, float(name.removeprefix(family))
    omega = relaxation(name)
    return None if omega is None else (krylov, "SSOR", omega)
