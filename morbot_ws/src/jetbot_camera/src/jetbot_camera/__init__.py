"""What the camera's node publishes, and its parameters."""
