"""Check a wheel: it must be small, contain its data and licenses, and export one symbol only."""

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

path = Path(sys.argv[1])
megabytes = path.stat().st_size / 1e6
with zipfile.ZipFile(path) as wheel, tempfile.TemporaryDirectory() as folder:
    names = wheel.namelist()
    wheel.extractall(folder)
    module = next(
        name for name in names if name.startswith("stickslip/_core") and name.endswith(".so")
    )
    listing = subprocess.run(
        ["nm", "-D", "--defined-only", Path(folder, module)],
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    metadata = next(name for name in names if name.endswith(".dist-info/METADATA"))
    text = wheel.read(metadata).decode()

symbols = [line.split()[-1] for line in listing.splitlines()]
libraries = sorted(name for name in names if name.startswith("stickslip.libs/"))
licenses = sorted(name.rsplit("/", 1)[1] for name in names if ".dist-info/licenses/" in name)
bundled = ("libfftw3", "libgsl-", "libgslcblas", "libsundials_", "libhwy")
wrong = []
if megabytes >= 15:
    wrong.append(f"{megabytes:.1f} MB, must be less than 15")
if symbols != ["PyInit__core"]:
    wrong.append(f"must export PyInit__core only, exports {len(symbols)} symbols: {symbols[:5]}")
for library in bundled:
    if not any(name.startswith(f"stickslip.libs/{library}") for name in libraries):
        wrong.append(f"lacks {library}, has {libraries}")
if "stickslip/thesis_expected.txt" not in names:
    wrong.append("lacks stickslip/thesis_expected.txt")
for license_text in ("LICENSE", "NOTICE.md", "GPL-2.0.txt", "GPL-3.0.txt", "Apache-2.0.txt"):
    if license_text not in licenses:
        wrong.append(f"lacks the license text {license_text}, has {licenses}")
if "License-Expression: " not in text or "GPL-3.0-or-later" not in text:
    wrong.append("its metadata has no License-Expression with GPL-3.0-or-later")
if wrong:
    sys.exit(f"{path.name}: " + "; ".join(wrong))
print(
    f"{path.name}: {megabytes:.1f} MB, {len(libraries)} libraries, one symbol,"
    f" {len(licenses)} license texts"
)
