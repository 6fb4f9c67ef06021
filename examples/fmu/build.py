"""Builds an FMU (FMI 2.0 for co-simulation) of a slider, a friction pendulum bearing or a cart.

    python examples/fmu/build.py slider|bearing|cart OBJECT... [--headers DIR] [--out DIR]

OBJECT is the interface in C, compiled with -fPIC: libstickslip_c.a, or stickslip.o and, for a cart,
the files of src/carts that belong to it. Compiles with
$CC and $CXX, or cc and c++. The headers of FMI come with the package fmpy; --headers names another
folder with them.
"""

import argparse
import hashlib
import importlib.util
import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from xml.etree import ElementTree as ET

HERE = Path(__file__).resolve().parent
STICKSLIP = HERE.parents[1]

# Base units by their exponents, as FMI asks for.
UNITS = {
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "m/s2": {"m": 1, "s": -2},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "kg": {"kg": 1},
    "N": {"kg": 1, "m": 1, "s": -2},
}
INPUTS = [
    ("ground_acceleration", "m/s2", 0.0, "horizontal acceleration of the ground or floor"),
    ("vertical_acceleration", "m/s2", 0.0, "upward acceleration of the ground or floor"),
]
OF_ONE_AXIS = [
    ("displacement", "m", None, "relative to the ground"),
    ("velocity", "m/s", None, "relative to the ground"),
    ("force", "N", None, "horizontal force on the ground, at the end of the step"),
]
OF_A_CART = [
    ("displacement", "m", None, "of the center of mass along the axis, relative to the ground"),
    ("transverse_displacement", "m", None, "the same, 90 degrees clockwise from the axis"),
    ("yaw", "rad", None, "from the axis toward the transverse direction"),
    ("velocity", "m/s", None, "of the center of mass along the axis"),
    ("transverse_velocity", "m/s", None, "the same, 90 degrees clockwise from the axis"),
    ("yaw_rate", "rad/s", None, "from the axis toward the transverse direction"),
]
TRANSVERSE = ("transverse_acceleration", "m/s2", 0.0, "90 degrees clockwise from the axis")
CORNERS = ["front right", "front left", "rear right", "rear left"]
PARAMETERS = {
    "slider": [
        ("mass", "kg", 1.0, "scales the force alone"),
        ("mu", "", 0.3, "coefficient of friction during sliding"),
        ("mu_static", "", 0.0, "coefficient of friction at rest; 0: equal to mu"),
        ("natural_frequency", "rad/s", 0.0, "of the spring and the mass; 0: no spring"),
        ("damping_ratio", "", 0.0, "of the damper"),
        ("gap", "m", 0.0, "to stops on both sides; 0: none"),
        ("restitution", "", 0.0, "of the stops, from 0 to 1"),
    ],
    "bearing": [
        ("mass", "kg", 1.0, "scales the force alone"),
        ("mu", "", 0.06, "coefficient of friction"),
        ("radius", "m", 2.0, "effective radius of curvature of the dish"),
        ("damping_ratio", "", 0.0, "of a damper in parallel, at the frequency of the pendulum"),
        ("capacity", "m", 0.0, "displacement at the rim; 0: no rim"),
        ("restitution", "", 0.0, "of the rim, from 0 to 1"),
    ],
    "cart": [
        ("length", "m", 0.6, "between the casters, along the axis"),
        ("width", "m", 0.4, "between the casters, across it"),
        ("radius_of_gyration", "m", 0.25, "about the center of mass, in the middle"),
        ("side_mu", "", 0.1, "friction across a wheel over its load"),
        ("reach", "m", 0.04, "over which a wheel aligns with its path"),
        ("rolling_mu", "", 0.01, "rolling resistance over the load"),
        ("locked_mu", "", 0.3, "friction of a locked caster, in any direction"),
        *((f"heading_{i + 1}", "rad", 0.0, f"{at}, at the start") for i, at in enumerate(CORNERS)),
        *((f"locked_{i + 1}", "", 0.0, f"{at}: 1 locked, 0 free") for i, at in enumerate(CORNERS)),
    ],
}


def ports(model):
    """Inputs and outputs of a model."""
    return ([*INPUTS, TRANSVERSE], OF_A_CART) if model == "cart" else (INPUTS, OF_ONE_AXIS)


