r"""Numbered equations: \tag{5.34} in a formula is its number and its target; (5.34) links to it.

A page carries an equation as

    ```math
    E[x'^2] = ... \tag{5.34, corrected}
    ```

which a forge shows too; a tag may hold two numbers. Each number stands once on the whole site.
Wherever a page, or a docstring, says (5.34) in its text, that becomes a link.
"""

import re

from docutils import nodes
from sphinx.transforms import SphinxTransform
from sphinx.transforms.post_transforms import SphinxPostTransform
from sphinx.util import logging
from sphinx.util.nodes import make_refnode

logger = logging.getLogger(__name__)
TAG = re.compile(r"\\tag\{([^}]*)\}")
NUMBER = r"(?:[2-5]|A|W)\.[1-9][0-9]?"


def label(number):
    return "eq-" + number.replace(".", "-")


class NumberEquations(SphinxTransform):
    """Takes the tag out of each formula and makes it the formula's number."""

    default_priority = 400

    def apply(self, **kwargs):
        domain = self.env.domains["math"]
        for node in self.document.findall(nodes.math_block):
            tags = TAG.findall(node.astext())
            if not tags:
                continue
            numbers = re.findall(NUMBER, tags[0])
            if len(tags) > 1 or not numbers:
                logger.warning("a formula has one tag with a number, got %s", tags, location=node)
                continue
            text = TAG.sub("", node.astext()).strip()
            node.children = [nodes.Text(text)]
            node["label"] = label(numbers[0])
            node["number"] = tags[0]
            node["docname"] = self.env.docname
            for number in numbers:
                target = label(number)
                page = domain.equations.get(target, (self.env.docname,))[0]
                if page != self.env.docname or target in self.document.ids:
                    logger.warning("equation %s stands in %s too", number, page, location=node)
                node["ids"].append(target)
                domain.equations[target] = (self.env.docname, tags[0])
            self.document.note_explicit_target(node)


class LinkEquations(SphinxPostTransform):
    """Makes every (5.34) in running text a link to that equation."""

    default_priority = 20
    reference = re.compile(rf"\(({NUMBER})\)")
    apart = (
        nodes.reference, nodes.literal, nodes.literal_block, nodes.math, nodes.math_block,
        nodes.title, nodes.raw, nodes.image,
    )  # fmt: skip

    def run(self, **kwargs):
        equations = self.env.domains["math"].equations
        for text in list(self.document.findall(nodes.Text)):
            if not self.reference.search(text):
                continue
            parent = text.parent
            while parent is not None and not isinstance(parent, self.apart):
                parent = parent.parent
            if parent is not None:
                continue
            parts = []
            end = 0
            for match in self.reference.finditer(text):
                known = equations.get(label(match[1]))
                if known is None:
                    continue
                parts.append(nodes.Text(text[end : match.start()]))
                parts.append(
                    make_refnode(
                        self.app.builder, self.env.docname, known[0], label(match[1]),
                        nodes.Text(match[0]),
                    )
                )  # fmt: skip
                end = match.end()
            if parts:
                parts.append(nodes.Text(text[end:]))
                text.parent.replace(text, parts)


def setup(app):
    app.add_transform(NumberEquations)
    app.add_post_transform(LinkEquations)
    return {"parallel_read_safe": True, "parallel_write_safe": True, "version": "1"}
