"""Kinds of numbers, for isinstance()."""

Integral = (bool, int)
Number = Complex = Real = Rational = (bool, int, float)
