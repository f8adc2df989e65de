"""Scenes that a practitioner would try first: which of them can be written, and their errors against another engine.

usage:  python benchmarks/scene_trials.py              all of them, half a minute; and the tables of docs/scenes*.md
        python benchmarks/scene_trials.py --tables     only the tables, from results/scene_trials.json

Needs Pinocchio and SciPy. What needs MuJoCo is left as it was in the results where MuJoCo is not installed.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from tables import table, write_each

HERE = Path(__file__).parent
RESULTS = HERE / "results" / "scene_trials.json"
PAGES = {language: HERE.parent / "docs" / f"scenes{language}.md" for language in ("", ".zh-CN")}
ENGINES = {
    "pinocchio": ("Pinocchio", "Pinocchio"),
    "dop853": ("Pinocchio's ABA, by SciPy's DOP853", "Pinocchio 的 ABA，用 SciPy 的 DOP853 积分"),
    "lp": ("linear programmes, by HiGHS", "线性规划，用 HiGHS"),
    "mujoco": ("MuJoCo, whose contacts are soft", "MuJoCo，它的接触是软的"),
    "closed": ("closed form", "闭式解"),
    "plan": ("its plan", "计划"),
    "kept": ("conservation", "守恒"),
}


class Trial(NamedTuple):
    """A scene, in both languages; how it is written; what it is compared with; the function that returns its error."""

    english: str
    chinese: str
    said: str
    engine: str
    function: str
    unit: str = ""


TRIALS = [
    Trial("Panda holds a box of 1.5 kg: τ", "Panda 拿着 1.5 kg 的箱子：τ", "payload=", "pinocchio", "panda_with_a_box"),
    Trial(
        "Talos on one foot, waving: τ", "Talos 单脚站立并挥手：τ", "SurfaceContact", "pinocchio", "talos_on_one_foot"
    ),
    Trial("Go2 trots in place: ḣ_G", "Go2 原地小跑：ḣ_G", "motions.trot(speed=0)", "pinocchio", "go2_trots_in_place"),
    Trial(
        "Go2 with a broken leg, on three feet: q̈",
        "断了一条腿的 Go2 三脚站立：q̈",
        "hold=",
        "pinocchio",
        "go2_with_a_broken_leg",
    ),
    Trial(
        "humanoid that leans on a wall: least friction",
        "人形机器人扶墙：最小摩擦",
        "normal=",
        "lp",
        "humanoid_at_a_wall",
    ),
    Trial("a drone with a load below it: q̈", "下挂重物的无人机：q̈", "attach", "pinocchio", "iris_with_a_load"),
    Trial("Tiago on a planar base: M", "平面基座上的 Tiago：M", 'base="planar"', "pinocchio", "tiago_on_the_floor"),
    Trial("a box slides until it stops: distance", "箱子滑行直到停下：距离", "ground=", "closed", "box_slides"),
    Trial("a satellite with an arm, 2 s: q", "带机械臂的卫星，2 s：q", "gravity=[0, 0, 0]", "dop853", "satellite"),
    Trial("a double pendulum, 2 s: q", "双摆，2 s：q", "simulate", "dop853", "double_pendulum"),
    Trial("an elevator: forces of the feet", "电梯：足端力", "acceleration=", "closed", "elevator"),
    Trial("a biped on two lines: q̈", "双足机器人踩在两条线上：q̈", "PointContact", "pinocchio", "biped_on_two_lines"),
    Trial("Cassie: closed loops in SDF", "Cassie：SDF 里的闭环", "", "", ""),
    Trial(
        "a box in both hands: q̈ of both", "双手抱箱：两者的 q̈", "attach, LoopClosure", "pinocchio", "box_in_both_hands"
    ),
    Trial("Go2 lands on four feet: v", "Go2 四脚落地：v", "ground=", "pinocchio", "go2_lands"),
    Trial(
        "Go2 crawls one stride on the ground",
        "Go2 在地面上爬行一步",
        "Scene.phases, ground=",
        "plan",
        "go2_crawls",
        "mm",
    ),
    Trial(
        "Go2 drops and stands: force on the feet",
        "Go2 落下并站住：足端受力",
        "ground=",
        "closed",
        "go2_drops_and_stands",
    ),
    Trial(
        "a bead on a rail reaches the floor: time",
        "导轨上的珠子到达地面：时刻",
        "SlidingContact, ground=",
        "closed",
        "rail_and_ground",
    ),
    Trial("two robots hold each other: momentum", "两台机器人互相抓住：动量", "attach(…, None)", "kept", "two_robots"),
    Trial("set down on a belt: v, energy", "放到传送带上：v、能量", "velocity=", "closed", "belt"),
    Trial("a four-bar: q̈", "四连杆：q̈", "LoopClosure", "closed", "four_bar"),
    Trial("a finger that mimics another: q̈", "跟随另一手指的手指：q̈", "Coupling", "pinocchio", "mimic"),
    Trial("a ball rolls down a slope: v", "球滚下斜坡：v", "SphereContact", "closed", "ball_rolls"),
    Trial("a ball bounces: its height", "球弹起：高度", "Ground(restitution=)", "closed", "ball_bounces"),
    Trial(
        "a box on a slope topples: angle of the slope", "斜坡上的箱子翻倒：坡度", "ground=", "closed", "box_on_a_slope"
    ),
    Trial("a box is thrown: place of rest", "抛出的箱子：停下的位置", "ground=", "mujoco", "box_is_thrown"),
    Trial(
        "a stiff humanoid is pushed: speed at which it tips",
        "被推的刚性人形机器人：使它翻倒的速度",
        "lock_joints, ground=",
        "closed",
        "humanoid_is_pushed",
    ),
]


def function(trial: Trial) -> Callable[[], float]:
    """Return what makes a trial."""
    import scenes_at_once
    import scenes_in_time

    return getattr(scenes_at_once, trial.function, None) or getattr(scenes_in_time, trial.function)


def results() -> dict[str, float]:
    """Return how far each trial was off in the last run."""
    found: dict[str, float] = json.loads(RESULTS.read_text(encoding="utf-8"))
    return found


def measured(before: dict[str, float]) -> Iterator[tuple[str, float]]:
    """Make all trials, and return how far each is off."""
    for trial in TRIALS:
        if not trial.function:
            continue
        try:
            error = float(f"{function(trial)():.2g}")
        except ImportError as missing:
            if trial.engine != "mujoco" or trial.function not in before:
                raise
            print(f"{missing}: as before")
            error = before[trial.function]
        print(f"{trial.english:50} {error:.1e} {trial.unit}", flush=True)
        yield trial.function, error


def tables(language: str) -> dict[str, str]:
    """Return the table of a page."""
    return {"trials": table(_cells(language))}


def _cells(language: str) -> Iterator[tuple[str, str, str]]:
    chinese = language != ""
    found = results()
    said, beside, error = ("写法", "对照", "误差") if chinese else ("in code", "compared with", "error")
    for trial in TRIALS:
        scene = trial.chinese if chinese else trial.english
        if not trial.function:
            yield scene, said, "不能：不读 SDF" if chinese else "not possible: SDF is not read"
            continue
        x = found[trial.function]
        yield scene, said, f"`{trial.said}`"
        yield scene, beside, ENGINES[trial.engine][chinese]
        yield scene, error, f"{x:.1f} {trial.unit}" if trial.unit else f"{x:.0e}"


def main() -> None:
    """Run what is asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tables", action="store_true", help="only the tables, from results/")
    if not parser.parse_args().tables:
        found = dict(measured(results() if RESULTS.exists() else {}))
        RESULTS.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    write_each(PAGES, tables)


if __name__ == "__main__":
    main()
