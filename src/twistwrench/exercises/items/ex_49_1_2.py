"""Exercise 49.1.2: an arm that touches something."""

from typing import Any

import numpy as np

from ..exercise import Exercise, Part, Property, Quantity
from ..text import Text

__all__ = ["EXERCISE", "polishing_torques"]


def polishing_torques(M: Any, h: Any, J: Any, a: Any, force: Any) -> Any:
    """Joint torques of an arm whose tip is pushed."""
    return M @ a + h - J.mT @ force


def _cases(rng: Any) -> Any:
    def one() -> Any:
        half = rng.standard_normal((3, 3))
        return half @ half.mT + np.eye(3), *rng.standard_normal((1, 3)), rng.standard_normal((3, 3))

    return [(*one(), *rng.standard_normal((2, 3))) for _ in range(5)]


EXERCISE = Exercise(
    id="49.1.2",
    kind="explain",
    title=Text("An arm that polishes", "打磨任务中的机械臂"),
    text=Text(
        """Why has the equation of motion of a robot on a fixed base no term J_cᵀ λ? And if its tip does touch
        something, as in polishing, how does the equation change? Compute the joint torques for that case.""",
        """为什么固定基座机器人的动力学方程中没有 J_cᵀ λ 项？如果末端确实与环境接触（如打磨），方程应怎样修改？
        计算这种情况下的关节力矩。""",
    ),
    parts=(
        Part(
            solution=polishing_torques,
            doc=Text(
                """Return the joint torques of a fixed-base arm with three joints whose tip touches something.

                M: array (3, 3), the mass matrix. h: array (3,), N m, Coriolis, centrifugal and gravity terms.
                J: array (3, 3), m, takes joint velocities to the velocity of the tip. a: array (3,), rad/s².
                force: array (3,), N, what the surroundings exert on the tip.
                Returns: array (3,), N m.""",
                """返回三关节固定基座机械臂在末端接触时的关节力矩。

                M：数组 (3, 3)，质量矩阵。h：数组 (3,)，N m，科里奥利、离心与重力项。
                J：数组 (3, 3)，m，把关节速度变为末端速度。a：数组 (3,)，rad/s²。
                force：数组 (3,)，N，环境对末端的力。
                返回：数组 (3,)，N m。""",
            ),
            returns=(Quantity("τ", unit="N m"),),
            cases=_cases,
            slips={
                "contact-missing": lambda M, h, J, a, force: M @ a + h,
                "external-sign": lambda M, h, J, a, force: M @ a + h + J.mT @ force,
                "jacobian-untransposed": lambda M, h, J, a, force: M @ a + h - J @ force,
                "bias-for-zero": lambda M, h, J, a, force: M @ a - J.mT @ force,
                "bias-sign": lambda M, h, J, a, force: M @ a - h - J.mT @ force,
            },
            properties=(
                Property(
                    Text(
                        "with these torques the joints accelerate by a: a = M⁻¹ (τ − h + Jᵀ f)",
                        "用这些力矩得到的加速度就是 a：a = M⁻¹ (τ − h + Jᵀ f)",
                    ),
                    lambda answer, M, h, J, a, force: np.linalg.solve(M, answer - h + J.mT @ force) - a,
                ),
            ),
        ),
    ),
    hints=(
        Text(
            "A force on the tip does work f·J q̇. Which joint torques would do the same work?",
            "末端的力做功 f·J q̇。怎样的关节力矩做同样的功？",
        ),
        Text(
            "M q̈ + h = τ + Jᵀ f. Solve for τ, and mind the side on which Jᵀ f stands.",
            "M q̈ + h = τ + Jᵀ f。解出 τ，注意 Jᵀ f 在等号哪一边。",
        ),
    ),
    answer=Text(
        """What holds the base of such an arm is not an unknown of the equation: the base does not move, so its six
        equations are left out, and with them the forces in its bolts. The joint equations M q̈ + C q̇ + g = τ are then
        complete as long as nothing else touches the arm. The term is missing because of that, and not because the
        base is fixed. Where the tip touches something, its force enters as on a walking robot:
        M q̈ + C q̇ + g = τ + J_cᵀ λ, and λ is either measured or follows from the condition that the contact gives,
        J_c q̈ + J̇_c q̇ = 0.""",
        """固定基座的约束力不是方程的未知量：基座不动，它的六个方程连同螺栓中的力都被消去了。只要没有其他接触，
        关节方程 M q̈ + C q̇ + g = τ 就是完整的。没有 J_cᵀ λ 是因为没有接触，而不是因为基座固定。末端一旦接触环境，
        接触力就和足式机器人一样出现：M q̈ + C q̇ + g = τ + J_cᵀ λ；λ 或由测量得到，或由接触约束 J_c q̈ + J̇_c q̇ = 0 求
        出。""",
    ),
)
