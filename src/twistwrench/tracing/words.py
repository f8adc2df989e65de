"""What the stepper says: the formula of each step, the name of each term, and the labels, in English and Chinese.

In formulas and names i is the body whose turn it is, p its parent, j a body between i and the base, k the one outboard
of j; the stepper puts the bodies' numbers there.
"""

from __future__ import annotations

from typing import Any

__all__ = ["FORMULAS", "PARTS", "TERMS", "WORDS"]

FORMULAS = {
    "49.3 T": "T_{0,i} = T_{0,p} T_{p,i}",
    "49.2 V": "V_i = X_i V_p + S_i q̇_i",
    "49.2 A": "A_i = X_i A_p + S_i q̈_i + V_i × S_i q̇_i",
    "49.6 A0": "A_i = (0, −g)",
    "49.6 V": "V_i = X_i V_p + S_i q̇_i",
    "49.6 A": "A_i = X_i A_p + S_i q̈_i + V_i × S_i q̇_i",
    "49.6 F": "F_i = I_i A_i + V_i ×^* I_i V_i − f^{ext}_i",
    "49.6 tau": "τ_i = S_i^T F_i + I_{rotor} q̈_i",
    "49.6 F_p": "F_p ← F_p + X_i^T F_i",
    "49.7 V": "V_i = X_i V_p + S_i q̇_i",
    "49.7 c": "c_i = V_i × S_i q̇_i",
    "49.7 pA": "p^A_i = V_i ×^* I_i V_i − f^{ext}_i",
    "49.7 U": "U_i = I^A_i S_i",
    "49.7 D": "D_i = S_i^T U_i + I_{rotor}",
    "49.7 D_inv": "D_i^{−1} = (S_i^T U_i + I_{rotor})^{−1}",
    "49.7 u": "u_i = τ_i − S_i^T p^A_i",
    "49.7 Ia": "I^a_i = I^A_i − U_i D_i^{−1} U_i^T",
    "49.7 pa": "p^a_i = p^A_i + I^a_i c_i + U_i D_i^{−1} u_i",
    "49.7 IA_p": "I^A_p ← I^A_p + X_i^T I^a_i X_i",
    "49.7 pA_p": "p^A_p ← p^A_p + X_i^T p^a_i",
    "49.7 A0": "A_i = (0, −g)",
    "49.7 qdd": "q̈_i = D_i^{−1} (u_i − U_i^T (X_i A_p + c_i))",
    "49.7 A": "A_i = X_i A_p + c_i + S_i q̈_i",
    "49.8 IC_p": "I^C_p ← I^C_p + X_i^T I^C_i X_i",
    "49.8 F": "F_{i,i} = I^C_i S_i",
    "49.8 M_ii": "M_{i,i} = S_i^T F_{i,i} + I_{rotor}",
    "49.8 F_j": "F_{j,i} = X_k^T F_{k,i}",
    "49.8 M_ji": "M_{j,i} = S_j^T F_{j,i}",
    "49.8 M_ij": "M_{i,j} = M_{j,i}^T",
    "49.10 X": "X^{*}_{G,i} = [R_i, [p_i − p_G]_× R_i; 0, R_i]",
    "49.5 IC": "I^C_p ← I^C_p + X_i^T I^C_i X_i",
    "49.10 A_G": "A_{G,i} = X^{*}_{G,i} I^C_i S_i",
}

PARTS = {
    "V": ("ω", "v"),
    "A": ("α", "a"),
    "c": ("α", "a"),
    "F": ("τ", "f"),
    "pA": ("τ", "f"),
    "pa": ("τ", "f"),
    "U": ("τ", "f"),
    "A_G": ("k", "l"),
    "tau": ("τ", "f"),
    "u": ("τ", "f"),
    "qdd": ("α", "a"),
}
"""The letters of the angular and of the linear part."""

