"""Finds what keeps a JetBot from driving. It only reads, and never moves a wheel."""
