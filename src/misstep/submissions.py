"""What the students of a class have handed in, as they and a learning platform name it: folders, and zips of them."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path, PurePath, PurePosixPath

from .course import Course
from .errors import CourseError
from .skeletons import skeleton
from .text import Text, say
from .workbook import MAX_FILE_BYTES, content

__all__ = ["Submission", "submissions"]

MAX_DEPTH = 5  # of folders in folders that are looked through
MAX_FOLDERS = 1000
MAX_MEMBERS = 100_000
MAX_ARCHIVE_BYTES = 200 * MAX_FILE_BYTES  # of a zip in a zip, and of all that is unpacked of one
OTHERS = ("__MACOSX", "__pycache__", "site-packages", "node_modules")
UNKNOWN_ARCHIVES = (".rar", ".7z", ".tar", ".gz", ".tgz", ".bz2", ".xz", ".zst", ".zipx", ".cab", ".iso")
UTF_8 = 0x800  # the flag of a member of a zip whose name is in UTF-8
CODE = (".py", ".ipynb", ".txt")  # files that may be answers under another name

SEVERAL = Text("None of several for {name} was judged: {files}.", "{name} 有好几份，都没有评判：{files}。")
CLOSED = Text("{file}: cannot be opened, unpack it.", "{file}：无法打开，请先解压。")
OF_NOBODY = Text(
    "Not judged, since no name says whose it is, or since it is no file that can be read: {files}.",
    "以下内容没有评判，因为从名字看不出是谁交的，或者不是可读的文件：{files}。",
)

CANVAS = re.compile(r"([^_]+)_(?:LATE_)?(\d+)_\d+_", re.IGNORECASE)
"""What Canvas puts before the name of a file: the student's name, his number and that of the file."""


@dataclass(frozen=True)
class Submission:
    """What a student has handed in: the folder with most of the files, the file of each section, and remarks.

    One that is not `of_student` has the remarks on what nobody's name stands on, and is not judged.
    """

    student: str
    folder: Path
    files: dict[str, Path]
    remarks: tuple[Text, ...]
    of_student: bool = True


