"""What a class keeps on this computer from lesson to lesson: codes, programs, tasks and best scores."""
