"""The page's files as they are sent: compressed, and by addresses that change with them, so that browsers keep them."""

import gzip
import hashlib
import posixpath
import re
from pathlib import Path
from typing import Dict, List, NamedTuple, Optional

from jetbot import files

WWW = files.shipped(Path(__file__).parent, "jetbot_cockpit", "www")
TYPES = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".svg": "image/svg+xml",
         ".cur": "image/x-icon", ".json": "application/json", ".mjs": "text/javascript", ".wasm": "application/wasm",
         ".py": "text/x-python"}
NEVER, CHECKED, FOREVER = "no-store", "no-cache", "max-age=31536000, immutable"  # how a browser keeps a file
# A whole line, or its end, which is in no text since it has no quotes; the lines keep their numbers
COMMENT = re.compile(rb"""^ *(?://.*|/\*\*.*\*/)$|(?<=[;,{}()\[\]]) +// [^"'`\n]*$""", re.MULTILINE)
STYLE_COMMENT = re.compile(rb" */\*[^*]*\*/")
REFERENCE = re.compile(r'(?<=src="|ref=")[^":]+(?=")')
IMPORT = re.compile(r'^(?:import|export|\}).* from "(\..+)";$|^import "(\..+)";$', re.MULTILINE)
MODULE = re.compile(r' *<script type="module" src="([^"]+)"></script>')


class File(NamedTuple):
    """A file, as it is and compressed. cache: one of NEVER, CHECKED, FOREVER."""

    plain: bytes
    gzip: bytes
    brotli: Optional[bytes]
    cache: str


def read_files(folder: Path = WWW) -> Dict[str, File]:
    """Return the pages' files by their names below the folder; nothing else is ever served.

    Each file but the pages is there again as VERSION/NAME, where pages find it. VERSION is of all files together.
    """
    names = {file.relative_to(folder).as_posix(): file for file in folder.rglob("*") if file.suffix in TYPES}
    contents = {name: read(file) for name, file in sorted(names.items())}
    version = hashlib.sha256(b"".join(name.encode() + content for name, content in contents.items())).hexdigest()[:16]
    served = {}
    for name, content in contents.items():
        if name.endswith(".html"):
            served[name] = compress(link(contents, content.decode(), version).encode(), NEVER)
        else:
            served[name] = compress(content, CHECKED, names[name])
            served[f"{version}/{name}"] = served[name]._replace(cache=FOREVER)
    return served


def read(file: Path) -> bytes:
    """Return what is served of a file: without its comments, a tenth of what a tablet waits for."""
    comment = {".js": COMMENT, ".css": STYLE_COMMENT}.get(file.suffix) if "vendor" not in file.parts else None
    return comment.sub(b"", file.read_bytes()) if comment else file.read_bytes()


def compress(content: bytes, cache: str, file: Optional[Path] = None) -> File:
    """Return a File. file: where it lies, perhaps with a compressed one."""
    brotli = file and file.with_name(f"{file.name}.br")
    return File(content, gzip.compress(content, mtime=0), brotli.read_bytes() if brotli and brotli.exists() else None,
                cache)


def link(contents: Dict[str, bytes], page: str, version: str) -> str:
    """Return a page that names the files of this version, all its modules at once."""
    def preload(module: "re.Match") -> str:
        lines = [f'  <link rel="modulepreload" href="{name}">' for name in modules(contents, module[1])]
        return "\n".join([*lines, module[0]])
    return REFERENCE.sub(lambda found: f"{version}/{found[0]}" if found[0] in contents else found[0],
                         MODULE.sub(preload, page))


def modules(contents: Dict[str, bytes], name: str) -> List[str]:
    """Return a module, and all that it imports, in the order in which they run."""
    found: List[str] = []

    def add(name):
        if name in found:
            return
        found.append(name)
        for path in IMPORT.findall(contents[name].decode()):
            add(posixpath.normpath(posixpath.join(posixpath.dirname(name), "".join(path))))
    add(name)
    return found
