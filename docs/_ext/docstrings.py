"""Makes reStructuredText of docstrings that were written to be read in a terminal.

Formulas there are indented plain text, and bars are absolute values.
"""

import re

SECTION = re.compile(r"-{3,}$")
FULL_NAMES = (
    (re.compile(r"numpy\.typing\.(NDArray|ArrayLike)"), r"\1"),
    (re.compile(r"(stickslip\._core|collections\.abc|typing|numpy|os|datetime)\."), ""),
    (re.compile(r"\b(NDArray)\[\w+\]"), "ndarray"),
)
OVERLOAD = re.compile(r"\w+\((?!\s).*\)$")  # a form of a call, on a line of its own


def shorten(signature):
    for pattern, short in FULL_NAMES:
        signature = pattern.sub(short, signature)
    return signature.replace("=Ellipsis", "=...")


def process_signature(app, what, name, obj, options, signature, return_annotation):
    if signature is None:
        return None
    if return_annotation is not None:
        return_annotation = shorten(return_annotation)
    return shorten(signature), return_annotation


def escape(line):
    """Bars and stars mean themselves, but within code spans."""
    line = re.sub(r"^(\s*)([A-Z])\. ", r"\1\\\2. ", line)  # an initial is no item of a list
    parts = re.split(r"(``[^`]*``|`[^`]*`)", line)
    parts[::2] = [re.sub(r"(?<!\\)([|*]|(?<=\w)_(?=\W|$))", r"\\\1", part) for part in parts[::2]]
    return "".join(parts)


def process_docstring(app, what, name, obj, options, lines):
    result, literal, after_blank, in_sections, previous = [], False, True, False, ""
    for line in lines:
        indented = line.startswith("    ") and not in_sections
        if OVERLOAD.match(line) and not previous.strip():
            in_sections = False
            result += ["", f"``{line}``", ""]
            continue
        if SECTION.match(line.strip()) and previous.strip():
            in_sections = True
        if literal and line.strip() and not indented:
            literal = False
        if indented and after_blank and not literal and line.strip():
            literal = True
            if not previous_text(result).endswith("::"):
                result += ["::", ""]
        result.append(line if literal or ">>>" in line else escape(line))
        after_blank = not line.strip()
        previous = line
    if what in ("attribute", "property"):
        result.insert(
            0, ""
        )  # what stands before a colon on the first line would be taken for a type
    lines[:] = result


def previous_text(lines):
    return next((line.rstrip() for line in reversed(lines) if line.strip()), "")


def setup(app):
    app.connect("autodoc-process-docstring", process_docstring, priority=100)
    app.connect("autodoc-process-signature", process_signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True, "version": "1"}
