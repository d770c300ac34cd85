"""What stands in for a package whose package.xml breaks: that of its last build, with links to all its other files."""

import os
import shutil
from pathlib import Path
from typing import Collection, Iterable, List

from jetbot_tools.manifest import MANIFEST, Package, read_package

FOLDER = "stand_ins"  # in the devel folder


def keep(devel: Path, source: Path, folders: Iterable[Path]) -> None:
    """Keep the package.xml of each of these folders, whose packages are built."""
    for folder in folders:
        place = devel / FOLDER / folder.relative_to(source)
        place.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(folder / MANIFEST, place / MANIFEST)


def stand_ins(devel: Path, source: Path, packages: Collection[Package]) -> List[Path]:
    """Return a folder for each package that was built, but is not among ``packages``, those that can be read now."""
    readable, names = {package.folder for package in packages}, {package.name for package in packages}
    found = []
    for file in sorted((devel / FOLDER).rglob(MANIFEST)):
        folder = source / file.parent.relative_to(devel / FOLDER)
        if folder in readable or not os.path.lexists(folder / MANIFEST) or read_package(file.parent).name in names:
            continue
        for name in os.listdir(folder):
            if not os.path.lexists(file.parent / name):
                (file.parent / name).symlink_to(folder / name)
        found.append(file.parent)
    return found
