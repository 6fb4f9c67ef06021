"""Records of earthquakes in files."""

from .motions.records import read_record, read_station, record_formats

__all__ = ["read_record", "read_station", "record_formats"]
