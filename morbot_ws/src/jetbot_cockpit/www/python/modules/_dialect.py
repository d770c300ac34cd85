"""What Python has and MicroPython lacks: dialect.js lets a program call these functions."""

from math import copysign, frexp

from _page import lower, upper
from _text import represented, text


def _upper(text):
    return "".join([each.upper() if each < "\x80" else upper(each) for each in text])


def _lower(text):
    return "".join([each.lower() if each < "\x80" else lower(each) for each in text])


def _capitalize(text):
    return _upper(text[:1]) + _lower(text[1:])


def _center(text, width, fill=" "):
    room = max(0, width - len(text))
    left = room // 2 + (room & width & 1)
    return fill * left + text + fill * (room - left)


def _ljust(text, width, fill=" "):
    return text + fill * (width - len(text))


def _rjust(text, width, fill=" "):
    return fill * (width - len(text)) + text


def _removeprefix(text, prefix):
    return text[len(prefix):] if text.startswith(prefix) else text


def _removesuffix(text, suffix):
    return text[:len(text) - len(suffix)] if text.endswith(suffix) else text


def _swapcase(text):
    return "".join([_lower(each) if _upper(each) == each else _upper(each) for each in text])


def _title(text):
    before, done = False, ""
    for each in text:
        done += _lower(each) if before else _upper(each)
        before = _upper(each) != _lower(each)  # a letter
    return done


def _zfill(text, width):
    sign = text[:1] if text[:1] in ("+", "-") else ""
    return sign + "0" * (width - len(text)) + text[len(sign):]


def _isinstance(value, kinds):
    return isinstance(value, kinds) or isinstance(value, bool) and isinstance(0, kinds)


def _is_integer(number):
    return number == number // 1


def _step(values, start, end, step):
    if not isinstance(values, (str, tuple)):
        return values[start:end:step]
    chosen = list(values)[start:end:step]
    return "".join(chosen) if isinstance(values, str) else tuple(chosen)


def _dict(*parts):
    done = {}
    for each in parts:
        done.update(each)
    return done


def _method(name, function, kind):
    """Return what calls this function for a value of this type, and the method of this name for any other."""
    def call(value, *given, **named):
        if type(value) is kind:
            return function(value, *given, **named)
        return getattr(value, name)(*given, **named)
    return call


def _round(number, digits=None):
    """Round as Python does: what lies in the middle between two decimals becomes the even one."""
    if digits is None or type(number) is not float or number - number != 0 or abs(digits) > 22:
        return round(number) if digits is None else round(number, digits)
    fraction, exponent = frexp(abs(number))
    scaled = int(fraction * 2 ** 53) * 10 ** max(0, digits) << max(0, exponent - 53)
    divisor = 10 ** max(0, -digits) << max(0, 53 - exponent)
    whole, rest = divmod(scaled, divisor)
    whole += 2 * rest > divisor or 2 * rest == divisor and whole & 1
    if whole >= 2 ** 53:  # it has no decimals
        return number
    return copysign(whole / 10 ** digits if digits > 0 else float(whole * 10 ** -digits), number)


def _format(value, spec=""):
    return ("{:" + spec + "}").format(value)


METHODS = {str: [_capitalize, _center, _ljust, _lower, _removeprefix, _removesuffix, _rjust, _swapcase, _title, _upper,
                 _zfill],
           float: [_is_integer]}
names = {"_py_str": lambda *given: text(given[0]) if len(given) == 1 else str(*given), "_py_repr": represented,
         "_py_step": _step, "_py_dict": _dict, "_py_list": lambda *items: list(items),
         "_py_set": lambda *items: set(items), "_py_tuple": lambda *items: items, "format": _format,
         "isinstance": _isinstance, "round": _round}
names.update({"_py" + each.__name__: _method(each.__name__[1:], each, kind)
              for kind, functions in METHODS.items() for each in functions})
