"""std_msgs, as its .msg files say."""

from genpy import define

define("std_msgs", globals(), """
Header uint32 seq, time stamp, string frame_id
Empty
String string data
Bool bool data
Time time data
Duration duration data
ColorRGBA float32 r, float32 g, float32 b, float32 a
MultiArrayDimension string label, uint32 size, uint32 stride
MultiArrayLayout MultiArrayDimension[] dim, uint32 data_offset
""")
for _kind in ("float32", "float64", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64"):
    _name = ("UI" + _kind[2:] if _kind[0] == "u" else _kind[0].upper() + _kind[1:])
    define("std_msgs", globals(), f"""
{_name} {_kind} data
{_name}MultiArray MultiArrayLayout layout, {_kind}[] data
""")
