"""What a recipe of CONTRIBUTING.md still needs: a failure names the file, and the lines to write into it."""

from conftest import ROOT


def require_lines(file, lines):
    """Fail with the lines that this file lacks."""
    written = {line.strip() for line in file.read_text().splitlines()}
    missing = [line for line in lines if line not in written]
    assert not missing, "\n".join([f"write into {file.relative_to(ROOT)}:", *missing])


def require_rows(file, found, wanted):
    """Fail if the rows that were found in a file are not those that are wanted, in this order."""
    missing = [each for each in wanted if each not in found]
    assert not missing, f"write a row into {file.relative_to(ROOT)} for each of {missing}"
    assert list(found) == list(wanted), f"the rows of {file.relative_to(ROOT)} must be in this order"
