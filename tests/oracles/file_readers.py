"""Writes file_readers.json: what trimesh reads in the files of tests/ts/support/made-files.mjs.

Run: pip install trimesh==5.2.0 numpy==2.4.6; python file_readers.py (needs node)

Each file as trimesh gives it without processing: the box of what its faces use, the number of triangles and the area; or null, where it
refuses the file, finds no surface, one that is not finite, or one that uses vertices that are not there.
"""

import json
import pathlib
import subprocess
import tempfile

import numpy as np
import trimesh

here = pathlib.Path(__file__).parent


def read(path):
    try:
        mesh = trimesh.load(path, process=False, force="mesh")
    except Exception:
        return None
    faces = getattr(mesh, "faces", ())
    if len(faces) == 0 or np.min(faces) < 0 or np.max(faces) >= len(mesh.vertices):
        return None
    used = np.asarray(mesh.vertices)[np.unique(faces)]
    if not np.isfinite(used).all():
        return None
    return {"low": used.min(0).tolist(), "high": used.max(0).tolist(), "triangles": len(faces), "area": float(mesh.area)}


with tempfile.TemporaryDirectory() as folder:
    subprocess.run(["node", here.parent / "ts" / "support" / "made-files.mjs", folder], check=True)
    found = {path.name: read(path) for path in sorted(pathlib.Path(folder).iterdir())}
(here / "file_readers.json").write_text(
    "{\n" + ",\n".join(f"  {json.dumps(name)}: {json.dumps(each)}" for name, each in found.items()) + "\n}\n"
)