@dataclass
class _Handed:
    """What belongs to one student: folders and zips, and files that stand beside those of others."""

    student: str
    places: list[Path]
    loose: list[tuple[Path, str]] = field(default_factory=list)  # with the name that each has without the student's


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
        students, strays = tree.students(place, several=len(given) > 1)
        found += [_submission(one, tree, sections) for one in students]
        remarks = [] if any(place in one.places for one in students) else list(tree.remarks.get(place, ()))
        remarks += [OF_NOBODY.fill(files=_listed([stray.name for stray in strays]))] if strays else []
        if remarks:
            found.append(Submission(_name(place), place, {}, tuple(remarks), of_student=False))
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
            members = packed.infolist()[:MAX_MEMBERS]
            for member, written in zip(members, _names(members), strict=True):
                name = PurePosixPath(written.replace("\\", "/"))
                if member.is_dir() or _is_hidden(name.parts[:-1]):
                    continue
                largest = min(left, MAX_ARCHIVE_BYTES if _is_zip(name) else MAX_FILE_BYTES)
                try:
                    data = _member(packed, member, name, largest) if not _is_closed(name) else b""
                    (target / name).parent.mkdir(parents=True, exist_ok=True)
                    (target / name).write_bytes(data)
                    left -= len(data)
                except Exception:  # damaged, encrypted, too large, or elsewhere
                    skipped += [written] if name.suffix.lower() in (".zip", *CODE, *UNKNOWN_ARCHIVES) else []
        if skipped:
            text = "Of {file} this was not unpacked: {files}.", "{file} 中没有解压：{files}。"
            self.remarks[archive].append(say(*text, file=archive.name, files=_listed(skipped)))

    def below(self, place: Path) -> Iterator[tuple[int, Path, list[Text], str]]:
        """Yield a place and all below it, zips unpacked, the nearest first: depth, folder, remarks, name from there."""
        waiting = [(0, place, "")]
        for depth, place, named in waiting:
            folder = self.folder(place)
            yield depth, folder, self.remarks.get(place, []), named
            if depth < MAX_DEPTH:
                inside = [(depth + 1, x, f"{named}{x.name}/") for x in self.places(folder)]
                waiting += inside[: MAX_FOLDERS - len(waiting)]

    def answers(self, folder: Path) -> list[tuple[str, Path]]:
        """Return the files with answers in a folder, and their sections."""
        files = (path for path in _entries(folder) if not path.is_dir())
        return [(s, path) for path in files for s, p in self._patterns.items() if p.fullmatch(path.name)]

    def places(self, folder: Path) -> list[Path]:
        """Return the folders and zips in a folder."""
        inside = [x for x in _entries(folder) if not _is_hidden((x.name,)) and not x.is_symlink()]
        return [x for x in inside if x.is_dir() or (_is_zip(x) and x.is_file())]

    def students(self, place: Path, *, several: bool) -> tuple[list[_Handed], list[Path]]:
        """Return what belongs to each student in a place, and the files in it that belong to nobody.

        The place is that of one student, or has those of students in it, or the only one in it has.
        """
        folder, alone = self.folder(place), ([_Handed(_name(place), [place])], list[Path]())
        inside, owned = self.places(folder), self._owned(folder)
        inside = [x for x in inside if x not in owned]
        leading = [x for x in inside if any(self.answers(found) for _, found, *_ in self.below(x))]
        by_canvas = {x for x in owned if x.name != owned[x][1] and CANVAS.match(x.name)}
        owners = {student for path, (student, name) in owned.items() if name != path.name}
        nameless = any(path not in owned for _, path in self.answers(folder))
        handed: dict[str, _Handed] = {}
        strays: list[Path] = []
        if (folder / self.course.state_file).is_file():
            return alone
        if owners or nameless:
            is_class = len(owners | {_name(x) for x in leading}) > 1 or (bool(by_canvas) and not nameless)
        elif leading and len(inside) == 1:
            further, within = self.students(inside[0], several=several)
            if len(further) > 1:
                handed, strays = {str(k): one for k, one in enumerate(further)}, within
            is_class = not several or bool(handed)
        else:
            is_class = bool(leading) or len(owned) > 1
        if not is_class:
            return alone
        for path in inside if not handed else ():
            student = _name(path)
            handed[student if student not in handed else str(path)] = _Handed(student, [path])
        for path, (student, name) in owned.items():
            handed.setdefault(student, _Handed(_printable(student), [])).loose.append((path, name))
        known = {*owned, *inside}
        strays += [x for x in _entries(folder) if x not in known and not _is_hidden((x.name,))]
        return list(handed.values()), strays

    def _owned(self, folder: Path) -> dict[Path, tuple[str, str]]:
        """Return the files in a folder that name a student, and for each the student and the rest of its name.

        Those are files with answers, all files where a learning platform names them, and archives that stay closed.
        """
        files = [x for x in _entries(folder) if not x.is_dir() and x.is_file() and not _is_hidden((x.name,))]
        before = {path: self._before(path) for _, path in self.answers(folder)}
        shaped = {x: found for x in files if (found := CANVAS.match(before.get(x, x.name)))}
        if not (shaped.keys() & before.keys() or (shaped and len(shaped) == len(files))):
            shaped = {}
        numbers: dict[str, set[str]] = {}
        for found in shaped.values():
            numbers.setdefault(found[1], set()).add(found[2])
        owned: dict[Path, tuple[str, str]] = {}
        for path in files:
            found, start = shaped.get(path), before.get(path, "")
            if found:
                student = found[1] if len(numbers[found[1]]) == 1 else f"{found[1]}_{found[2]}"
                owned[path] = student, path.name[found.end() :]
            elif student := start.strip(" _.-"):
                owned[path] = student, path.name[len(start) :]
            elif path not in before and _is_closed(path):
                owned[path] = _stem(path), path.name
        return owned

    def _before(self, path: Path) -> str:
        """Return what stands before the name of an exercise's file in the name of a file with answers."""
        return next((m[1] or "" for p in self._patterns.values() if (m := p.fullmatch(path.name))), "")

    def gathered(self, one: _Handed) -> list[Path]:
        """Return the places of a student; files that stand beside those of others go to a folder of their own."""
        if not one.loose:
            return one.places
        room = Path(tempfile.mkdtemp(dir=self._room))
        remarks = self.remarks.setdefault(room, [])
        for path, name in one.loose:
            try:
                if _is_closed(path):
                    (room / name).touch()
                else:
                    shutil.copyfile(path, room / (name if not (room / name).exists() else path.name))
            except OSError as error:
                remarks.append(
                    say("{file} cannot be read: {error}", "无法读取 {file}：{error}", file=path.name, error=error)
                )
        return [*one.places, room]


def _pattern(file: str) -> re.Pattern[str]:
    """Return a pattern for the names of a section's file: ``ex_49_7 (1).py``, or with the student's name before."""
    name = file.removesuffix(".py").replace("_", "[ _.-]?")
    return re.compile(rf"(.*[^0-9a-z])?{name}(?:[^0-9a-z].*)?\.py(?:\.txt)?", re.IGNORECASE)


