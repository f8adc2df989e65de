"""Slips of a recursion, of counting and fitting, and of checking one's own work (49.11 and the project)."""

from ..text import Text
from .slip import Slip

__all__ = ["PIPELINE"]

PIPELINE = {
    "chain-for-tree": Slip(
        Text("the body before in the list is taken for the parent", "把列表中的前一个物体当成了父连杆"),
        Text("That holds for a chain. In a tree it is parent[i].", "那只对单链成立；树中父连杆是 parent[i]。"),
        "49.6",
    ),
    "acceleration-not-carried": Slip(
        Text("the parent's acceleration is not carried on", "没有传递父连杆的加速度"),
        Text(
            "A link accelerates with what carries it: A_i = X A_parent + ...", "连杆随父连杆一起加速：A_i = X A_父 + ……"
        ),
        "49.6",
    ),
    "own-acceleration-missing": Slip(
        Text("the joint's own acceleration S q̈ is missing", "漏了关节自身的加速度 S q̈"),
        Text("A_i = X A_parent + S q̈ + V × S q̇ has three terms.", "A_i = X A_父 + S q̈ + V × S q̇ 有三项。"),
        "49.6",
    ),
    "subtree-left-out": Slip(
        Text("a body's own inertia in place of that of its subtree", "用了单个连杆的惯量，而不是子树的复合惯量"),
        Text(
            "A joint moves everything beyond it: add X[i]ᵀ I^C X[i] to the parent first.",
            "关节带动它之后的全部连杆：要先把 X[i]ᵀ I^C X[i] 加到父连杆上。",
        ),
        "49.8",
    ),
    "off-diagonal-missing": Slip(
        Text("only the blocks on the diagonal are filled", "只填了对角块"),
        Text(
            "Joint i also feels the joints on its way to the base: walk there with F.",
            "关节 i 与通往基座路径上的关节都有耦合：要带着 F 沿路径向上走。",
        ),
        "49.8",
    ),
    "transforms-two": Slip(
        Text("two transforms per link, as the chapter has it", "每个连杆算了两次变换，与本章的说法相同"),
        Text(
            "The twist and the acceleration go outward, the wrench comes inward: three.",
            "twist 和加速度向外，wrench 向内：一共三次。",
        ),
        "49.11",
    ),
    "quadratic-always": Slip(
        Text("N(N − 1)/2 for a tree: that is a chain's", "对树也用了 N(N − 1)/2，那是单链的"),
        Text(
            "Each body walks up its own branch only: add up the depths.",
            "每个刚体只沿自己的分支向上走：把各自的深度相加。",
        ),
        "49.11",
    ),
    "world-counted": Slip(
        Text("the step to the world is counted as well", "把通往世界的一步也算了进去"),
        Text("The world has no joint, so no wrench need be carried into it.", "世界没有关节，不需要把力传到那里。"),
        "49.11",
    ),
    "world-as-body": Slip(
        Text("the world is counted as a body", "把世界也算作一个刚体"),
        Text(
            "parent[0] = −1 is the world's entry: there are len(parent) − 1 bodies.",
            "parent[0] = −1 是世界：刚体数是 len(parent) − 1。",
        ),
        "49.11",
    ),
    "longest-branch": Slip(
        Text("only the longest branch is counted", "只数了最长的一条分支"),
        Text("Every body walks to the base by itself: add up all depths.", "每个刚体都要走回基座：要把所有深度相加。"),
        "49.11",
    ),
    "two-points": Slip(
        Text("only the first and the last point are used", "只用了首尾两个点"),
        Text(
            "Two points lie on any curve. Fit all of them; the misfit then tells whether it is a power at all.",
            "任何曲线都能通过两点。应拟合全部数据，残差才能说明它是不是幂律。",
        ),
        "49.11",
    ),
    "fit-unlogged": Slip(
        Text("a line through the times, not through their logarithms", "直接对时间作直线拟合，没有取对数"),
        Text(
            "t = c Nᵏ is a line of slope k only on logarithmic axes.",
            "t = c Nᵏ 只有在双对数坐标下才是斜率为 k 的直线。",
        ),
        "49.11",
    ),
    "fit-half-logged": Slip(
        Text("only one of the two axes is logarithmic", "只有一个坐标取了对数"),
        Text("log t = k log N + c: both.", "log t = k log N + c：两个都要取对数。"),
        "49.11",
    ),
    "fit-through-origin": Slip(
        Text("the line is forced through the origin", "强制直线过原点"),
        Text(
            "The constant c in log t = k log N + c sets the unit of time: fit it as well.",
            "log t = k log N + c 中的常数 c 由时间单位决定，也要拟合。",
        ),
        "49.11",
    ),
    "fit-intercept": Slip(
        Text("the constant of the line in place of its slope", "给出的是截距，而不是斜率"),
        Text("np.polyfit returns the highest power first.", "np.polyfit 先返回最高次项的系数。"),
        "49.11",
    ),
    "fit-inverted": Slip(
        Text("N over t in place of t over N", "横纵坐标弄反：用 t 拟合了 N"),
        Text("Asked is how the time grows with N.", "要的是时间随 N 怎样增长。"),
        "49.11",
    ),
    "equal-shares": Slip(
        Text("every foot gets the same share of the weight", "每只脚平均分担了重力"),
        Text(
            "So it is only if the centre of mass is above the middle of the feet. The moments decide.",
            "只有质心恰在四脚中心上方时才如此；分配由力矩平衡决定。",
        ),
        "49.11",
    ),
    "limits-all": Slip(
        Text("all limits are replaced, also those that are finite", "把有限的限位也替换了"),
        Text("The joints' limits are the robot's own: keep them.", "关节限位是机器人自身的，应当保留。"),
        "49.11",
    ),
    "limits-position-only": Slip(
        Text("only the first three entries are looked at", "只处理了前三个分量"),
        Text(
            "Any entry may be infinite, as those of a second free-flyer: ask np.isfinite.",
            "任何分量都可能是无穷，例如第二个自由飞行关节：用 np.isfinite 判断。",
        ),
        "49.11",
    ),
    "kinds-mixed": Slip(
        Text("a twist and a wrench are added", "把 twist 和 wrench 相加了"),
        Text(
            "They are of different kinds, as metres and newtons are: refuse.", "两者种类不同，就像米和牛顿：应当拒绝。"
        ),
        "49.4",
    ),
    "pairing-of-equals": Slip(
        Text("the power of two things of one kind is taken", "对同一种量求了功率"),
        Text(
            "FᵀV needs a wrench and a twist. VᵀV mixes (rad/s)² with (m/s)², and means nothing.",
            "FᵀV 需要一个 wrench 和一个 twist；VᵀV 把 (rad/s)² 与 (m/s)² 相加，没有意义。",
        ),
        "49.4",
    ),
    "pairing-one-way": Slip(
        Text(
            "only one of wrench.power(twist) and twist.power(wrench) works",
            "wrench.power(twist) 与 twist.power(wrench) 只支持一种",
        ),
        Text(
            "The power is the same whoever is asked: FᵀV = VᵀF. Refuse only two of one kind.",
            "从谁算起功率都一样：FᵀV = VᵀF。只拒绝同一种类的两个量。",
        ),
        "49.4",
    ),
    "other-error": Slip(
        Text("another error than the TypeError that was asked for", "抛出的不是题目要求的 TypeError"),
        Text(
            "A value can be wrong (ValueError), or be of the wrong kind (TypeError): callers tell them apart.",
            "值不对是 ValueError，种类不对是 TypeError：调用者要区分二者。",
        ),
        "49.4",
    ),
    "difference-reversed": Slip(
        Text("b − a in place of a − b", "写成了 b − a，应为 a − b"),
        Text("a.__sub__(b) is a − b: `self` comes first.", "a.__sub__(b) 是 a − b：`self` 在前。"),
        "49.2",
    ),
    "kind-lost": Slip(
        Text("every sum is a twist", "所有的和都成了 twist"),
        Text(
            "The sum of two wrenches is a wrench: pass `self.kind` on.",
            "两个 wrench 之和仍是 wrench：要传递 `self.kind`。",
        ),
        "49.4",
    ),
    "half-angle": Slip(
        Text("it turns by half the angle", "只转了一半的角度"),
        Text(
            "A quaternion holds sin and cos of half the angle; products of two of its entries make the whole.",
            "四元数存的是半角的正弦和余弦；两个分量的乘积才给出整角。",
        ),
        "49.1",
    ),
    "twist-not-carried": Slip(
        Text("the parent's twist is not carried on", "没有传递父连杆的 twist"),
        Text(
            "A link moves with what carries it: V_i = X V_parent + S q̇.", "连杆随父连杆一起运动：V_i = X V_父 + S q̇。"
        ),
        "49.6",
    ),
    "visited-outward": Slip(
        Text(
            "the bodies are visited outward: a parent is used before its children have added to it",
            "由内向外遍历：子连杆还没加上来，父连杆就已被使用",
        ),
        Text(
            "Go from the last body to the first, and pass on the sum of what has come so far.",
            "应从最后一个物体到第一个，并把累加后的结果传下去。",
        ),
        "49.6",
    ),
    "joint-force-not-passed": Slip(
        Text(
            "U D⁻¹ u is not passed on: the parent does not feel what the joint does",
            "没有传递 U D⁻¹ u：父连杆感受不到关节的作用",
        ),
        Text("p_a = p_A + I_a c + U D⁻¹ u has three terms.", "p_a = p_A + I_a c + U D⁻¹ u 有三项。"),
        "49.7",
    ),
    "torques-missing": Slip(
        Text("Sᵀτ is left out: the motors do nothing", "漏了 Sᵀτ：电机没有作用"),
        Text(
            "M q̈ + h = Sᵀτ + J_cᵀλ: motors and contacts stand on the right.",
            "M q̈ + h = Sᵀτ + J_cᵀλ：右边有电机和接触两项。",
        ),
        "49.9",
    ),
    "moment-of-one-axis": Slip(
        Text("only the moment about one axis is balanced", "只平衡了绕一个轴的力矩"),
        Text(
            "Neither forward nor sideways may it tip over: one equation for x, one for y.",
            "前后和左右都不能翻倒：x、y 各一个方程。",
        ),
        "49.11",
    ),
    "assumed": Slip(
        Text("nothing is compared: the answer is always zero", "没有做任何比较：结果总是零"),
        Text("A check that cannot fail checks nothing.", "不可能失败的检验等于没有检验。"),
        "49.11",
    ),
    "not-per-call": Slip(
        Text("the time of all calls in place of one", "给出的是全部调用的总时间"),
        Text("Divide by their number, or time each by itself.", "要除以调用次数，或逐次计时。"),
        "49.11",
    ),
    "mean-after-warm-up": Slip(
        Text("the mean of the times, though the first call is left out", "虽然去掉了首次调用，但仍用了平均时间"),
        Text(
            "An interruption may come at any time. Take the median or the shortest.",
            "中断随时可能发生。应取中位数或最短时间。",
        ),
        "49.11",
    ),
    "error-signed": Slip(
        Text("the largest error is taken without its absolute value", "取最大误差时没有取绝对值"),
        Text("An error of −3 is smaller than 0 but not small.", "误差 −3 小于 0，但并不小。"),
        "49.11",
    ),
    "error-absolute": Slip(
        Text("the error is absolute, not relative", "给出的是绝对误差，而不是相对误差"),
        Text(
            "1e-9 N m is much for 1e-6 N m and nothing for 1e3: divide by the largest entry.",
            "1e-9 N m 相对 1e-6 N m 很大，相对 1e3 N m 可忽略：要除以最大分量。",
        ),
        "49.11",
    ),
    "error-averaged": Slip(
        Text("the mean of the errors in place of the largest", "取了平均误差，而不是最大误差"),
        Text("One wrong joint among many is lost in a mean.", "众多关节中只有一个出错时，平均值会把它掩盖。"),
        "49.11",
    ),
    "error-of-joints": Slip(
        Text("the six rows of the base are not compared", "没有比较基座的六行"),
        Text(
            "Most faults of a floating base show there: compare all nv rows.",
            "浮动基座的错误大多出现在那里：应比较全部 nv 行。",
        ),
        "49.11",
    ),
}
