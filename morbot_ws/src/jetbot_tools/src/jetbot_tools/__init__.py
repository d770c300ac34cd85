"""Programs for the owner of a robot: the doctor, the calibration, and the emergency stop."""
