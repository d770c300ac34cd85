"""The node: its names, its parameters and its end."""

import _clock
from _start import NAMESPACE

from .exceptions import ROSException, ROSInitException

_node = {"name": NAMESPACE + "unnamed", "arguments": None, "shutdown": False}
_at_shutdown = []  # functions
_parameters = {}  # by their resolved names
_REQUIRED = object()


def init_node(name, argv=None, anonymous=False, log_level=None, disable_rostime=False, disable_rosout=False,
              disable_signals=False, xmlrpc_port=0, tcpros_port=0):
    if not name:
        raise ValueError("name must not be empty")
    if "/" in name:
        raise ValueError("namespaces are not allowed in node names")
    arguments = name, argv, anonymous, log_level, disable_rostime, disable_signals
    if _node["arguments"] not in (None, arguments):
        raise ROSException("rospy.init_node() has already been called with different arguments: "
                           + str(_node["arguments"]))
    if _node["arguments"] is None:
        suffix = f"_1_{int(_clock.now() * 1000)}" if anonymous else ""
        _node.update(arguments=arguments, name=NAMESPACE + name + suffix)


def is_initialized():
    return _node["arguments"] is not None


def check_time():
    """Raise ROSInitException as long as the node is not initialized."""
    if not is_initialized():
        raise ROSInitException("time is not initialized. Have you called init_node()?")


def log_level():
    return _node["arguments"][3] if is_initialized() else None


def get_name():
    return _node["name"]


get_caller_id = get_name


def get_namespace():
    return NAMESPACE


def resolve_name(name, caller_id=None):
    name = ("/" if name.startswith("/") else "") + "/".join([part for part in name.split("/") if part])
    if name.startswith("~"):
        return (caller_id or get_name()) + "/" + name[1:].lstrip("/")
    return name if name.startswith("/") else NAMESPACE + name


def myargv(argv=None):
    return ["program.py"] if argv is None else [each for each in argv if ":=" not in each]


def get_param(param_name, default=_REQUIRED):
    value = _parameters.get(resolve_name(param_name), default)
    if value is _REQUIRED:
        raise KeyError(param_name)
    return value


get_param_cached = get_param


def set_param(param_name, param_value):
    _parameters[resolve_name(param_name)] = param_value


def has_param(param_name):
    return resolve_name(param_name) in _parameters


def delete_param(param_name):
    if not has_param(param_name):
        raise KeyError(param_name)
    del _parameters[resolve_name(param_name)]


def get_param_names():
    return list(_parameters)


def is_shutdown():
    return _node["shutdown"]


def on_shutdown(h):
    if not callable(h):
        raise TypeError(f"shutdown hook [{h}] must be a function or callable object: {type(h)}")
    _at_shutdown.append(h)


def signal_shutdown(reason):
    """End the node: first its functions run, also after one that fails, and may still publish."""
    try:
        while _at_shutdown:
            _at_shutdown.pop(0)()
    finally:
        if _at_shutdown:
            signal_shutdown(reason)
        _node["shutdown"] = True
        _clock.tasks.clear()
