"""Whether a picture can be read, without keeping it."""

from __future__ import annotations

import struct
import warnings
import zlib
from pathlib import Path

from facemorph.core.picture import PICTURE_FORMATS
from facemorph.io.limits import TEXTURE_BYTES, plain_size, shortened

_DECODED_PIXELS = 8192 * 8192


def picture_problem(path: Path) -> str | None:
    """What is wrong with the picture at `path`, in words that follow its name; None where it is well.

    Pictures of more than 8192 x 8192 pixels are looked at without unpacking them.
    """
    from PIL import Image, UnidentifiedImageError

    # Without it Pillow loads its readers of all formats, as soon as it has to try more than one.
    Image.preinit()
    try:
        size = path.stat().st_size
        if size == 0:
            return "is an empty file"
        if size > TEXTURE_BYTES:
            return f"is larger than {plain_size(TEXTURE_BYTES)}, the most that is read"
        with warnings.catch_warnings(), Image.open(path, formats=PICTURE_FORMATS) as opened:
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            if opened.width * opened.height > _DECODED_PIXELS:
                opened.verify()
            else:
                opened.load()
    except UnidentifiedImageError:
        return "cannot be read: it is no picture"
    except (
        OSError,
        ValueError,
        SyntaxError,
        TypeError,
        LookupError,
        ArithmeticError,
        EOFError,
        struct.error,
        zlib.error,
        RuntimeError,
        AttributeError,
        MemoryError,
        Image.DecompressionBombError,
    ) as error:
        # Decoders of damaged files end in errors of many kinds.
        return f"cannot be read: {shortened(' '.join(str(error).split()), 80) or type(error).__name__}"
    return None