TERMS: dict[Any, dict[str, str]] = {
    "T": {"en": "placement of body i in the world, a 4 x 4 matrix", "zh": "刚体 i 在世界中的位姿，4 × 4 矩阵"},
    ("A", "forward_kinematics"): {
        "en": "spatial acceleration of body i, without gravity, in frame i",
        "zh": "刚体 i 的空间加速度（不含重力），用坐标系 i 表示",
    },
    "V": {"en": "twist of body i, in frame i", "zh": "刚体 i 的 twist，用坐标系 i 表示"},
    "A": {
        "en": "acceleration of body i, gravity in it, in frame i",
        "zh": "刚体 i 的加速度（含重力），用坐标系 i 表示",
    },
    "c": {"en": "what the velocities add to the acceleration of body i", "zh": "速度给刚体 i 的加速度加上的部分"},
    "F": {"en": "wrench that the joints transmit to the body, so far", "zh": "到此为止，关节传给刚体的 wrench"},
    "tau": {"en": "force of joint i", "zh": "关节 i 的力"},
    "pA": {
        "en": "bias wrench, so far: what is needed without acceleration",
        "zh": "到此为止的偏置 wrench：没有加速度时所需",
    },
    "pa": {"en": "bias wrench as the parent of body i meets it", "zh": "刚体 i 的父连杆所遇到的偏置 wrench"},
    "U": {"en": "wrench for a unit acceleration of joint i", "zh": "关节 i 产生单位加速度所需的 wrench"},
    "D": {"en": "apparent inertia at joint i", "zh": "关节 i 处的表观惯量"},
    "D_inv": {"en": "inverse of the apparent inertia at joint i", "zh": "关节 i 处表观惯量的逆"},
    "u": {"en": "what is left of the force of joint i", "zh": "关节 i 的力扣除偏置之后的剩余"},
    "Ia": {
        "en": "inertia as the parent of body i meets it, joint i free",
        "zh": "关节 i 可自由运动时，父连杆所遇到的惯量",
    },
    "IA": {"en": "articulated inertia of body p, so far", "zh": "到此为止，刚体 p 的铰接体惯量"},
    "qdd": {"en": "acceleration of joint i", "zh": "关节 i 的加速度"},
    "IC": {"en": "composite inertia of body p, so far", "zh": "到此为止，刚体 p 的复合刚体惯量"},
    ("F", "crba"): {
        "en": "wrench for a unit acceleration of joint i, in frame j",
        "zh": "关节 i 单位加速度所需的 wrench，用坐标系 j 表示",
    },
    "M": {"en": "entry of the mass matrix, joints i and j", "zh": "质量矩阵中关节 i 与 j 的元素"},
    "X": {"en": "takes a momentum of body i to the centre of mass", "zh": "把刚体 i 的动量变到质心"},
    "A_G": {
        "en": "momentum at the centre of mass for a unit velocity of joint i",
        "zh": "关节 i 单位速度时质心处的动量",
    },
}

WORDS = {
    "en": {
        "lang": "en",
        "stepper": "Line by line",
        "case": "Robot and posture",
        "step": "Step",
        "of": "of",
        "previous": "Previous step",
        "next": "Next step",
        "code": "The source",
        "tree": "The tree of bodies",
        "formula": "The formula",
        "line": "The line of code",
        "arrow": "The arrows on the robot",
        "numbers": "The numbers",
        "play": "Play",
        "pause": "Pause",
        "picture": "The robot; the body whose turn it is in orange, the frame of the numbers with its axes",
        "view": "Turn the picture",
        "angular": "angular",
        "linear": "linear",
        "unit": "unit",
        "keys": "← and → go through the lines, Home and End to the ends, space plays and pauses; choose a body to go "
        "to its next line.",
    },
    "zh": {
        "lang": "zh-CN",
        "stepper": "逐行查看",
        "case": "机器人与姿态",
        "step": "步骤",
        "of": "/",
        "previous": "上一步",
        "next": "下一步",
        "code": "源码",
        "tree": "刚体树",
        "formula": "公式",
        "line": "代码行",
        "arrow": "机器人上的箭头",
        "numbers": "数值",
        "play": "播放",
        "pause": "暂停",
        "picture": "机器人；橙色是当前刚体，画出坐标轴的是数值所用的坐标系",
        "view": "转动图形",
        "angular": "角",
        "linear": "线",
        "unit": "单位",
        "keys": "用 ← 与 → 逐行移动，Home 与 End 到两端，空格键播放或暂停；点选刚体则跳到它的下一行。",
    },
}
