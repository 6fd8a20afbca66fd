"""Executes notebooks of this folder, all or those named; --write keeps their outputs.  run.py [--write] [NAME ...]"""
import argparse
import os
import sys
import tempfile
from pathlib import Path

import nbformat
from jupyter_client import AsyncKernelManager
from jupyter_client.kernelspec import KernelSpec
from nbclient import NotebookClient

FOLDER = Path(__file__).resolve().parent


class Kernel(AsyncKernelManager):
    """Of the Python that runs this file, whatever Jupyter has installed."""

    kernel_spec = KernelSpec(argv=[sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"],
                             display_name="Python 3", language="python")


def execute(file: Path, folder: str, timeout_s: int = 600) -> nbformat.NotebookNode:
    """The notebook with its outputs, run in the folder.."""
    notebook = nbformat.read(file, as_version=4)
    modules = [str(Path(entry).resolve()) for entry in os.environ.get("PYTHONPATH", "").split(os.pathsep) if entry]
    os.environ |= {"IPYTHONDIR": folder, "JUPYTER_RUNTIME_DIR": folder, "PYDEVD_DISABLE_FILE_VALIDATION": "1",
                   "MPLBACKEND": "module://matplotlib_inline.backend_inline", "PYTHONPATH": os.pathsep.join(modules)}
    NotebookClient(notebook, kernel_manager_class=Kernel, timeout=timeout_s,
                   resources={"metadata": {"path": folder}}).execute()
    return notebook


def strip(notebook: nbformat.NotebookNode) -> None:
    """Removes what differs between machines and times: metadata, progress on stderr, the pieces of a stream."""
    notebook.metadata.pop("language_info", None)
    for number, cell in enumerate(notebook.cells, 1):
        cell.id, cell.metadata = f"cell-{number}", {}
        outputs, cell.outputs = cell.get("outputs", []), []
        for output in outputs:
            last = cell.outputs[-1] if cell.outputs else {}
            if output.get("name") == last.get("name") == "stdout":
                last.text += output.text
            elif output.get("name") != "stderr":
                cell.outputs.append(output)
        if cell.cell_type != "code":
            del cell["outputs"]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("names", nargs="*", help="without .ipynb")
    options = parser.parse_args()
    for source in [FOLDER / f"{name}.ipynb" for name in options.names] or sorted(FOLDER.glob("*.ipynb")):
        with tempfile.TemporaryDirectory() as empty:
            done = execute(source, empty)
        if options.write:
            strip(done)
            nbformat.write(done, source)
