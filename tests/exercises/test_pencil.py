"""The questions for paper and pencil: every answer is computed, in both languages, and Moodle can read them."""

import dataclasses
import re
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest

import twistwrench as tw
from misstep.text import Text
from twistwrench.errors import NameNotFound
from twistwrench.exercises import pencil
from twistwrench.exercises.chapter import COURSE
from twistwrench.exercises.pencil import NEAR, SECTIONS, PencilQuestion, gift, pencil_questions, plain, sheet

ALL = {f"{section}-{k}": one for section in SECTIONS for k, one in enumerate(pencil_questions(section), start=1)}


# ---------------------------------------------------------------- what the expressions of the questions may use


def turn(axis, degrees):
    return tw.exp3(np.deg2rad(degrees) * np.eye(3)["xyz".index(axis)])


def body(mass, com, inertia):
    return tw.SpatialInertia(mass, np.array(com, dtype=float), np.asarray(inertia, dtype=float))


def thin_rod(mass=1.0, length=1.0):
    """A thin rod that hangs from the origin."""
    return body(mass, [0, 0, -length / 2], mass * length**2 / 12 * np.diag([1, 1, 0]))


def rods(n, mass=1.0, length=1.0, g=10.0):
    """Thin rods in a chain that hangs down, with hinges about y."""
    builder = tw.Builder("rods", gravity=[0, 0, -g])
    for k in range(n):
        below = tw.SE3(np.eye(3), [0, 0, -length if k else 0])
        parent = f"rod_{k - 1}" if k else "base_link"
        builder.link(f"rod_{k}", parent=parent, joint=tw.Revolute("y"), placement=below, inertia=thin_rod(mass, length))
    return builder.build()


def tree(base, legs, joints):
    """A base with legs of hinges about x and y in turn; the last link of leg k ends at the frame tip_k."""
    root = body(5, [0.02, 0.01, 0.03], 0.1 * np.eye(3)) if base == "floating" else None
    builder = tw.Builder("tree", base=base, root_inertia=root)
    for leg in range(legs):
        angle = 2 * np.pi * leg / legs + 0.2
        for joint in range(joints):
            parent = f"link_{leg}_{joint - 1}" if joint else "base_link"
            at = [0, 0, -0.2] if joint else [0.3 * np.cos(angle), 0.2 * np.sin(angle), 0]
            kind, link = tw.Revolute("y" if joint else "x"), body(0.5, [0.01, 0.02, -0.1], 0.002 * np.eye(3))
            name = f"link_{leg}_{joint}"
            builder.link(name, parent=parent, joint=kind, placement=tw.SE3(np.eye(3), at), inertia=link)
        end = tw.SE3(np.eye(3), [0, 0, -0.2])
        builder.link(f"tip_{leg}", parent=f"link_{leg}_{joints - 1}", placement=end)
    return builder.build()


def floating(legs, joints):
    return tree("floating", legs, joints)


def fixed(legs, joints):
    return tree("fixed", legs, joints)


def askew(model):
    """A posture in which nothing is zero by accident."""
    return model.random_configuration(rng=np.random.default_rng(49))


def balls():
    builder = tw.Builder("balls", base="floating", root_inertia=body(1, [0, 0, 0], np.eye(3)))
    for k, joint in enumerate([tw.Spherical()] * 2 + [tw.Revolute("y")] * 4):
        builder.link(f"link_{k}", parent="base_link", joint=joint, inertia=thin_rod())
    return builder.build()


def free_body(inertia):
    return tw.Builder("stone", base="floating", root_inertia=body(2, [0, 0, 0], inertia), gravity=[0, 0, 0]).build()


def euler_holds(offset):
    """Whether τ = I ω̇ + ω × I ω about a point of a body so far from its centre of mass, in a motion drawn at random."""
    stone, (V, A) = body(2, [offset, 0, 0], np.diag([1.0, 2, 3])), np.random.default_rng(3).standard_normal((2, 6))
    moment = (stone.matrix() @ A + tw.cross_force(V) @ stone.matrix() @ V)[:3]
    I_O = stone.matrix()[:3, :3]
    return np.allclose(moment, I_O @ A[:3] + np.cross(V[:3], I_O @ V[:3]))


