"""What a class keeps on this computer from lesson to lesson: codes, names, programs, tasks and best scores."""
