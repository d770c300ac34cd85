"""What the node reports: its status, warnings, diagnostics, what the wheels get, and the supply. Drives nothing."""
