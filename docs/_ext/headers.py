"""The directive `header`: all that a public header declares, in its order, by Breathe.

    .. header:: stickslip/friction/caster.hpp

Breathe's own directive for files shows neither concepts nor the members of classes.
"""

from functools import cache
from pathlib import Path
from xml.etree import ElementTree

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

CLASSES = {"class": "doxygenclass", "struct": "doxygenstruct", "concept": "doxygenconcept"}
MEMBERS = {"enum": "doxygenenum", "typedef": "doxygentypedef", "function": "doxygenfunction"}
MEMBERS["variable"] = "doxygenvariable"


def text(element):
    return "" if element is None else "".join(element.itertext())


@cache
def declarations(folder):
    """For each header what it declares in a namespace: (line, directive, name)."""
    found = {}

    def add(location, directive, name):
        if location is not None and "detail" not in name.split("::"):
            found.setdefault(location.get("file"), []).append(
                (int(location.get("line")), directive, name)
            )

    for entry in ElementTree.parse(folder / "index.xml").iter("compound"):
        kind = entry.get("kind")
        if kind not in (*CLASSES, "namespace"):
            continue
        compound = ElementTree.parse(folder / f"{entry.get('refid')}.xml").find("compounddef")
        name = text(compound.find("compoundname"))
        if kind in CLASSES:
            outer = name.rpartition("::")[0]
            if outer.split("::")[-1][:1].islower():  # not within a class, which shows it
                add(compound.find("location"), CLASSES[kind], name)
            continue
        if not name.startswith("stickslip"):
            continue
        for member in compound.iter("memberdef"):
            if "<" in text(member.find("name")):  # a specialization, which Breathe cannot name
                continue
            directive = MEMBERS.get(member.get("kind"))
            full = f"{name}::{text(member.find('name'))}"
            if directive == "doxygenfunction":
                full += text(member.find("argsstring"))
            if directive and not text(member.find("initializer")).startswith("= []"):
                add(member.find("location"), directive, full)
    return found


class Header(SphinxDirective):
    required_arguments = 1

    def run(self):
        folder = Path(self.config.breathe_projects[self.config.breathe_default_project])
        self.env.note_dependency(str(folder / "index.xml"))
        found = declarations(folder).get(self.arguments[0])
        if not found:
            raise self.error(f"{self.arguments[0]} declares nothing")
        lines = []
        for _, directive, name in sorted(found):
            lines += [f".. {directive}:: {name}"]
            if directive in ("doxygenclass", "doxygenstruct"):
                lines += ["   :members:", "   :undoc-members:"]
            lines += [""]
        return self.parse_text_to_nodes("\n".join(lines))


def join_paragraphs(app, doctree):
    """Breathe makes a paragraph within the paragraph of what follows a code span before a list."""
    for inner in list(doctree.findall(nodes.paragraph)):
        if isinstance(inner.parent, nodes.paragraph):
            space = "" if inner.astext()[:1] in ".,:;)" else " "
            inner.replace_self([nodes.Text(space), *inner.children])


def setup(app):
    app.add_directive("header", Header)
    app.connect("doctree-read", join_paragraphs)
    app.connect("env-before-read-docs", lambda *_: declarations.cache_clear())
    return {"parallel_read_safe": True, "parallel_write_safe": True, "version": "1"}
