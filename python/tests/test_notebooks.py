# SPDX-License-Identifier: MIT
"""The notebooks run from top to bottom, and show what they show in the repository."""

import os
import struct
import unittest

import nbclient
import nbformat

FOLDER = os.path.join(os.path.dirname(__file__), "..", "notebooks")


def shown(cell):
    """What a cell shows: for each output its kinds, and of a picture its size. What is printed comes in
    as many pieces as it happens to."""
    out = []
    for output in cell.get("outputs", []):
        if output["output_type"] == "stream":
            if out[-1:] != ["text"]:
                out.append("text")
            continue
        data = output.get("data", {})
        size = None
        if "image/png" in data:
            import base64
            size = struct.unpack(">II", base64.b64decode(data["image/png"])[16:24])
        out.append((output["output_type"], sorted(data), size))
    return out


class Notebooks(unittest.TestCase):
    maxDiff = None


def add(name):
    def test(self):
        path = os.path.join(FOLDER, name)
        notebook = nbformat.read(path, as_version=4)
        stored = [shown(cell) for cell in notebook.cells]
        pictures = sum(one != "text" and one[2] is not None for cell in stored for one in cell)
        self.assertGreaterEqual(pictures, 1, "the notebook is stored with its pictures")
        nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
        self.assertEqual([shown(cell) for cell in notebook.cells], stored)
        if os.environ.get("KAAMOS_WRITE_NOTEBOOKS") == "1":
            nbformat.write(notebook, path)

    setattr(Notebooks, "test_" + os.path.splitext(name)[0].replace("-", "_"), test)


for file in sorted(os.listdir(FOLDER)):
    if file.endswith(".ipynb"):
        add(file)

if __name__ == "__main__":
    unittest.main()