def describe(model):
    """Returns modelDescription.xml and the header variables.h, of the same lists."""
    inputs, outputs = ports(model)
    variables = [*inputs, *outputs, *PARAMETERS[model]]
    guid = hashlib.sha256(repr((model, variables)).encode()).hexdigest()
    root = ET.Element("fmiModelDescription", fmiVersion="2.0", modelName=model, guid=guid)
    root.set("generationTool", "stickslip")
    can = "canHandleVariableCommunicationStepSize", "canInterpolateInputs", "canGetAndSetFMUstate"
    ET.SubElement(root, "CoSimulation", modelIdentifier=model, **dict.fromkeys(can, "true"))
    units = ET.SubElement(root, "UnitDefinitions")
    for unit in sorted({unit for _, unit, _, _ in variables} - {""}):
        exponents = {base: str(power) for base, power in UNITS[unit].items()}
        ET.SubElement(ET.SubElement(units, "Unit", name=unit), "BaseUnit", exponents)
    listed = ET.SubElement(root, "ModelVariables")
    causalities = ["input"] * len(inputs) + ["output"] * len(outputs)
    for i, (name, unit, start, description) in enumerate(variables):
        causality = causalities[i] if i < len(causalities) else "parameter"
        variability = "fixed" if causality == "parameter" else "continuous"
        variable = ET.SubElement(
            listed,
            "ScalarVariable",
            name=name,
            valueReference=str(i),
            causality=causality,
            variability=variability,
            description=description,
        )
        real = ET.SubElement(variable, "Real", {"unit": unit} if unit else {})
        if start is not None:
            real.set("start", repr(start))
    structure = ET.SubElement(root, "ModelStructure")
    for kind in "Outputs", "InitialUnknowns":
        of_kind = ET.SubElement(structure, kind)
        for i in range(len(inputs), len(inputs) + len(outputs)):
            ET.SubElement(of_kind, "Unknown", index=str(i + 1))

    names = ", ".join(name.upper() for name, _, _, _ in variables)
    starts = ", ".join(repr(start or 0.0) for _, _, start, _ in variables)
    header = (
        f'#define GUID "{guid}"\n'
        f"enum {{ {names}, VARIABLES, INPUTS = {len(inputs)}, OUTPUTS = {len(outputs)} }};\n"
        f"static const double starts[VARIABLES] = {{{starts}}};\n"
    )
    return ET.tostring(root, encoding="utf-8", xml_declaration=True), header


def fmpy_headers():
    """The folder of the package fmpy that has fmi2Functions.h."""
    spec = importlib.util.find_spec("fmpy")
    if spec is None or not spec.submodule_search_locations:
        raise SystemExit("build.py: needs the headers of FMI 2.0: pip install fmpy, or --headers")
    return Path(spec.submodule_search_locations[0], "c-code")


def build(model, interface, headers, out):
    """Compiles and packs a model; returns the file."""
    system, suffix = {"linux": ("linux64", ".so"), "darwin": ("darwin64", ".dylib")}[sys.platform]
    c, cpp = os.environ.get("CC", "cc"), os.environ.get("CXX", "c++")
    description, header = describe(model)
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "variables.h").write_text(header, encoding="utf-8")
        include = [f"-I{path}" for path in (folder, STICKSLIP / "include", headers)]
        flags = ["-std=c11", "-O2", "-fPIC", "-fvisibility=hidden", "-Wall", "-Wextra", "-Werror"]
        compiled = Path(folder, "model.o")
        subprocess.run([c, *flags, *include, "-c", HERE / f"{model}.c", "-o", compiled], check=True)
        # With the C++ runtime inside, so that the simulator's own does not matter.
        inside = ["-static-libstdc++", "-static-libgcc"] if sys.platform == "linux" else []
        binary = Path(folder, model + suffix)
        subprocess.run([cpp, "-shared", compiled, *interface, *inside, "-o", binary], check=True)
        Path(out).mkdir(parents=True, exist_ok=True)
        file = Path(out, f"{model}.fmu")
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as fmu:
            fmu.writestr("modelDescription.xml", description)
            fmu.write(binary, f"binaries/{system}/{model}{suffix}")
    return file


if __name__ == "__main__":
    ask = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    ask.add_argument("model", choices=sorted(PARAMETERS))
    ask.add_argument(
        "interface", metavar="OBJECT", nargs="+", type=Path, help="the interface in C, compiled"
    )
    ask.add_argument("--headers", type=Path, help="folder with fmi2Functions.h")
    ask.add_argument("--out", type=Path, default=Path(), help="folder for the FMU")
    args = ask.parse_args()
    print("wrote", build(args.model, args.interface, args.headers or fmpy_headers(), args.out))
