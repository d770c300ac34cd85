"""A simulated JetBot: the model of its body, the node that drives it, and drawings of its track."""
