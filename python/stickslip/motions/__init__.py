"""Ground motions from files: records, stations, suites, and what is computed of them.

Nothing is imported here: one record is read without NumPy, which suites need.
"""
