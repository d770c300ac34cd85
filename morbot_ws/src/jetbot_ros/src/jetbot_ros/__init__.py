"""What every node of this workspace shares: its start and end, its parameters, and all questions to the master."""
