"""What each peer reads and returns, and its library's version or why it cannot run."""
import json
import subprocess
import sys
from pathlib import Path


def declarations():
    for file in sorted(Path(__file__).resolve().parent.glob("*/*.json")):
        yield file.parent, json.loads(file.read_text(encoding="utf-8"))


def version(folder, command):
    """The version, and None; or None, and why there is none."""
    try:
        ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    except OSError as wrong:
        return None, f"{command[0]}: {wrong.strerror}"
    said = (ran.stdout + ran.stderr).strip().split("\n")
    return (said[0], None) if ran.returncode == 0 else (None, said[-1])


if __name__ == "__main__":
    missing = False
    for folder, peer in declarations():
        found, reason = version(folder, peer["version"])
        missing |= reason is not None
        print(f"{peer['name']:20} {peer['reads']:9} -> {peer['returns']:18} {found or 'missing: ' + reason}")
    sys.exit(missing)
