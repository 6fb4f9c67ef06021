"""The sample records, which come with the package pyslammer."""

from .motions.samples import sample_files, sample_record, sample_records

__all__ = ["sample_files", "sample_record", "sample_records"]
