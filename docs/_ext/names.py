"""Names of the Python package in code spans become links: `PulseChain`, `ss.run_ensemble`."""

import re

from docutils import nodes
from sphinx import addnodes
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util.nodes import make_refnode

MODULES = ("stickslip", "stickslip.theory", "stickslip.harmonic", "stickslip.plotting")
NAME = re.compile(r"(?:ss\.|stickslip\.|~)?([A-Za-z_][\w.]*)(?:\(\))?$")


def find(env, name):
    """The documented object of that name, in whichever module: (full name, entry), or None."""
    match = NAME.match(name)
    if not match:
        return None
    objects = env.domains["py"].objects
    for module in MODULES:
        entry = objects.get(f"{module}.{match[1]}")
        if entry is not None and entry.objtype != "module":
            return f"{module}.{match[1]}", entry
    return None


def keep_words(app, doctree):
    """In the types of docstrings words are no classes: `array_like, shape (N,)`."""
    for node in list(doctree.findall(addnodes.pending_xref)):
        is_class = node.get("refdomain") == "py" and node.get("reftype") == "class"
        if is_class and node["reftarget"].rpartition(".")[2][:1].islower():
            node.replace_self(node.children)


class LinkNames(SphinxPostTransform):
    default_priority = 21
    apart = (nodes.reference, nodes.title)

    def run(self, **kwargs):
        here = self.env.docname
        if here.startswith("reference/cpp"):
            return
        for span in list(self.document.findall(nodes.literal)):
            parent = span.parent
            while parent is not None and not isinstance(parent, self.apart):
                parent = parent.parent
            found = find(self.env, span.astext())
            if parent is not None or found is None or found[1].docname == here:
                continue
            name, entry = found
            link = make_refnode(
                self.app.builder, here, entry.docname, entry.node_id, span.deepcopy(), name
            )
            span.parent.replace(span, link)


def resolve(app, env, node, contnode):
    """Types in docstrings: `Slider` in whichever module; words that are no names stay words."""
    if node.get("refdoc", "").startswith("reference/cpp") and "_1" in node["reftarget"]:
        return contnode  # by Doxygen, to what is private or in a namespace `detail`
    if node.get("refdomain") != "py" or not node.get("refdoc", "").startswith("reference/python"):
        return None
    found = find(env, node["reftarget"].removeprefix("stickslip._core."))
    if found is None:
        return contnode
    name, entry = found
    return make_refnode(app.builder, node["refdoc"], entry.docname, entry.node_id, contnode, name)


def setup(app):
    app.add_post_transform(LinkNames)
    app.connect("doctree-read", keep_words)
    app.connect("missing-reference", resolve)
    return {"parallel_read_safe": True, "parallel_write_safe": True, "version": "1"}
