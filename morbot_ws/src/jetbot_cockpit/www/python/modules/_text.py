"""How values look: as in Python, where MicroPython's last digit of a float differs, its letters or its commas."""

from _page import digits

BRACKETS = {list: "[]", tuple: "()", set: "{}", dict: "{}"}


def text(value):
    """Return what str() gives of a value."""
    if type(value) is KeyError and len(value.args) == 1:
        return represented(value.args[0])
    return represented(value) if type(value) in (float, list, tuple, dict, set) else str(value)


def represented(value):
    """Return what repr() gives of a value."""
    kind = type(value)
    if kind is float:
        return _decimal(value)
    if kind is str and "\\" in repr(value):
        return _quoted(value)
    if isinstance(value, Exception) and repr(value).endswith(",)"):
        return f"{kind.__name__}({represented(value.args[0])})"
    if kind not in BRACKETS or not value:
        return repr(value)
    parts = [f"{represented(key)}: {represented(each)}" for key, each in value.items()] if kind is dict else [
        represented(each) for each in value]
    end = "," if kind is tuple and len(value) == 1 else ""
    return BRACKETS[kind][0] + ", ".join(parts) + end + BRACKETS[kind][1]


def _quoted(value):
    """Return a text between quotation marks; all its letters are shown."""
    quote = '"' if "'" in value and '"' not in value else "'"
    parts = [each if each > "\xa0" else "\\" + quote if each == quote else repr(each)[1:-1] for each in value]
    return quote + "".join(parts) + quote


def _decimal(number):
    """Return the shortest decimal of a float."""
    if number - number != 0:
        return repr(number)
    sign, (mantissa, power) = "-" if repr(number)[0] == "-" else "", digits(abs(number)).split("e")
    power = int(power)
    if not -5 < power < 16:
        return f"{sign}{mantissa}e{'-' if power < 0 else '+'}{abs(power):02d}"
    figures = "0" * -power + mantissa.replace(".", "")
    point = max(0, power) + 1
    figures += "0" * (point + 1 - len(figures))
    return f"{sign}{figures[:point]}.{figures[point:]}"
