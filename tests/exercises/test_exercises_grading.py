"""A class is graded: each folder by itself, points for each function, and what was used to get there."""

import csv
import io
import re
import sys
import zipfile

import pytest

from misstep import skeletons
from misstep.errors import CourseError
from misstep.grading import grade
from misstep.sheets import as_csv, as_html, as_table
from misstep.submissions import submissions
from twistwrench.cli import main
from twistwrench.errors import NameNotFound
from twistwrench.exercises import hint, solution, start
from twistwrench.exercises.chapter import COURSE

from .test_exercises_isolation import write

FOUR = ["49.0.1", "49.0.2", "49.6.3", "49.3.3"]


@pytest.fixture(scope="module")
def room(tmp_path_factory):
    folder = tmp_path_factory.mktemp("class")
    for name in ("ada", "bela", "chen", "dora", "emil"):
        start(folder / name, language="zh" if name == "chen" else "en")
    with pytest.MonkeyPatch.context() as patch:  # in this process, while nothing is endless yet
        patch.setattr(sys, "executable", "")
        hint("49.0.1", folder / "bela")
        hint("49.0.1", folder / "bela")
        solution("49.0.2", folder / "bela")
    for section in ("49.0", "49.3", "49.6"):
        file = folder / "ada" / COURSE.file_name(section)
        file.write_text(skeletons.solved(COURSE, section, "en"), encoding="utf-8")
    write(folder / "bela", "49.0", {"skew": "while True:\n    pass", "act": "return R @ x + p"})
    body = "import os\nos._exit(0)"
    write(folder / "chen", "49.0", {"skew": body, "act": "return R @ x - p"}, more='\nanswer_49_0_3 = "=1+1 <b>"\n')
    by_rnea = "return tw.rnea(model, q, np.zeros(model.nv), np.zeros(model.nv))[:6]"
    write(folder / "dora", "49.6", {"base_wrench_at_rest": by_rnea})
    write(folder / "dora", "49.0", {"skew": "return mine('skew')(w)"})
    (folder / "emil" / "ex_49_0.py").write_text("def broken(:\n", encoding="utf-8")
    (folder / "notes.txt").write_text("not a folder", encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def found(room):
    return grade(COURSE, [room], only=[*FOUR, "49.0.3"], seed=5, time_limit=1.5)


def test_each_student_has_the_points_of_what_is_right(found):
    points = {one.student: {number: mark.points for number, mark in one.marks.items()} for one in found}
    assert list(points)[:-1] == ["ada", "bela", "chen", "dora", "emil"]
    assert found[-1].marks == {}
    assert "notes.txt" in found[-1].remarks[0].en
    assert set(points["ada"].values()) == {1}
    assert points["bela"] == {"49.0.1": 0, "49.0.2": 1, "49.0.3": 0, "49.3.3": 0, "49.6.3": 0}
    assert sum(points["chen"].values()) == sum(points["dora"].values()) == sum(points["emil"].values()) == 0


@pytest.mark.slow
def test_a_part_of_an_exercise_gives_a_part_of_its_point(room, tmp_path):
    start(tmp_path / "one", language="en")
    half = "rest = np.zeros(18)\nreturn tw.rnea(tw.load('go2'), tw.load('go2').neutral(), rest, rest)[:6]"
    write(tmp_path / "one", "49.6", {"go2_base_wrench": half})
    (one,) = grade(COURSE, [tmp_path / "one"], only=["49.6.3"])
    assert one.points == 0.5


def test_the_rows_say_what_was_used_and_why_there_are_no_points(found):
    text = as_csv(found, 5, "en")
    assert text.startswith("\ufeff")
    rows = {(r["student"], r["function"]): r for r in csv.DictReader(io.StringIO(text.removeprefix("\ufeff")))}
    assert rows["bela", "skew"]["hints"] == "2"
    assert rows["bela", "skew"]["solution"] == "0"
    assert rows["bela", "act"]["solution"] == "1"
    assert rows["bela", "skew"]["reason"].startswith("It did not finish in 1.5 s")
    assert rows["chen", "skew"]["reason"] == "It ended the whole Python process."
    assert rows["chen", "act"]["slips"] == "translation-sign"
    assert "the translation has the wrong sign" in rows["chen", "act"]["reason"]  # not how many cases are wrong
    assert "calls tw.rnea" in rows["dora", "base_wrench_at_rest"]["reason"]
    assert "that you are to write here" in rows["dora", "skew"]["reason"]
    assert "SyntaxError" in rows["emil", "act"]["reason"]
    assert rows["chen", "answer_49_0_3"]["words"] == "'=1+1 <b>"
    assert {row["seed"] for row in rows.values()} == {"5"}


def test_the_page_has_the_points_and_the_words_beside_the_model_answer(found):
    for language in ("en", "zh"):
        page = as_html(found, 5, language)
        model = COURSE.exercise("49.0.3").answer.of(language).strip().split("\n")[0]
        assert page.index(model[:20]) < page.index("=1+1 &lt;b&gt;")
        assert page.count("<details") == page.count("</details>")
        assert "<script" not in page
        links = re.findall(r'href="#([^"]+)"', page)
        assert len(links) == sum(
            any(v.state == "wrong" for v in m.functions.values()) for x in found for m in x.marks.values()
        )
        assert all(page.count(f'id="{link}"') == 1 for link in links)
    assert "--seed 5" in as_html(found, 5, "en")


def test_the_command_writes_what_is_asked_for(room, tmp_path, capsys):
    files = [tmp_path / name for name in ("a.csv", "a.html")]
    command = ["exercises", "grade", str(room / "ada"), str(room / "dora"), "--only", "49.0.2", "--seed", "3"]
    for option, file in zip(("--csv", "--html"), files, strict=True):
        command += [option, str(file)]
    assert main([*command, "--language", "en"]) == 0
    out = capsys.readouterr().out
    assert "ada      1.00 / 1" in out
    assert "--seed 3" in out
    assert all(file.stat().st_size > 100 for file in files)


@pytest.mark.slow
def test_a_folder_without_exercises_is_a_line_and_not_an_end(room, tmp_path):
    (tmp_path / "late").mkdir()
    found = grade(COURSE, [tmp_path / "late", room / "ada"], only=["49.0.1"])
    assert [one.points for one in found] == [0, 1]
    assert "No exercises were found here" in as_table(found, 0, "en")


def test_the_columns_are_those_that_others_rely_on(found):
    header, *rows = csv.reader(io.StringIO(as_csv(found, 5, "en").removeprefix("\ufeff")))
    columns = "student exercise function state points of hints solution slips how reason words seed"
    assert header == columns.split()
    assert {row[3] for row in rows if row[2]} <= {"done", "wrong", "to do"}
    assert {row[9] for row in rows if row[8]} == {"slip"}


ACT = "return R @ x + p"


def answers(folder, name="ex_49_0.py"):
    """Start a folder with a right `act` in a file of that name."""
    start(folder, language="en")
    write(folder, "49.0", {"act": ACT})
    (folder / "ex_49_0.py").rename(folder / name)
    return folder


def graded(*places):
    """Return the points in 49.0.2, and the remarks, by student."""
    return {x.student: (x.points, " ".join(r.en for r in x.remarks)) for x in grade(COURSE, places, only=["49.0.2"])}


@pytest.mark.slow
def test_answers_are_found_under_the_names_that_they_are_handed_in_with(tmp_path):
    room = tmp_path / "class"
    answers(room / "ada" / "answers")
    answers(room / "bela_1234_assignsubmission_file" / "week" / "one", "ex_49_0 (1).py")
    answers(room / "chen", "chen_98765_ex49_0-2.PY")
    answers(room / "dora", "ex_49_0_new.py")
    (room / "dora" / "ex_49_0_old.py").write_text("def act(R, p, x):\n    return x\n", encoding="utf-8")
    answers(room / "emil")
    (room / "emil" / "ex_49_0 (1).py").write_text("x = 1\n", encoding="utf-8")
    (room / "fay").mkdir()
    (room / "fay" / "homework.pdf").write_text("", encoding="utf-8")
    answers(room / "gus", "answers.py")
    found = graded(room)
    assert found["ada"] == (1, "")
    points, remark = found["bela_1234_assignsubmission_file"]
    assert (points, remark) == (1, "week/one/ex_49_0 (1).py was taken for ex_49_0.py.")
    assert found["chen"][0] == 1
    assert found["dora"][0] == 0
    assert "ex_49_0_new.py, ex_49_0_old.py" in found["dora"][1]
    assert found["emil"][0] == 1
    assert "ex_49_0 (1).py" in found["emil"][1]
    assert found["fay"] == (0, "No exercises were found here. Here are: homework.pdf.")
    assert found["gus"] == (0, "Not there: ex_49_0.py. Here are also: answers.py.")


def test_every_file_of_a_student_is_found(tmp_path):
    start(tmp_path / "ada")
    (tmp_path / "room").mkdir()
    (one,) = submissions(COURSE, [tmp_path / "ada"], tmp_path / "room", [*COURSE.sections])
    assert {section: path.name for section, path in one.files.items()} == {
        section: COURSE.file_name(section) for section in COURSE.sections
    }
    assert one.remarks == ()


@pytest.mark.slow
def test_remarks_are_on_the_page_in_the_table_and_in_the_rows(tmp_path):
    answers(tmp_path / "class" / "ada", "ex_49_0 (1).py")
    answers(tmp_path / "class" / "bela")
    found = grade(COURSE, [tmp_path / "class"], only=["49.0.2"])
    for shown in (as_table, as_html, as_csv):
        assert "ex_49_0 (1).py was taken for ex_49_0.py." in shown(found, 0, "en")
        assert "ex_49_0 (1).py" in shown(found, 0, "zh")


@pytest.mark.parametrize(
    ("tree", "given", "students"),
    [
        ({"class/ada/": 1, "class/bela/": 1}, ["class"], ["ada", "bela"]),
        ({"class/ada/": 1}, ["class"], ["ada"]),
        ({"class/ada/answers/": 1}, ["class"], ["ada"]),
        ({"class/ada/answers/": 1, "class/bela/": 1}, ["class/ada", "class/bela"], ["ada", "bela"]),
        ({"class/class/ada/": 1, "class/class/bela/x/": 1}, ["class"], ["ada", "bela"]),
        ({"ada/": 1}, ["ada"], ["ada"]),
        ({"a/week/ada/": 1, "a/week/bela/": 1, "b/chen/": 1}, ["a", "b"], ["ada", "bela", "b"]),
        ({"class/ada.zip": {"": 1}, "class/bela.zip": {"answers/": 1}}, ["class"], ["ada", "bela"]),
        ({"class.zip": {"ada/": 1, "bela/answers/": 1, "__MACOSX/ada/": 1}}, ["class.zip"], ["ada", "bela"]),
        ({"class.zip": {"class/ada/": 1, "class/bela/": 1}}, ["class.zip"], ["ada", "bela"]),
        ({"class.zip": {"ada.zip": {"": 1}, "bela.zip": {"x/": 1}}}, ["class.zip"], ["ada", "bela"]),
        ({"class/ada/mine.zip": {"answers/": 1}, "class/bela/": 1}, ["class"], ["ada", "bela"]),
    ],
)
def test_folders_and_zips_of_any_depth_are_those_of_their_students(tmp_path, tree, given, students):
    for place, held in tree.items():
        made = tmp_path / place
        (made if held == 1 else made.parent).mkdir(parents=True, exist_ok=True)
        if held == 1:
            (made / "ex_49_0.py").write_text("x = 1\n", encoding="utf-8")
        else:
            made.write_bytes(packed(held))
    (tmp_path / "room").mkdir()
    found = submissions(COURSE, [tmp_path / place for place in given], tmp_path / "room", ["49.0"])
    assert [one.student for one in found] == students
    assert all(one.files["49.0"].read_text(encoding="utf-8") == "x = 1\n" for one in found)


def packed(tree):
    """Return a zip: of a folder a file with answers, of a zip its content."""
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w") as archive:
        for place, held in tree.items():
            archive.writestr(place + "ex_49_0.py" if held == 1 else place, "x = 1\n" if held == 1 else packed(held))
    return made.getvalue()


def handed(folder, tree):
    """Write files; return by student the answers and the remarks."""
    for name, text in tree.items():
        made = folder / "class" / name
        made.parent.mkdir(parents=True, exist_ok=True)
        made.write_bytes(text if isinstance(text, bytes) else text.encode())
    (folder / "room").mkdir()
    found = submissions(COURSE, [folder / "class"], folder / "room", ["49.6", "49.7"])
    assert all(one.of_student or not one.files for one in found)
    return {
        one.student: ([x.read_text(encoding="utf-8") for x in one.files.values()], " ".join(r.en for r in one.remarks))
        for one in found
    }


SIX, SEVEN = "ex_49_6.py", "ex_49_7.py"


def test_files_of_many_students_in_one_folder_belong_to_those_whose_names_they_have(tmp_path):
    names = {
        "adalovelace_1_11_ex_49_6.py": "ada 6",
        "adalovelace_1_12_ex_49_7-1.py": "ada 7",
        "boli_LATE_2_13_final.py": "bo",
        "liwei_3_14_ex_49_6.py": "li wei 6",
        "liwei_4_15_ex_49_6.py": "li wei 6",
        "zhang_5_16_mine.zip": packed({"x/": 1}),
        "yan_6_17_mine.rar": "",
    }
    found = handed(tmp_path, names)
    assert sorted(found) == ["adalovelace", "boli", "liwei_3", "liwei_4", "yan", "zhang"]
    assert found["adalovelace"] == (["ada 6", "ada 7"], "ex_49_7-1.py was taken for ex_49_7.py.")
    assert found["boli"] == ([], "No exercises were found here. Here are: final.py.")
    assert found["liwei_3"][0] == found["liwei_4"][0] == ["li wei 6"]
    assert "mine.rar: cannot be opened, unpack it." in found["yan"][1]


@pytest.mark.parametrize(
    ("names", "students"),
    [
        ([f"ada {SIX}", f"ada-{SEVEN}", f"张三_{SIX}"], ["ada", "张三"]),
        ([SIX, f"old_{SIX}"], ["class"]),
        ([SIX, f"bo_1_11_{SIX}"], ["class"]),
        ([f"ada_{SIX}", f"ada_{SEVEN}"], ["class"]),
        ([f"adalovelace_1_11_{SIX}"], ["adalovelace"]),
        ([SIX, f"copy/{SIX}"], ["class"]),
        ([SIX, f"copy/{SIX}", f"old/{SIX}", COURSE.state_file], ["class"]),
        ([f"ada/{SIX}", f"bo/{SIX}", f"ada_{SEVEN}"], ["ada", "bo"]),
        ([f"ada/{SIX}", f"frida_{SIX}"], ["ada", "frida"]),
        ([SIX, f"old/{SIX}", f"bo_1_11_{SIX}"], ["bo", "class", "old"]),
        (["zoe.rar", "yan.tar.gz"], ["yan", "zoe"]),
        ([f"week/ada_{SIX}", f"week/bo_{SIX}"], ["ada", "bo"]),
        ([f"week/ada_{SIX}", f"week/bo_{SIX}", "zoe.rar"], ["ada", "bo", "zoe"]),
    ],
)
def test_what_stands_before_the_name_of_a_file_is_a_student_where_there_are_several(tmp_path, names, students):
    assert sorted(handed(tmp_path, dict.fromkeys(names, "x = 1"))) == students


def test_nothing_beside_the_folders_of_students_goes_unmentioned(tmp_path):
    names = [f"ada/{SIX}", f"bo/{SIX}", "bo/more.7z", f"frida_{SIX}", SEVEN, "zoe.rar", "homework.pdf", "ada.tar.gz"]
    found = handed(tmp_path, dict.fromkeys(names, "x = 1"))
    assert sorted(found) == ["ada", "bo", "class", "frida", "zoe"]
    assert found["class"][1].endswith(": ex_49_7.py, homework.pdf.")
    for student, archive in (("zoe", "zoe.rar"), ("bo", "more.7z"), ("ada", "ada.tar.gz")):
        assert f"{archive}: cannot be opened, unpack it." in found[student][1]


def test_an_untouched_file_gives_way_to_one_that_is_written(tmp_path):
    empty = skeletons.skeleton(COURSE, "49.7", "zh")
    found = handed(tmp_path, {f"a/{SEVEN}": empty, f"a/copy/{SEVEN}": "y", f"b/{SEVEN}": "x", f"b/copy/{SEVEN}": "y"})
    assert found["a"][0] == ["y"]
    assert "copy/ex_49_7.py was judged, and not also ex_49_7.py." in found["a"][1]
    assert found["b"][0] == ["x"]
    assert "ex_49_7.py was judged, and not also copy/ex_49_7.py." in found["b"][1]


def test_what_may_be_a_missing_file_is_listed(tmp_path):
    _, remark = handed(tmp_path, {"chen/ex_49_6 (1).py": "x", "chen/sub/final_version.py": "y"})["chen"]
    assert remark.endswith("Not there: ex_49_7.py. Here are also: sub/final_version.py.")


@pytest.mark.parametrize(
    ("name", "coding", "student"),
    [("张三_124", "gbk", "张三_124"), ("张喆", "utf-8", "张喆"), ("José_1", "cp437", "José_1"), ("ada", "gbk", "ada")],
)
def test_names_in_a_zip_are_read_as_they_were_written(tmp_path, name, coding, student):
    stands = packed({"N" * len(name.encode(coding)) + "/": 1, "bela/": 1})
    data = stands.replace(b"N" * len(name.encode(coding)) + b"/", name.encode(coding) + b"/")
    (tmp_path / "class.zip").write_bytes(data)
    (tmp_path / "room").mkdir()
    found = submissions(COURSE, [tmp_path / "class.zip"], tmp_path / "room", ["49.0"])
    assert {one.student for one in found} == {student, "bela"}


def test_what_is_of_nobody_and_what_nobody_knows_are_shown(room, tmp_path):
    (tmp_path / "one").mkdir()
    for name in ("ada", "bo"):
        (tmp_path / "one" / f"{name}_ex_49_0.py").write_text("x = 1\n", encoding="utf-8")
    (tmp_path / "one" / "what.docx").touch()
    found = grade(COURSE, [tmp_path / "one"], only=["49.0.1"])
    assert [one.student for one in found] == ["ada", "bo", "one"]
    assert all("what.docx" in shown(found, 0, "en") for shown in (as_table, as_html, as_csv))
    assert re.search(r"^ada +0.00 / 1 +– +– +0$", as_table(found, 0, "en"), re.MULTILINE)
    rows = list(csv.DictReader(io.StringIO(as_csv(found, 0, "zh").removeprefix("\ufeff"))))
    assert [(row["state"], row["hints"], row["solution"]) for row in rows if row["function"] == "skew"] == [
        ("有误", "", "")
    ] * 2
    assert as_html(found[::-1], 0, "en").count("<td>0.00 –</td>") == 2


def test_a_zip_writes_nothing_elsewhere_and_unpacks_nothing_huge(tmp_path):
    room = tmp_path / "class" / "room"
    room.mkdir(parents=True)
    with zipfile.ZipFile(tmp_path / "ada.zip", "w", zipfile.ZIP_DEFLATED) as archive:
        for name in ("../above.py", "/absolute-49.py", "C:\\drive.py", "a/../../b.py"):
            archive.writestr(name, "")
        archive.writestr("huge.py", b"#" * 30_000_000)
        archive.writestr("ex_49_0.py", "x = 1\n")
        archive.writestr("ex_49_1.py", "x = 2\n")
    damaged = (tmp_path / "ada.zip").read_bytes()
    at = damaged.index(b"ex_49_1.py") + len("ex_49_1.py")
    (tmp_path / "ada.zip").write_bytes(damaged[:at] + b"\0\0\0" + damaged[at + 3 :])
    (tmp_path / "bela.zip").write_bytes(b"PK no zip")
    ada, bela = submissions(COURSE, [tmp_path / "ada.zip", tmp_path / "bela.zip"], room, ["49.0"])
    assert [path.name for path in room.rglob("*") if path.is_file()] == ["ex_49_0.py"]
    assert ada.remarks[0].en.startswith("Of ada.zip this was not unpacked: ../above.py, /absolute-49.py, C:")
    assert "huge.py, ex_49_1.py" in ada.remarks[0].en
    assert "bela.zip cannot be unpacked" in bela.remarks[0].en
    assert sorted(path.name for path in tmp_path.iterdir()) == ["ada.zip", "bela.zip", "class"]


@pytest.mark.slow
def test_each_student_has_a_line_and_rows_as_soon_as_he_is_done(room, tmp_path, capsys, monkeypatch):
    file, sizes = tmp_path / "a.csv", []
    monkeypatch.setattr(sys.stderr, "write", lambda text: sizes.append(file.exists() and file.stat().st_size))
    command = ["exercises", "grade", str(room / "ada"), str(room / "dora"), "--only", "49.0.2", "--csv", str(file)]
    assert main([*command, "--jobs", "1"]) == 0
    written = [size for size in sizes if size]
    assert len(written) >= 1
    assert written[0] < file.stat().st_size


@pytest.mark.parametrize("option", ["--csv", "--html"])
def test_a_file_that_cannot_be_written_is_told_before_anything_is_judged(room, tmp_path, capsys, option):
    missing = str(tmp_path / "nowhere" / "marks")
    assert main(["exercises", "grade", str(room), option, missing]) == 2
    told = capsys.readouterr().err
    assert missing in told
    assert "1/5" not in told


@pytest.mark.parametrize("option", [["--jobs", "-1"], ["--jobs", "0"], ["--seed", "-5"]])
def test_a_negative_number_is_told_in_a_sentence(room, capsys, option):
    with pytest.raises(SystemExit, match="2"):
        main(["exercises", "grade", str(room), *option])
    assert f"or more, got '{option[1]}'" in capsys.readouterr().err
    with pytest.raises(CourseError, match=f"{option[0][2:]}: expected a whole number"):
        grade(COURSE, [room], **{option[0][2:]: int(option[1])})


def test_what_is_not_there_is_an_error(room, tmp_path):
    with pytest.raises(CourseError, match="expected the folder of a student"):
        grade(COURSE, [tmp_path / "nobody"])
    with pytest.raises(NameNotFound, match="exercise or section"):
        grade(COURSE, [room], only=["49.60"])
