"""What the students of a class have handed in, as they and a learning platform name it: folders, and zips of them."""

from __future__ import annotations

import os
import re
import tempfile
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path, PurePath, PurePosixPath

from .course import Course
from .errors import CourseError
from .text import Text, say
from .workbook import MAX_FILE_BYTES, content

__all__ = ["Submission", "submissions"]

MAX_DEPTH = 5  # of folders in folders that are looked through
MAX_FOLDERS = 1000
MAX_MEMBERS = 100_000
MAX_ARCHIVE_BYTES = 200 * MAX_FILE_BYTES  # of a zip in a zip, and of all that is unpacked of one
OTHERS = ("__MACOSX", "__pycache__", "site-packages", "node_modules")

SEVERAL = Text("None of several for {name} was judged: {files}.", "{name} 有好几份，都没有评判：{files}。")


@dataclass(frozen=True)
class Submission:
    """What a student has handed in: the folder with most of the files, the file of each section, and remarks."""

    student: str
    folder: Path
    files: dict[str, Path]
    remarks: tuple[Text, ...]


def submissions(
    course: Course, given: Sequence[str | PathLike[str]], room: Path, sections: Sequence[str]
) -> list[Submission]:
    """Return what each student has handed in, in folders and zips; what is unpacked goes to an empty folder."""
    tree = _Tree(course, room)
    found: list[Submission] = []
    for path in map(Path, given):
        if not path.is_dir() and not (_is_zip(path) and path.is_file()):
            raise CourseError(f"{path}: expected the folder of a student, a folder of such folders, or a zip of either")
        place = path.resolve()
        inside = tree.places_of_students(place, several=len(given) > 1)
        of_all = tuple(tree.remarks.get(place, ())) if inside != [place] else ()
        each = (_submission(one, tree, sections) for one in inside)
        found += [replace(one, remarks=of_all + one.remarks) for one in each]
    return found


class _Tree:
    """Folders and zips in each other: a zip is unpacked when it is first looked into."""

    def __init__(self, course: Course, room: Path) -> None:
        self.course, self._room = course, room
        self._patterns = {section: _pattern(file) for file, section in course.files.items()}
        self._unpacked: dict[Path, Path] = {}
        self.remarks: dict[Path, list[Text]] = {}

    def folder(self, place: Path) -> Path:
        """Return a folder itself, and for a zip the folder with its content, empty where it cannot be read."""
        if place.is_dir():
            return place
        if place not in self._unpacked:
            self._unpacked[place] = Path(tempfile.mkdtemp(dir=self._room))
            self.remarks[place] = []
            try:
                self._unpack(place, self._unpacked[place])
            except Exception as error:  # it is no zip, or its list of members is damaged
                text = "{file} cannot be unpacked: {error}", "无法解压 {file}：{error}"
                self.remarks[place].append(say(*text, file=place.name, error=error))
        return self._unpacked[place]

    def _unpack(self, archive: Path, target: Path) -> None:
        """Write the members that are small and stay in the folder."""
        skipped, left = list[str](), MAX_ARCHIVE_BYTES
        with zipfile.ZipFile(archive) as packed:
            for member in packed.infolist()[:MAX_MEMBERS]:
                name = PurePosixPath(member.filename.replace("\\", "/"))
                if member.is_dir() or _is_hidden(name.parts[:-1]):
                    continue
                largest = min(left, MAX_ARCHIVE_BYTES if _is_zip(name) else MAX_FILE_BYTES)
                try:
                    data = _member(packed, member, name, largest)
                    (target / name).parent.mkdir(parents=True, exist_ok=True)
                    (target / name).write_bytes(data)
                    left -= len(data)
                except Exception:  # damaged, encrypted, too large, or elsewhere
                    skipped += [member.filename] if name.suffix in (".py", ".zip") else []
        if skipped:
            text = "Of {file} this was not unpacked: {files}.", "{file} 中没有解压：{files}。"
            self.remarks[archive].append(say(*text, file=archive.name, files=_listed(skipped)))

    def below(self, place: Path) -> Iterator[tuple[int, Path, list[Text]]]:
        """Yield a place and all folders below it, zips unpacked: depth, folder, remarks; the nearest first."""
        waiting = [(0, place)]
        for depth, place in waiting:
            folder = self.folder(place)
            yield depth, folder, self.remarks.get(place, [])
            if depth < MAX_DEPTH:
                waiting += [(depth + 1, inside) for inside in self.places(folder)][: MAX_FOLDERS - len(waiting)]

    def answers(self, folder: Path) -> list[tuple[str, Path]]:
        """Return the files with answers in a folder, and their sections."""
        names = ((path.name.lower(), path) for path in _entries(folder) if not path.is_dir())
        return [(s, path) for name, path in names for s, pattern in self._patterns.items() if pattern.fullmatch(name)]

    def places(self, folder: Path) -> list[Path]:
        """Return the folders and zips in a folder."""
        inside = [x for x in _entries(folder) if not _is_hidden((x.name,)) and not x.is_symlink()]
        return [x for x in inside if x.is_dir() or (_is_zip(x) and x.is_file())]

    def places_of_students(self, place: Path, *, several: bool) -> list[Path]:
        """Return the folders and zips of students in a place: itself, those in it, or those in the only one in it."""
        folder = self.folder(place)
        if self.answers(folder):
            return [place]
        inside = self.places(folder)
        leads = any(self.answers(found) for one in inside for _, found, _ in self.below(one))
        if len(inside) == 1 and leads and not self.answers(self.folder(inside[0])):
            further = self.places_of_students(inside[0], several=several)
            return further if len(further) > 1 else [place if several else inside[0]]
        return inside if leads and not (several and len(inside) == 1) else [place]


