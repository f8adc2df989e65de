"""Quantities with a name that may be computed in place of the one that is asked for, by the names of the arguments."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import twistwrench as tw

from ..robots import weightless
from ..words.text import Text

__all__ = ["KNOWN", "Known"]


class Known(NamedTuple):
    """A quantity: what it is called, and how it is computed from arguments of these names."""

    title: Text
    value: Callable[..., Any]
    needs: tuple[str, ...]


def _base(model: Any, q: Any) -> Any:
    """Return where the base's origin is."""
    return tw.forward_kinematics(model, q).placement[1].translation


def _at_base(model: Any, q: Any, forces: Any) -> Any:
    """Return what the contact forces do to the base: J_cbᵀ λ."""
    return tw.contact_jacobian(model, q, model.feet).mT[:6] @ np.ravel(forces)


def _about(model: Any, q: Any, forces: Any, point: Any) -> Any:
    """Return the wrench of contact forces and weight about a point, in the world's axes."""
    feet = np.array([tw.frame_placement(model, q, foot).translation for foot in model.feet]) - point
    weight = model.mass * model.gravity
    lever = tw.center_of_mass(model, q) - point
    return np.concatenate([np.cross(feet, forces).sum(0) + np.cross(lever, weight), np.sum(forces, 0) + weight])


def _moved(model: Any, q: Any, point: Any) -> Any:
    """Return the map of momentum about another point."""
    return tw.force_transform(np.eye(3), tw.center_of_mass(model, q) - point) @ tw.centroidal_map(model, q)


def _placement(R: Any, p: Any) -> Any:
    T = np.eye(4)
    T[:3, :3], T[:3, 3] = R, p
    return T


def _inertia(m: Any, c: Any, I_c: Any) -> Any:
    cx = tw.skew(c)
    return np.block([[I_c - m * cx @ cx, m * cx], [-m * cx, m * np.eye(3)]])


def _twice(m: Any, c: Any, I_c: Any) -> Any:
    return _inertia(m, c, I_c - m * tw.skew(c) @ tw.skew(c))


def _turned(I: Any, R: Any, p: Any) -> Any:
    X = tw.motion_transform(R, p)
    return np.linalg.inv(X).mT @ I @ np.linalg.inv(X)


def _of_base(model: Any) -> Any:
    body = model.inertia[1]
    inertia = body.matrix()[:3, :3]
    return body.mass, body.com, inertia + body.mass * tw.skew(body.com) @ tw.skew(body.com)


def _tree_rnea(*given: Any) -> Any:
    from ..catalogue import find_part

    return find_part("tree_rnea")[1].solution(*given)


def _tree_aba(*given: Any) -> Any:
    from ..catalogue import find_part

    return find_part("tree_aba")[1].solution(*given)


