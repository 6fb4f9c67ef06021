"""From displacements to decisions: yield accelerations and estimates of codes."""
