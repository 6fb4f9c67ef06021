"""Check the folder of a release: every file is there, and all state one version."""

import json
import sys
import tarfile
from pathlib import Path

folder, version = Path(sys.argv[1]), sys.argv[2]
wrong = []
names = sorted(path.name for path in folder.iterdir())
sdist = f"stickslip-{version}.tar.gz"
pages = f"stickslip-{version}-documentation.tar.gz"
for name in (sdist, pages, "stickslip.html", "RELEASE.md", "CITATION.cff", ".zenodo.json"):
    if name not in names or not (folder / name).stat().st_size:
        wrong.append(f"lacks {name}")
wheels = [name for name in names if name.endswith(".whl")]
for name in wheels:
    if not name.startswith(f"stickslip-{version}-cp") or "manylinux" not in name:
        wrong.append(f"{name} is not a manylinux wheel of {version}")
if not wheels:
    wrong.append("lacks a wheel")
if not wrong:
    with tarfile.open(folder / sdist) as archive:
        inside = {name.partition("/")[2] for name in archive.getnames()}
    for name in ("pyproject.toml", "CMakeLists.txt", "LICENSE", "licenses/NOTICE.md"):
        if name not in inside:
            wrong.append(f"{sdist} lacks {name}")
    with tarfile.open(folder / pages) as archive:
        if f"stickslip-{version}-documentation/index.html" not in archive.getnames():
            wrong.append(f"{pages} lacks index.html")
    if json.loads((folder / ".zenodo.json").read_text(encoding="utf-8"))["version"] != version:
        wrong.append(f".zenodo.json is not of {version}")
if wrong:
    sys.exit(f"{folder}: " + "; ".join(wrong))
print(f"{folder}: {len(wheels)} wheels, one version")
