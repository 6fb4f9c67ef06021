"""Numbers computed apart from this library: the tables of tests/data, where each says how."""

import json

from pages import ROOT


def rows(file, table):
    """The rows of a table in tests/data/<file>.json, each a dict."""
    path = ROOT / "tests" / "data" / f"{file}.json"
    return json.loads(path.read_text(encoding="utf-8"))[table]["rows"]


def tuples(file, table):
    """The rows without the names of their columns."""
    return [tuple(row.values()) for row in rows(file, table)]