def _pattern(file: str) -> re.Pattern[str]:
    """Return a pattern for the names of a section's file: ``ex_49_7 (1).py``, or with the student's name before."""
    name = file.removesuffix(".py").replace("_", "[ _.-]?")
    return re.compile(rf"(?:.*[^0-9a-z])?{name}(?:[^0-9a-z].*)?\.py(?:\.txt)?")


def _submission(place: Path, tree: _Tree, sections: Sequence[str]) -> Submission:
    """Choose a file for each section: the nearest with the right name, else the only one with a similar name."""
    found: dict[str, list[tuple[bool, int, Path]]] = {}
    others: list[str] = []
    remarks: list[Text] = []
    for depth, folder, remarked in tree.below(place):
        remarks += remarked
        answers = tree.answers(folder)
        for section, path in answers:
            found.setdefault(section, []).append((path.name != tree.course.file_name(section), depth, path))
        others += [path.name for path in _entries(folder) if path not in [x for _, x in answers] and path.is_file()]
    files: dict[str, Path] = {}
    for section, ways in found.items():
        name, best = tree.course.file_name(section), min(ways)[:2]
        first, *rest = [path for *rank, path in ways if tuple(rank) == best]
        further = [path.name for *_, path in ways if path != first]
        if any(_content(path) != _content(first) for path in rest):
            remarks.append(SEVERAL.fill(name=name, files=_listed([first.name, *further])))
            continue
        files[section] = first
        if first.name != name:
            remarks.append(
                say("{file} was taken for {name}.", "把 {file} 当作 {name} 评判。", file=first.name, name=name)
            )
        elif further:
            text = "{name} was judged, and not also {files}.", "评判了 {name}，没有评判 {files}。"
            remarks.append(say(*text, name=first.name, files=_listed(further)))
    missing = [tree.course.file_name(section) for section in sections if section not in found]
    if not found:
        text = "No exercises were found here. Here are: {files}.", "此处没有找到练习。这里有：{files}。"
        remarks.append(say(*text, files=_listed(others) if others else Text("nothing", "空")))
    elif missing:
        remarks.append(say("Not there: {files}.", "缺少：{files}。", files=_listed(missing)))
    folders = [path.parent for path in files.values()] or [tree.folder(place)]
    most = max(dict.fromkeys(folders), key=folders.count)
    student = os.fsencode(place.stem if _is_zip(place) else place.name).decode("utf-8", "backslashreplace")
    return Submission(student, most, files, tuple(remarks))


def _entries(folder: Path) -> list[Path]:
    """Return what is in a folder, in order; nothing where it may not be read."""
    try:
        return sorted(folder.iterdir())
    except OSError:
        return []


def _content(path: Path) -> bytes | str:
    try:
        return content(path)
    except OSError as error:
        return str(error)


def _member(packed: zipfile.ZipFile, member: zipfile.ZipInfo, name: PurePosixPath, largest: int) -> bytes:
    """Return the content of a member of a zip; not where it would be written elsewhere, or is too large."""
    if name.is_absolute() or ".." in name.parts or ":" in str(name):
        raise ValueError(f"{name}: expected a name in the folder")
    with packed.open(member) as source:
        data = source.read(largest + 1)
    if len(data) > largest:
        raise ValueError(f"{name}: expected at most {largest} bytes")
    return data


def _is_zip(path: PurePath) -> bool:
    return path.suffix.lower() == ".zip"


def _is_hidden(names: Sequence[str]) -> bool:
    return any((name.startswith(".") and name != "..") or name in OTHERS for name in names)


def _listed(names: Sequence[str], most: int = 6) -> str:
    return ", ".join(names[:most]) + (f", … ({len(names)})" if len(names) > most else "")
