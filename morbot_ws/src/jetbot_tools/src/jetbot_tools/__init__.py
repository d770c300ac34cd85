"""Programs for the owner of a robot: the doctor and the calibration; and what is wrong with packages."""
