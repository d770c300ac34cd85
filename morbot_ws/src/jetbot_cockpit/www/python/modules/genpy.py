"""ROS's messages and times, with the meaning of ROS's own genpy."""

import struct

import _clock

FLOATS = {"float32": "f", "float64": "d"}
INTEGERS = {f"{sign}int{bits}": (low, low + 2 ** bits) for bits in (8, 16, 32, 64)
            for sign, low in (("", -2 ** (bits - 1)), ("u", 0))}
INTEGERS.update(byte=INTEGERS["int8"], char=INTEGERS["uint8"])
TYPES = {}  # the classes of messages by their names: "std_msgs/Header"


class MessageException(Exception):
    pass


class SerializationError(MessageException):
    pass


class TVal:
    """Whole seconds and nanoseconds."""

    def __init__(self, secs=0, nsecs=0):
        if not isinstance(secs, (int, bool)):
            if nsecs != 0:
                raise ValueError("if secs is a float, nsecs cannot be set")
            nsecs = (secs - int(secs)) * 1000000000
        self.secs, self.nsecs = int(secs), int(nsecs)
        self.canon()

    @classmethod
    def from_sec(cls, seconds):
        return cls(float(seconds))

    def canon(self):
        self.secs, self.nsecs = self.secs + self.nsecs // 1000000000, self.nsecs % 1000000000

    def set(self, secs, nsecs):
        self.secs, self.nsecs = secs, nsecs

    def to_sec(self):
        return float(self.secs) + float(self.nsecs) / 1e9

    def to_nsec(self):
        return self.secs * 1000000000 + self.nsecs

    def is_zero(self):
        return not self

    def __bool__(self):
        return self.to_nsec() != 0

    def __str__(self):
        return str(self.to_nsec())

    def __repr__(self):
        return f"rospy.{type(self).__name__}[{self.to_nsec()}]"

    def __hash__(self):
        return hash((self.secs, self.nsecs))

    def __eq__(self, other):
        return type(self) is type(other) and self.to_nsec() == other.to_nsec()

    def __ne__(self, other):
        return not self == other

    def __lt__(self, other):
        return self.to_nsec() < other.to_nsec() if type(self) is type(other) else NotImplemented

    def __le__(self, other):
        return self.to_nsec() <= other.to_nsec() if type(self) is type(other) else NotImplemented

    def __gt__(self, other):
        return self.to_nsec() > other.to_nsec() if type(self) is type(other) else NotImplemented

    def __ge__(self, other):
        return self.to_nsec() >= other.to_nsec() if type(self) is type(other) else NotImplemented

    def __add__(self, other):
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    def __sub__(self, other):
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)


