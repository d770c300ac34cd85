"""The parts of the controller's node: parameters, safety rules, supervisor, report and odometry."""