KNOWN = tuple(
    Known(Text(english, chinese), value, tuple(inspect.signature(value).parameters))
    for english, chinese, value in (
        (
            "what inverse dynamics (RNEA) gives",
            "逆动力学（RNEA）的结果",
            lambda model, q, v, a: tw.rnea(model, q, v, a),
        ),
        (
            "what inverse dynamics (RNEA) gives, with `tau` in the place of the accelerations",
            "逆动力学（RNEA）的结果，其中 `tau` 占了加速度的位置",
            lambda model, q, v, tau: tw.rnea(model, q, v, tau),
        ),
        (
            "what inverse dynamics (RNEA) gives without gravity",
            "不计重力的逆动力学（RNEA）的结果",
            lambda model, q, v, a: tw.rnea(weightless(model), q, v, a),
        ),
        (
            "what inverse dynamics (RNEA) gives without gravity, with `tau` in the place of the accelerations",
            "不计重力的逆动力学（RNEA）的结果，其中 `tau` 占了加速度的位置",
            lambda model, q, v, tau: tw.rnea(weightless(model), q, v, tau),
        ),
        (
            "what forward dynamics (ABA) gives",
            "正向动力学（ABA）的结果",
            lambda model, q, v, tau: tw.aba(model, q, v, tau),
        ),
        (
            "what forward dynamics (ABA) gives, with `a` in the place of the joint forces",
            "正向动力学（ABA）的结果，其中 `a` 占了关节力的位置",
            lambda model, q, v, a: tw.aba(model, q, v, a),
        ),
        (
            "what forward dynamics (ABA) gives without gravity",
            "不计重力的正向动力学（ABA）的结果",
            lambda model, q, v, tau: tw.aba(weightless(model), q, v, tau),
        ),
        ("gravity alone, g(q)", "单独的重力项 g(q)", lambda model, q: tw.gravity(model, q)),
        (
            "h, the forces of velocity and gravity, without M a",
            "h（速度项与重力项），不含 M a",
            lambda model, q, v: tw.nonlinear_effects(model, q, v),
        ),
        (
            "the forces of velocity alone, without gravity and without M a",
            "单独的速度项，不含重力和 M a",
            lambda model, q, v: tw.nonlinear_effects(model, q, v) - tw.gravity(model, q),
        ),
        ("M a alone, without h", "单独的 M a，不含 h", lambda model, q, a: tw.crba(model, q) @ a),
        ("M v, with the velocities", "M v（乘的是速度）", lambda model, q, v: tw.crba(model, q) @ v),
        ("M τ", "M τ", lambda model, q, tau: tw.crba(model, q) @ tau),
        (
            "M⁻¹ τ, without h",
            "M⁻¹ τ，不含 h",
            lambda model, q, tau: tw.solve_mass_matrix(model, q, tau),
        ),
        ("the mass matrix M", "质量矩阵 M", lambda model, q: tw.crba(model, q)),
        (
            "the base's rows of M (the momentum about the base's origin, in its axes)",
            "M 的基座各行（关于基座原点、在基座坐标系中的动量）",
            lambda model, q: tw.crba(model, q)[:6],
        ),
        (
            "the base's block of M (the whole robot's inertia about the base's origin, in its axes)",
            "M 的基座块（整个机器人关于基座原点、在基座坐标系中的惯量）",
            lambda model, q: tw.crba(model, q)[:6, :6],
        ),
        (
            "the centroidal map A_G (the momentum about the centre of mass, in the world's axes)",
            "质心动量映射 A_G（关于质心、在世界坐标系中的动量）",
            lambda model, q: tw.centroidal_map(model, q),
        ),
        (
            "the map of the momentum about the world's origin, in its axes",
            "关于世界原点、在世界坐标系中的动量映射",
            lambda model, q: _moved(model, q, np.zeros(3)),
        ),
        (
            "the map of the momentum about the base's origin, in the world's axes",
            "关于基座原点、在世界坐标系中的动量映射",
            lambda model, q: _moved(model, q, _base(model, q)),
        ),
        (
            "the centroidal inertia of the whole robot",
            "整个机器人关于质心的惯量",
            lambda model, q: tw.centroidal_inertia(model, q),
        ),
        (
            "the centroidal momentum h_G = A_G v",
            "质心动量 h_G = A_G v",
            lambda model, q, v: tw.centroidal_momentum(model, q, v),
        ),
        (
            "A_G a alone, without the rate of A_G times v",
            "单独的 A_G a，不含 A_G 的变化率乘 v",
            lambda model, q, a: tw.centroidal_map(model, q) @ a,
        ),
        (
            "the rate of the momentum about the centre of mass, in the world's axes",
            "关于质心、在世界坐标系中的动量变化率",
            lambda model, q, v, a: tw.centroidal_momentum_rate(model, q, v, a),
        ),
        (
            "the base's rows of RNEA (a wrench about the base's origin, in its axes)",
            "RNEA 的基座各行（关于基座原点、在基座坐标系中的 wrench）",
            lambda model, q, v, a: tw.rnea(model, q, v, a)[:6],
        ),
        (
            "the position of the centre of mass, in the world",
            "质心在世界坐标系中的位置",
            lambda model, q: tw.center_of_mass(model, q),
        ),
        (
            "the velocity of the centre of mass",
            "质心的速度",
            lambda model, q, v: tw.center_of_mass_velocity(model, q, v),
        ),
        ("the kinetic energy", "动能", lambda model, q, v: tw.kinetic_energy(model, q, v)),
        (
            "the base's rows of J_cᵀ λ − g (the wrench of contacts and weight about the base's origin, in its axes)",
            "J_cᵀ λ − g 的基座各行（接触力与重力关于基座原点、在基座坐标系中的 wrench）",
            lambda model, q, forces: _at_base(model, q, forces) - tw.gravity(model, q)[:6],
        ),
        (
            "the base's rows of J_cᵀ λ (the wrench of the contacts about the base's origin, without weight)",
            "J_cᵀ λ 的基座各行（接触力关于基座原点、在基座坐标系中的 wrench，不含重力）",
            lambda model, q, forces: _at_base(model, q, forces),
        ),
        (
            "the wrench of contacts and weight about the world's origin",
            "接触力与重力关于世界原点的 wrench",
            lambda model, q, forces: _about(model, q, forces, np.zeros(3)),
        ),
        (
            "the wrench of contacts and weight about the base's origin, in the world's axes",
            "接触力与重力关于基座原点、在世界坐标系中的 wrench",
            lambda model, q, forces: _about(model, q, forces, _base(model, q)),
        ),
        ("the 4 × 4 matrix of the placement", "位姿的 4 × 4 矩阵", lambda R, p: _placement(R, p)),
        ("the 4 × 4 matrix of the rotation", "旋转的 4 × 4 矩阵", lambda R: _placement(R, np.zeros(3))),
        ("the 6 × 6 transform of twists", "twist 的 6 × 6 变换", lambda R, p: tw.motion_transform(R, p)),
        ("the 6 × 6 transform of wrenches", "wrench 的 6 × 6 变换", lambda R, p: tw.force_transform(R, p)),
        ("the inertia about the body's origin", "关于刚体原点的惯量", lambda m, c, I_c: _inertia(m, c, I_c)),
        (
            "the inertia only turned by R, and not moved by p",
            "只作了 R 的旋转而没有作 p 的平移的惯量",
            lambda I, R, p: _turned(I, R, np.zeros(3)),
        ),
        (
            "the inertia only moved by p, and not turned by R",
            "只作了 p 的平移而没有作 R 的旋转的惯量",
            lambda I, R, p: _turned(I, np.eye(3), p),
        ),
        (
            "the inertia about the centre of mass",
            "关于质心的惯量",
            lambda m, c, I_c: _inertia(m, 0 * c, I_c),
        ),
        (
            "the inertia with the parallel-axis term counted twice",
            "平行轴项加了两次的惯量",
            lambda m, c, I_c: _twice(m, c, I_c),
        ),
        (
            "the base's inertia about its centre of mass",
            "基座关于其质心的惯量",
            lambda model: _inertia(_of_base(model)[0], np.zeros(3), _of_base(model)[2]),
        ),
        (
            "the base's inertia with the parallel-axis term counted twice:"
            " the moments of inertia about the origin stand where those about the centre of mass are asked for",
            "平行轴项加了两次的基座惯量：该用关于质心的转动惯量处，用了关于原点的转动惯量",
            lambda model: _twice(*_of_base(model)),
        ),
        (
            "what inverse dynamics (RNEA) gives, with `tau` in the place of the accelerations",
            "逆动力学（RNEA）的结果，其中 `tau` 占了加速度的位置",
            lambda parent, S, I, X, qd, tau, a0: _tree_rnea(parent, S, I, X, qd, tau, a0),
        ),
        (
            "what forward dynamics (ABA) gives, with `qdd` in the place of the joint forces",
            "正向动力学（ABA）的结果，其中 `qdd` 占了关节力的位置",
            lambda parent, S, I, X, qd, qdd, a0: _tree_aba(parent, S, I, X, qd, qdd, a0),
        ),
    )
)
"""The plainest first: of several with the same numbers the first is named."""