class Duration(TVal):
    def __neg__(self):
        return Duration(-self.secs, -self.nsecs)

    def __abs__(self):
        return self if self.secs >= 0 else -self

    def __mul__(self, factor):
        if isinstance(factor, int):
            return Duration(self.secs * factor, self.nsecs * factor)
        return Duration(self.to_sec() * factor) if isinstance(factor, float) else NotImplemented

    __rmul__ = __mul__

    def __truediv__(self, other):
        if isinstance(other, Duration):
            return self.to_sec() / other.to_sec()
        return Duration(self.to_sec() / other)

    def __floordiv__(self, other):
        if isinstance(other, Duration):
            return int(self.to_sec() // other.to_sec())
        return Duration(self.to_sec() // other)

    def __mod__(self, other):
        return Duration(self.to_sec() % other.to_sec()) if isinstance(other, Duration) else NotImplemented


class Time(TVal):
    """A time in s since 1970."""

    def __init__(self, secs=0, nsecs=0):
        super().__init__(secs, nsecs)
        if self.secs < 0:
            raise TypeError("time values must be positive")

    @staticmethod
    def now():
        return Time(_clock.now())

    from_seconds = TVal.from_sec
    to_time = TVal.to_sec
    __radd__ = TVal.__add__

    def __sub__(self, other):
        if isinstance(other, Time):
            return Duration(self.secs - other.secs, self.nsecs - other.nsecs)
        return super().__sub__(other)


class Message:
    """Fields by their positions or names; no field that the type does not have; YAML as text."""

    __slots__ = _slot_types = ()

    def __init__(self, *args, **kwds):
        cls = type(self)
        if args and kwds:
            raise TypeError("Message constructor may only use args OR keywords, not both")
        if args and len(args) != len(self.__slots__):
            raise TypeError(f"Invalid number of arguments, args should be {self.__slots__} args are{args}")
        for name in kwds:
            if name not in self.__slots__:
                raise AttributeError(f"{name} is not an attribute of {cls.__name__}")
        given = dict(zip(self.__slots__, args)) if args else kwds
        for name, kind in zip(self.__slots__, self._slot_types):
            value = given.get(name)
            object.__setattr__(self, name, _default(kind) if value is None else value)

    def __setattr__(self, name, value):
        if name not in self.__slots__:
            raise AttributeError(f"'{type(self).__name__}' object has no attribute '{name}'")
        object.__setattr__(self, name, value)

    def __repr__(self):
        return _text(self)

    __str__ = __repr__

    def __eq__(self, other):
        return type(self) is type(other) and all(
            _comparable(getattr(self, name)) == _comparable(getattr(other, name)) for name in self.__slots__)

    def __ne__(self, other):
        return not self == other


def define(package, names, rows):
    """Define the messages of a package among these names. rows: a message and its fields a line, as in its .msg file"""
    for row in rows.strip().split("\n"):
        name, *fields = row.replace(",", " ").split()
        kinds = [_full(package, kind) for kind in fields[::2]]
        names[name] = TYPES[f"{package}/{name}"] = type(name, (Message,), {
            "__slots__": fields[1::2], "_slot_types": kinds, "_type": f"{package}/{name}"})


def received(message, prefix=""):
    """Return what a subscriber receives of this message. Raise SerializationError if a field has a value of no use."""
    return type(message)(*[_received(kind, getattr(message, name), prefix + name)
                           for name, kind in zip(message.__slots__, message._slot_types)])


def _full(package, kind):
    if kind == "Header":
        return "std_msgs/Header"
    return kind if kind[0].islower() else f"{package}/{kind}"


def _default(kind):
    if kind.endswith("]"):
        base, length = kind[:-1].split("[")
        return [_default(base) for _ in range(int(length or 0))]
    if kind in TYPES:
        return TYPES[kind]()
    return {"string": "", "bool": False, "time": Time(), "duration": Duration()}.get(kind, 0.0 if kind in FLOATS else 0)


def _received(kind, value, field):
    if kind.endswith("]"):
        base, length = kind[:-1].split("[")
        _check(isinstance(value, (list, tuple)), field, "must be a list or tuple type")
        _check(not length or len(value) == int(length), field, f"must have {length} values")
        values = [_received(base, each, field + "[]") for each in value]
        return values if base in TYPES else tuple(values)
    if kind in TYPES:
        return TYPES[kind](*[_received(inner, getattr(value, name), f"{field}.{name}")
                             for name, inner in zip(TYPES[kind].__slots__, TYPES[kind]._slot_types)])
    if kind in FLOATS:
        _check(isinstance(value, (int, float, bool)), field, "must be float type")
        return struct.unpack(FLOATS[kind], struct.pack(FLOATS[kind], value))[0]
    if kind in INTEGERS:
        low, high = INTEGERS[kind]
        _check(isinstance(value, (int, bool)) and (low < 0 or value >= 0), field,
               f"must be {'an integer' if low else 'unsigned integer'} type")
        _check(low <= value < high, field, f"exceeds specified width [{kind}]")
        return int(value)
    if kind == "bool":
        _check(value in (True, False, 0, 1), field, "is not a bool")
        return bool(value)
    needed, said = {"time": (Time, "Time"), "duration": (Duration, "Duration"),
                    "string": (str, "bytes or an ascii string")}[kind]
    _check(isinstance(value, needed), field, f"must be of type {said}")
    return value if kind == "string" else needed(value.secs, value.nsecs)


def _check(right, field, problem):
    if not right:
        raise SerializationError(f"field {field} {problem}")


def _comparable(value):
    return tuple(value) if isinstance(value, list) else value


def _text(value, indent=""):
    """Return a value as YAML."""
    if isinstance(value, Message):
        lines = [f"{indent}{name}: {_text(getattr(value, name), indent + '  ')}" for name in value.__slots__]
        return ("\n" if indent else "") + "\n".join(lines)
    if isinstance(value, TVal):
        return f"\n{indent}secs: {value.secs}\n{indent}nsecs: {value.nsecs:9d}"
    if isinstance(value, str):
        return _quoted(value) if value else "''"
    if isinstance(value, (list, tuple)):
        if value and isinstance(value[0], (Message, TVal)):
            return "\n" + "\n".join([f"{indent}- {_text(each, indent + '  ')}" for each in value])
        return str(list(value))
    return str(value)


def _quoted(text):
    escaped = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\t": "\\t", "\r": "\\r"}
    return '"' + "".join([escaped.get(each) or _ascii(each) for each in text]) + '"'


def _ascii(character):
    code = ord(character)
    if 0x20 <= code < 0x7F:
        return character
    return f"\\x{code:02X}" if code < 0x100 else f"\\u{code:04X}" if code < 0x10000 else f"\\U{code:08X}"
