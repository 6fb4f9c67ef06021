"""What long runs have in common: parts on an executor, checkpoints, errors, progress."""