def _submission(one: _Handed, tree: _Tree, sections: Sequence[str]) -> Submission:
    """Choose a file for each section: the nearest with the right name, else the only one with a similar name.

    One that is as `start` wrote it gives way to one that is not.
    """
    found: dict[str, list[tuple[bool, int, Path]]] = {}
    names: dict[Path, str] = {}
    remarks: list[Text] = []
    places = tree.gathered(one)
    for depth, folder, remarked, named in (each for place in places for each in tree.below(place)):
        remarks += remarked
        names |= {path: named + path.name for path in _entries(folder) if path.is_file() and not _is_zip(path)}
        for section, path in tree.answers(folder):
            found.setdefault(section, []).append((path.name != tree.course.file_name(section), depth, path))
    files: dict[str, Path] = {}
    for section, every in found.items():
        name = tree.course.file_name(section)
        written = [way for way in every if not _is_untouched(tree.course, section, way[-1])] if len(every) > 1 else []
        ways = written or every
        best = min(ways)[:2]
        first, *rest = [path for *rank, path in ways if tuple(rank) == best]
        further = [names[path] for *_, path in every if path != first]
        if any(_content(path) != _content(first) for path in rest):
            remarks.append(SEVERAL.fill(name=name, files=_listed([names[first], *further])))
            continue
        files[section] = first
        if first.name != name:
            text = "{file} was taken for {name}.", "把 {file} 当作 {name} 评判。"
            remarks.append(say(*text, file=names[first], name=name))
        if further:
            text = "{name} was judged, and not also {files}.", "评判了 {name}，没有评判 {files}。"
            remarks.append(say(*text, name=names[first], files=_listed(further)))
    judged = {path for ways in found.values() for *_, path in ways}
    others = [name for path, name in names.items() if path not in judged and not _is_hidden((path.name,))]
    closed = [name for name in others if _is_closed(PurePath(name))]
    remarks += [CLOSED.fill(file=name) for name in closed]
    missing = [tree.course.file_name(section) for section in sections if section not in found]
    if not found and not (closed and closed == others):
        text = "No exercises were found here. Here are: {files}.", "此处没有找到练习。这里有：{files}。"
        remarks.append(say(*text, files=_listed(others) if others else Text("nothing", "空")))
    elif found and missing:
        remarks.append(say("Not there: {files}.", "缺少：{files}。", files=_listed(missing)))
        if unknown := [name for name in others if name.lower().endswith(CODE)]:
            remarks.append(say("Here are also: {files}.", "这里还有：{files}。", files=_listed(unknown)))
    folders = [path.parent for path in files.values()] or [tree.folder(places[0])]
    most = max(dict.fromkeys(folders), key=folders.count)
    return Submission(one.student, most, files, tuple(remarks))


def _name(place: Path) -> str:
    return _printable(place.stem if _is_zip(place) else place.name)


def _stem(path: PurePath) -> str:
    """Return the name of an archive without what says how it is packed, as .tar.gz."""
    while _is_closed(path) and path.stem:
        path = path.with_name(path.stem)
    return path.name


def _printable(name: str) -> str:
    """Return the name of a file as it can be written in UTF-8."""
    return os.fsencode(name).decode("utf-8", "backslashreplace")


def _is_untouched(course: Course, section: str, path: Path) -> bool:
    """Whether a file is as `start` wrote it, or empty; blanks and ends of lines do not count."""
    try:
        text = content(path).decode("utf-8", "replace").split()
    except OSError:
        return False
    return not text or any(text == skeleton(course, section, language).split() for language in ("en", "zh"))


def _names(members: Sequence[zipfile.ZipInfo]) -> list[str]:
    """Return the names of the members of a zip, also where they are in UTF-8 or GBK and the zip does not say so."""
    plain = [member for member in members if not member.flag_bits & UTF_8]
    for coding in ("utf-8", "gbk"):
        try:
            read = [member.orig_filename.encode("cp437").decode(coding) for member in plain]
        except UnicodeError:
            continue
        wide = [c for c in "".join(read) if ord(c) > 127]
        common = [c for c in wide if _is_common(c)]
        if coding == "utf-8" or (common and all("　" <= c <= "￯" for c in wide)):
            named = dict(zip(map(id, plain), read, strict=True))
            return [named.get(id(member), member.filename) for member in members]
    return [member.filename for member in members]


def _is_common(character: str) -> bool:
    """Whether a Chinese character is one of the 6763 common ones: letters of Europe read as GBK give others."""
    try:
        return len(character.encode("gb2312")) == 2 and "一" <= character <= "鿿"
    except UnicodeError:
        return False


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


def _is_closed(path: PurePath) -> bool:
    return path.suffix.lower() in UNKNOWN_ARCHIVES


def _is_hidden(names: Sequence[str]) -> bool:
    return any((name.startswith(".") and name != "..") or name in OTHERS for name in names)


def _listed(names: Sequence[str], most: int = 6) -> str:
    return ", ".join(map(_printable, names[:most])) + (f", … ({len(names)})" if len(names) > most else "")
