"""The programs of the robots: each one a file of the class."""

import random
from typing import Dict, Iterator, List, Optional

from ..notices import Notice, say
from .program import Program, Version, is_program, problem_of

PREFIX = "program_"
MAX_PROGRAMS = 50          # of a robot, those that were deleted last included,
MAX_TOTAL = 1024 * 1024    # and bytes of all of them, with their earlier versions
MAX_EARLIER = 10           # versions of a program, beside the newest
RESTART_BITS = 20          # see Programs._version
MAX_CLAIMED = 2 ** 30      # the largest version of a page that is counted on


class Refused(Exception):
    """Why a program is not kept or shown: a Notice."""

    def __init__(self, notice: Notice):
        super().__init__(notice)
        self.notice = notice


class Programs:
    """All programs, which one thread may change, and others read. folder: a ClassFolder, or Nowhere."""

    def __init__(self, folder):
        self._folder = folder
        self._programs: Dict[str, Program] = {each.id: each for each in read_all(folder)}  # replaced, never changed
        self._latest: Dict[str, int] = {}
        for each in self._programs.values():
            self._latest[each.robot] = max(each.changed, self._latest.get(each.robot, 0))

    def changed(self, robot: str) -> int:
        """Return a number that grows with each change to the robot's programs; 0 without one."""
        return self._latest.get(robot, 0)

    def rows(self, robot: Optional[str]) -> List[dict]:
        """Return the programs of a robot, or of all (None), those first that were changed last."""
        return [each.row() for each in sorted(self._of(robot), key=lambda each: -each.changed)]

    def open(self, robot: str, id: str) -> Program:
        """Return a program of the robot. Raise Refused."""
        found = self._programs.get(id)
        if not found or found.robot != robot:
            raise Refused(say("gone"))
        return found

    def save(self, robot: str, id: str, version: int, name: str, program: str) -> Program:
        """Keep a program; return it with its new version. Raise Refused, OSError.

        version: the one that was changed, which this one replaces; 0 for a new program. If that is not the newest any
        more, the newest becomes an earlier one. The same again is answered again: the first answer was lost.
        """
        before = self._programs.get(id)
        if before and before.robot != robot:
            raise Refused(say("gone"))
        if before and (before.name, before.program, before.deleted) == (name, program, False):
            return before
        problem = problem_of(program)
        if problem:
            raise Refused(problem)
        others = [each for each in (before.versions() if before else ())
                  if each.version != version and each[1:] != (name, program)]
        new = Program(id, robot, name, self._version(before, version), self._next(), False, program,
                      tuple(others[:MAX_EARLIER]))
        return self._keep(new, self._leaving(new))

    def delete(self, robot: str, id: str, deleted: bool) -> Program:
        """Delete a program, or undo that; return it. Raise Refused, OSError."""
        before = self.open(robot, id)
        if before.deleted == deleted:
            return before
        return self._keep(before._replace(changed=self._next(), deleted=deleted))

    def _version(self, before, changed):
        """Return the number of a new version.

        Pages that outlive a cockpit without a class save again what they have. A number by chance is not one that
        another of these pages has for something else.
        """
        if before or not changed:
            return (before.version if before else 0) + 1
        return min(changed, MAX_CLAIMED) + 1 + random.getrandbits(RESTART_BITS)

    def _keep(self, program, leaving=()):
        """Write before it counts; what makes room for it goes last, so that a kill at any moment loses nothing."""
        self._folder.write(PREFIX + program.id, program._asdict())
        self._programs = {**self._programs, program.id: program}
        self._latest = {**self._latest, program.robot: program.changed}
        for each in leaving:
            self._folder.remove(PREFIX + each.id)
            self._programs = {id: other for id, other in self._programs.items() if id != each.id}
        return program

    def _leaving(self, new):
        """Return the deleted programs that make room for a new one, the oldest first. Raise Refused."""
        others = [each for each in self._of(new.robot) if each.id != new.id]
        count, total = len(others) + 1, sum(each.size() for each in [*others, new])
        leaving = []
        for each in sorted(others, key=lambda each: (not each.deleted, each.changed)):
            if count <= MAX_PROGRAMS and total <= MAX_TOTAL:
                break
            if not each.deleted:
                raise Refused(say("full", count=MAX_PROGRAMS))
            leaving.append(each)
            count, total = count - 1, total - each.size()
        return leaving

    def _of(self, robot):
        return [each for each in self._programs.values() if robot in (None, each.robot)]

    def _next(self):
        return 1 + max(self._latest.values(), default=0)


def read_all(folder) -> Iterator[Program]:
    """Yield the programs of a class; a file that holds none is put aside."""
    for name in folder.names(PREFIX):
        content = folder.read(name)
        if is_program(content) and name == PREFIX + content["id"]:
            earlier = tuple(Version(*each) for each in content.get("earlier", ()))
            yield Program(**{**content, "earlier": earlier})
        elif content is not None:
            folder.set_aside(name)
