"""JPEGs: cut out of a stream of bytes, decoded and encoded. numpy and PIL are imported when they are first used."""

import io
import re
from typing import Any, Optional

from ..errors import JetbotError

MAX_SIZE = 8 * 1024 * 1024  # bytes of a JPEG
SOI, EOI, SOS = b"\xff\xd8", b"\xff\xd9", 0xDA  # markers, ITU-T T.81: start and end of image, start of scan
END_OF_SCAN = re.compile(b"\xff[\xd8\xd9]")     # the data of a scan holds neither


def take(buffer: bytearray) -> Optional[bytes]:
    """Remove the first complete JPEG, and what precedes it, from a stream, and return it; None if there is none yet.

    Half a JPEG before the next one, and what is none, is dropped; so is one larger than MAX_SIZE.
    """
    while True:
        start = buffer.find(SOI)
        del buffer[:start if start >= 0 else max(0, len(buffer) - 1)]
        end = extent(buffer)
        if end > 0:
            picture = bytes(buffer[:end])
            del buffer[:end]
            return picture
        if end == 0:
            if len(buffer) > MAX_SIZE:
                del buffer[:]
            return None
        del buffer[:-end]


def extent(buffer: bytearray) -> int:
    """Return the length of the JPEG at the start; 0 if it is not complete yet; -N if the first N bytes are no JPEG.

    The segments before the scan are skipped by their length: one may hold a thumbnail, which is a JPEG too.
    """
    position = len(SOI)
    while position + 4 <= len(buffer):
        if buffer[position] != 0xFF or not is_segment(buffer[position + 1]):
            return -len(SOI)
        if buffer[position + 1] == SOS:
            found = END_OF_SCAN.search(buffer, position)
            if found is None:
                return 0
            return found.end() if found.group() == EOI else -found.start()
        position += 2 + int.from_bytes(buffer[position + 2:position + 4], "big")
    return 0


def is_segment(marker: int) -> bool:
    """Return whether a segment with a length may begin with this marker."""
    return 0xC0 <= marker <= 0xFE and not 0xD0 <= marker <= 0xD9


def decode(jpeg: bytes, width: int, height: int) -> Any:
    """Return a JPEG as an array: height x width x 3, BGR, uint8. Raise JetbotError for a damaged one."""
    import numpy
    from PIL import Image
    try:
        with Image.open(io.BytesIO(jpeg)) as image:
            image.draft("RGB", (width, height))  # decodes no larger than needed
            picture = image.convert("RGB")
    except (OSError, SyntaxError, Image.DecompressionBombError) as error:  # what PIL raises
        reason = str(error).partition(" <")[0]  # without the address of an object, which is never the same
        raise JetbotError(f"the camera sends a damaged picture: {reason}") from None
    if picture.size != (width, height):
        picture = picture.resize((width, height), Image.BILINEAR)
    return numpy.ascontiguousarray(numpy.asarray(picture)[:, :, ::-1])


def bgr8_to_jpeg(value: Any, quality: int = 75) -> bytes:
    """Return an array, height x width x 3, BGR, uint8, as a JPEG of this quality, 1 to 95."""
    import numpy
    from PIL import Image
    file = io.BytesIO()
    Image.fromarray(numpy.ascontiguousarray(value[:, :, ::-1])).save(file, "JPEG", quality=quality)
    return file.getvalue()