def second_derivative(path, h=1e-4):
    return (path(h) - 2 * path(0.0) + path(-h)) / h**2


def articulated(inertia):
    """The inertia that is felt through a free hinge about y."""
    I, S = inertia.matrix(), tw.Revolute("y").subspace()
    return I - I @ S @ np.linalg.inv(S.T @ I @ S) @ S.T @ I


def pushed_rod(mass, force):
    """Accelerations of the pushed end, the middle and the far end of a free rod of 2 m, by Newton and Euler."""
    a, alpha = force / mass, force * 1.0 / (mass * 2.0**2 / 12)
    by_matrix = np.linalg.lstsq(thin_rod(mass, 2.0).matrix(), [0, 0, 0, force, 0, 0])[0][3]  # at its end
    assert np.isclose(by_matrix, a + alpha)
    return [a + alpha, a, a - alpha]


def flywheels(one, other):
    """Relative acceleration of two wheels for 1 N m between them: both free, and the first held."""
    builder = tw.Builder("wheels", base="floating", root_inertia=body(1, [0, 0, 0], one * np.eye(3)), gravity=[0, 0, 0])
    builder.link("wheel", parent="base_link", joint=tw.Revolute("z"), inertia=body(1, [0, 0, 0], other * np.eye(3)))
    free = tw.aba(builder.build(), [0, 0, 0, 0, 0, 0, 1, 0], np.zeros(7), np.eye(7)[6])[6]
    builder = tw.Builder("wheel", gravity=[0, 0, 0])
    builder.link("wheel", parent="base_link", joint=tw.Revolute("z"), inertia=body(1, [0, 0, 0], other * np.eye(3)))
    return [free, tw.aba(builder.build(), [0], [0], [1])[0]]


def weight_at_tip(mass):
    """A weight at the tip of two stretched rods that point along −x or x, as a wrench on the second one."""
    arm, q = rods(2), [np.pi / 2, 0]
    placed = tw.forward_kinematics(arm, q).placement[2]
    f_ext = np.zeros((3, 6))
    f_ext[2] = tw.force_transform(np.eye(3), [0, 0, -1]) @ [0, 0, 0, *(placed.rotation.T @ [0, 0, -10.0 * mass])]
    return f_ext


def heavy_base(mass):
    """The torques of a small fixed arm whose base link has this mass, as text."""
    builder = tw.Builder("arm", root_inertia=body(mass, [0, 0, 0], mass * np.eye(3)))
    builder.link("rod", parent="base_link", joint=tw.Revolute("y"), inertia=thin_rod())
    return str(tw.rnea(builder.build(), [0.4], [0.5], [0.6]))


def chain_work(n):
    """Lines of ABA that set a term, for a chain: those in loops every time."""
    return len(tw.trace(rods(n), "aba", np.ones(n), np.ones(n), tau=np.ones(n)).steps), n**3


def climbs(model):
    return sum(len(model.support(i)) - 1 for i in range(1, model.nbodies))


def needed_from_the_ground(push, height, weight):
    """The wrench about the point of the floor below the centre of mass that a sideways push asks of the ground."""
    of_push = tw.force_transform(np.eye(3), [0, 0, height]) @ [0, 0, 0, 0, push, 0]
    return np.array([0, 0, 0, 0, 0, weight]) - of_push


def squeezed():
    """Whether two feet pulled together change the motors' torques and not the base's rows."""
    go2 = tw.load("go2")
    J = tw.contact_jacobian(go2, go2.standing(), ["FL_foot", "FR_foot"])
    change = J.T @ [0, -20, 0, 0, 20, 0]
    return np.allclose(change[:6], 0, atol=1e-12) and np.abs(change[6:]).max() > 1


