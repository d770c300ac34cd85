"""What ./morbot robot does on a robot: it makes it one of a class, which starts with the computer."""
