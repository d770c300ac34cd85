"""What the node reports: its status and diagnostics, and what it warns of. Drives nothing."""