def slides(trunk, leg):
    """A trunk and a leg that slide vertically, the leg on the trunk."""
    builder = tw.Builder("slides", gravity=[0, 0, -10])
    for name, parent, mass in (("trunk", "base_link", trunk), ("leg", "trunk", leg)):
        builder.link(name, parent=parent, joint=tw.Prismatic("z"), inertia=body(mass, [0, 0, 0], np.eye(3)))
    return builder.build()


def total_momentum(points):
    """k_G and l_G of points: mass, position, velocity."""
    mass = sum(m for m, *_ in points)
    G = sum(m * np.array(p) for m, p, _ in points) / mass
    k = sum(m * np.cross(np.subtract(p, G), v) for m, p, v in points)
    return np.concatenate([k, sum(m * np.array(v) for m, _, v in points)])


def in_the_air(mass, g):
    """The rate of h_G of a robot in the air with random torques; its mass is scaled to the one that is asked."""
    model = dataclasses.replace(tw.load("go2"), gravity=np.array([0, 0, -g]))
    rng = np.random.default_rng(4)
    q, v, tau = model.random_configuration(rng=rng), rng.standard_normal(18), np.pad(rng.standard_normal(12), (6, 0))
    return tw.centroidal_momentum_rate(model, q, v, tw.aba(model, q, v, tau)) * mass / model.mass


def lipm(x, z, f_z, k_y_rate):
    """The horizontal force at the centre of pressure, with the moment k_y_rate about G; x: from there to G."""
    f_x = (x * f_z - k_y_rate) / z
    assert np.isclose(np.cross([-x, 0, -z], [f_x, 0, f_z])[1], k_y_rate)
    return f_x


def faster(times):
    """How much larger the rate of h_G is, without gravity, if q is passed so many times as fast."""
    model, rng = tw.load("go2"), np.random.default_rng(5)
    q, v, a = model.random_configuration(rng=rng), *rng.standard_normal((2, 18))
    slow, fast = (tw.centroidal_momentum_rate(model, q, f * v, f**2 * a)[:3] for f in (1, times))
    assert np.allclose(fast / slow, fast[0] / slow[0])
    return fast[0] / slow[0]


def satellite(of_base, of_wheel, relative):
    """The rate about z of a satellite whose wheel turns so fast against it, without angular momentum."""
    builder = tw.Builder("satellite", base="floating", root_inertia=body(1, [0, 0, 0], of_base * np.eye(3)))
    builder.link("wheel", parent="base_link", joint=tw.Revolute("z"), inertia=body(1, [0, 0, 0], of_wheel * np.eye(3)))
    k_z = tw.centroidal_map(builder.build(), [0, 0, 0, 0, 0, 0, 1, 0])[2]
    return -k_z[6] * relative / k_z[2]


def solved_digits(condition):
    rng = np.random.default_rng(6)
    turned = np.linalg.qr(rng.standard_normal((8, 8)))[0]
    M, exact = turned * np.geomspace(1, condition, 8) @ turned.T, np.ones(8)
    return -np.log10(np.abs(np.linalg.solve(M, M @ exact) - exact).max())


def names():
    """What the expressions may use."""
    helpers = {name: value for name, value in globals().items() if callable(value) and not name.startswith("test_")}
    corners = body(1, [0.5, 0, 0], np.zeros((3, 3))).matrix() + body(1, [-0.5, 0, 0], np.zeros((3, 3))).matrix()
    arrow = np.diag([5.0, 1, 1, 1, 1])
    arrow[0, 1:] = arrow[1:, 0] = 0.5
    bodies = {"go2": tw.load("go2"), "balls": balls(), "stone": free_body(np.eye(3)), "dumbbell": corners}
    numbers = {"np": np, "tw": tw, "pi": np.pi, "eye": np.eye(3), "arrow": arrow}
    return helpers | bodies | numbers | {"Rz": lambda degrees: turn("z", degrees)}


