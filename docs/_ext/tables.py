"""Tables of words get a class of their own: their cells may break lines, those of numbers not."""

from docutils import nodes
from sphinx.transforms.post_transforms import SphinxPostTransform

LONGEST = 32  # letters of what still counts as a number with its unit


class MarkTables(SphinxPostTransform):
    default_priority = 900

    def run(self, **kwargs):
        for table in self.document.findall(nodes.table):
            if any(len(cell.astext()) > LONGEST for cell in table.findall(nodes.entry)):
                table["classes"].append("words")


def setup(app):
    app.add_post_transform(MarkTables)
    return {"parallel_read_safe": True, "parallel_write_safe": True, "version": "1"}
