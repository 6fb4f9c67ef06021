"""Makes reStructuredText of docstrings that were written to be read in a terminal.

Formulas there are indented plain text, and bars are absolute values; signatures of the compiled
module name every type in full.
"""

import re

import stickslip
from sphinx.util.inspect import signature_from_str

SECTION = re.compile(r"-{3,}$")
FULL_NAMES = (
    (re.compile(r"typing\.SupportsFloat \| typing\.SupportsIndex"), "float"),
    (re.compile(r"typing\.SupportsIndex"), "int"),
    (re.compile(r"typing\.SupportsInt"), "int"),
    (re.compile(r"numpy\.typing\.(NDArray|ArrayLike)"), r"\1"),
    (re.compile(r"(stickslip\._core|collections\.abc|typing|numpy|os|datetime)\."), ""),
    (re.compile(r"Annotated\[(\w+), [^\]]*\]"), r"\1"),
    (re.compile(r"\b(NDArray)\[\w+\]"), "ndarray"),
    (re.compile(r"NoneType"), "None"),
    (re.compile(r"\bint \| int\b"), "int"),
)
OVERLOAD = re.compile(r"(\d+)\. (\w+\(.*)$")


def shorten(signature):
    for pattern, short in FULL_NAMES:
        signature = pattern.sub(short, signature)
    return re.sub(r"\(self: [^,)]*(, )?", "(", signature)


def split(arguments):
    """At the commas that are not within brackets."""
    depth, parts = 0, [""]
    for letter in arguments:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]


def merged(signatures):
    """One signature of several that differ in the types of their arguments alone, or the first."""
    first, *others = [split(signature[1:-1]) for signature in signatures]
    for other in others:
        if [part.partition(":")[0] for part in other] != [part.partition(":")[0] for part in first]:
            break
        for i, part in enumerate(other):
            kind = part.partition(":")[2].partition(" =")[0].strip()
            if kind and kind not in first[i]:
                head, equals, default = first[i].partition(" =")
                first[i] = f"{head} | {kind}{equals}{default}"
    return f"({', '.join(first)})"


def constructor(cls):
    found = re.findall(r"__init__(\(self.*\)) -> None", cls.__init__.__doc__ or "")
    return merged([shorten(signature) for signature in found]) if found else None


def overloaded(obj):
    """The first form of an overloaded function: arguments and what is returned."""
    name = re.escape(getattr(obj, "__name__", ""))
    found = re.search(rf"^1\. {name}(\(.*\)) -> (.*)$", obj.__doc__ or "", re.MULTILINE)
    return found and (shorten(found[1]), shorten(found[2]))


def note_constructors(app):
    """Gives each class of the compiled module the signature that its __init__'s docstring tells."""
    for module in (stickslip, stickslip.theory, stickslip.harmonic):
        for name in module.__all__:
            cls = getattr(module, name)
            text = constructor(cls) if isinstance(cls, type) else None
            if text:
                cls.__signature__ = signature_from_str(text)


def process_signature(app, what, name, obj, options, signature, return_annotation):
    if signature is None:
        return None
    if signature == "(*args, **kwargs)" and overloaded(obj):
        return overloaded(obj)
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
    if lines and lines[0].strip() == "Overloaded function.":
        del lines[0]
    result, literal, after_blank, in_sections, previous = [], False, True, False, ""
    for line in lines:
        indented = line.startswith("    ") and not in_sections
        overload = OVERLOAD.match(line)
        if overload and "(" in line:
            in_sections = False
            if overload[1] != "1":
                result += ["", f"``{shorten(overload[2])}``", ""]
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
    app.connect("builder-inited", note_constructors)
    app.connect("autodoc-process-docstring", process_docstring, priority=100)
    app.connect("autodoc-process-signature", process_signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True, "version": "1"}