NAMES = names()


# ---------------------------------------------------------------- the questions


def test_every_section_has_ten_questions_and_every_answer_has_an_expression():
    assert len(SECTIONS) == 12
    assert {section: len(pencil_questions(section)) for section in SECTIONS} == dict.fromkeys(SECTIONS, 10)
    questions = list(ALL.values())
    assert not [question.text.en for question in questions if not question.by]
    assert sum(len(question.by) > 1 for question in questions) >= 50  # found in two ways
    assert len({question.text.en for question in questions}) == 120


def evaluated(question: PencilQuestion) -> list[str]:
    """What the expressions of a question say against its answer."""
    wrong = []
    for expression in question.by:
        found = eval(expression, dict(NAMES))
        if question.choices:
            wrong += [] if found is True or found is np.True_ else [f"{expression}: {found}"]
            continue
        numbers, found = np.array(question.numbers), np.ravel(np.asarray(found, dtype=float))
        near = np.maximum((question.rtol if question.rtol != NEAR else 1e-6) * np.abs(numbers), 1e-6)
        right = found.shape == numbers.shape and (np.abs(found - numbers) <= near).all()
        if question.fractions:
            right = right and np.allclose(found, [float(Fraction(number)) for number in question.fractions], rtol=1e-9)
        wrong += [] if right else [f"{expression}: {found}"]
    return wrong


def test_every_answer_is_what_the_package_computes():
    assert {name: wrong for name, question in ALL.items() if (wrong := evaluated(question))} == {}


@pytest.mark.parametrize(
    "change", [{"numbers": (0.0, 0.12, 0.13)}, {"numbers": (0.12,)}, {"fractions": ("0", "1/8", "3/25")}]
)
def test_a_wrong_answer_is_noticed(change):
    assert evaluated(dataclasses.replace(ALL["49.5-1"], **change))


def test_a_wrong_choice_is_noticed():
    assert evaluated(dataclasses.replace(ALL["49.5-6"], by=("1 + 1 == 3",)))


def test_both_languages_ask_with_the_same_numbers():
    """Small ones may be words in one of the languages: three, 两."""
    for name, question in ALL.items():
        assert bool(question.choices) != bool(question.numbers), name
        assert 0 <= question.right < max(1, len(question.choices)), name
        for text in (question.text, question.why, *question.choices):
            en, zh = (set(re.findall(r"\d+(?:\.\d+)?", side)) for side in text)
            assert all(text), name
            assert all(float(number) in range(1, 7) for number in en ^ zh), (name, en ^ zh)


def test_chinese_has_a_dot_in_a_product_of_units():
    units = {question.unit: question.unit_in("zh") for question in ALL.values()}
    assert (units["N m"], units["kg m²"], units["kg m/s, m/s"], units["m"]) == ("N·m", "kg·m²", "kg·m/s, m/s", "m")


# ---------------------------------------------------------------- sheets, and Moodle


def read_gift(text):
    """Read what `gift` writes, as Moodle does: title, question, and the answers with their marks, unescaped."""
    assert not re.search(r"\n\n\n", text)
    for entry in re.split(r"\n\n", text)[1:]:
        found = re.fullmatch(r"::([^:]+)::\[plain\]((?:\\.|[^\\{}~=#:])+)\{((?:\\.|[^\\{}])*)\}", entry)
        assert found, entry
        answers, _, feedback = re.split(r"(?<!\\)(####)", found[3])
        assert not re.search(r"(?<!\\)[~=#:]", feedback)
        if answers.startswith("#"):
            pieces = [("#", answers[1:])]
        else:
            pieces = re.findall(r"(?<!\\)([=~])((?:\\.|[^\\~=#:])*)", answers)
            assert "".join(mark + piece for mark, piece in pieces) == answers
        plain = [re.sub(r"\\(.)", r"\1", piece).strip() for piece in (found[2], *(piece for _, piece in pieces))]
        yield found[1], plain[0], list(zip([mark for mark, _ in pieces], plain[1:], strict=True))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_moodle_reads_every_question(language):
    for section in SECTIONS:
        entries = list(read_gift(gift(section, language)))
        assert [title for title, *_ in entries] == [f"{section}.{k}" for k in range(1, 11)]
        for (_, text, answers), question in zip(entries, pencil_questions(section), strict=True):
            assert text.startswith(question.text.of(language))
            if question.choices:
                assert [answer for _, answer in answers] == [choice.of(language) for choice in question.choices]
                assert [mark for mark, _ in answers].index("=") == question.right
                assert [mark for mark, _ in answers].count("=") == 1
            elif len(question.numbers) == 1:
                number, tolerance = map(float, answers[0][1].split(":"))
                assert number == question.numbers[0]
                assert 0 < tolerance <= 0.06 * abs(number)
            else:
                for _, answer in answers:
                    numbers = re.split(r", ?|， ?", answer.strip("()（）").replace("−", "-"))
                    assert [float(Fraction(number)) for number in numbers] == pytest.approx(question.numbers, abs=5e-4)


@pytest.mark.parametrize("language", ["en", "zh"])
def test_moodle_takes_several_numbers_as_any_keyboard_writes_them(language):
    found = {title: {answer for _, answer in answers} for title, _, answers in read_gift(gift("49.8", language))}
    for answer in (
        "0.667, -0.167, 0.333",
        "0.667,-0.167,0.333",
        "0.667，−0.167，0.333",
        "（2/3， -1/6， 1/3）",
        "(2/3,−1/6,1/3)",
    ):
        assert answer in found["49.8.1"]
    assert "0.667, 0.167, 0.333" not in found["49.8.1"]


@pytest.mark.parametrize(
    ("language", "order"), [("en", "(Of six numbers the angular ones"), ("zh", "（六个数中角分量在前")]
)
def test_moodle_says_in_which_order_six_numbers_stand(language, order):
    told = {title for section in SECTIONS for title, text, _ in read_gift(gift(section, language)) if order in text}
    six = {name.replace("-", ".") for name, question in ALL.items() if len(question.numbers) == 6}
    assert six | {"49.4.2", "49.5.7", "49.5.8"} <= told
    assert not told & {"49.5.1", "49.7.7", "49.11.4"}


def test_chinese_has_no_blank_between_sentences_for_moodle():
    assert not [section for section in SECTIONS if re.search(r"[。）] （", gift(section, "zh"))]


def test_what_gift_has_marks_for_is_escaped():
    awkward = "a = {b}: ~c # d \\ e"
    question = dataclasses.replace(ALL["49.5-6"], text=Text(awkward, awkward))
    text = f"// x\n\n::x::[plain]{pencil._escaped(question.text.en)} {{{pencil._expected(question, 'en')}}}"
    ((_, read, _),) = read_gift(text)
    assert read == awkward


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_sheet_asks_and_does_not_tell(language):
    asked, told = sheet("49.7", language), sheet("49.7", language, answers=True)
    for k, question in enumerate(pencil_questions("49.7"), start=1):
        assert f"\n{k}. " in asked
        assert f"\n{k}. **" in told
        assert plain(question.why.of(language)) not in asked
    assert COURSE.sections["49.7"].of(language) in asked


def test_the_command_prints_a_sheet_and_refuses_what_is_no_section():
    run = [sys.executable, "-m", "twistwrench", "exercises", "sheet"]
    printed = subprocess.run([*run, "49.5", "--language", "zh", "--answers"], capture_output=True, check=True)
    assert printed.stdout.decode().startswith("# 49.5 纸笔题：答案")
    refused = subprocess.run([*run, "50.1"], capture_output=True, check=False)
    assert refused.returncode
    assert b"49.1" in refused.stderr
    with pytest.raises(NameNotFound, match="section"):
        pencil_questions("project")
