"""Sentences of a change that makes a student's function right."""

from .text import Text

__all__ = ["MENDINGS"]

MENDINGS = {
    # what would make the student's own line right
    "repair sign": Text("change the sign of `{wrong}`", "改变 `{wrong}` 的符号"),
    "repair left out": Text("take out `{wrong}`", "去掉 `{wrong}`"),
    "repair zeroed": Text("put zero in place of `{wrong}`", "用零代替 `{wrong}`"),
    "repair after loop": Text("put `{wrong}` after the loop, not in it", "把 `{wrong}` 放在循环之后，而不是循环内"),
    "repair in loop": Text(
        "make `{wrong}` anew in each round, at the beginning of the loop", "每一轮都在循环开头重新执行 `{wrong}`"
    ),
    "repair summed": Text(
        "add `{wrong}` up: += in place of =, from zero before the loop",
        "累加 `{wrong}`：用 += 而不是 =，循环前从零开始",
    ),
    "repair carried": Text(
        "let `{wrong}` carry on what the round before has computed: it starts from the same `{right}` in each round",
        "让 `{wrong}` 接着用上一轮算出的结果：它每一轮都从同一个 `{right}` 开始",
    ),
    "repair last": Text("do not add up `{wrong}`", "不要对 `{wrong}` 求和"),
    "repair transposed": Text("change `{wrong}` to `{right}`", "把 `{wrong}` 改为 `{right}`"),
    "repair exchanged": Text("change `{wrong}` to `{right}`", "把 `{wrong}` 改为 `{right}`"),
    "repair halves": Text("exchange `{wrong}` and `{right}`", "互换 `{wrong}` 与 `{right}`"),
    "repair name": Text("change `{wrong}` to `{right}`", "把 `{wrong}` 改为 `{right}`"),
    "repair instead": Text("change `{wrong}` to `{right}`", "把 `{wrong}` 改为 `{right}`"),
    "repair inserted": Text("change `{wrong}` to `{right}`", "把 `{wrong}` 改为 `{right}`"),
    "repair index": Text("change `{wrong}` to `{right}`", "把 `{wrong}` 改为 `{right}`"),
    "repair number": Text("change `{wrong}` to `{right}`", "把 `{wrong}` 改为 `{right}`"),
    "must be zero": Text("set `{name}` to zero in `{around}`", "令 `{around}` 中的 `{name}` 为零"),
    "repair missing": Text("add `{right}` after `{wrong}`", "在 `{wrong}` 之后加上 `{right}`"),
    "repair argument": Text("use `{right}` in place of the argument `{wrong}`", "用 `{right}` 代替参数 `{wrong}`"),
    "repair result": Text("return `{right}` where `{wrong}` is returned", "在返回 `{wrong}` 的地方返回 `{right}`"),
    "branch": Text("do not take the branch for `{wrong}`", "不要进入 `{wrong}` 的分支"),
    "branch always": Text(
        "do always what is done only where `{wrong}` holds", "只在 `{wrong}` 成立时才做的事，总是要做"
    ),
    "own code": Text("In your code this would make it right: {title}.", "在你的代码中，这样改就会正确：{title}。"),
    "own code once": Text(
        "In your code this would make it right in the cases tried so far: {title}.",
        "在你的代码中，这样改后，目前试过的各组数据都会正确：{title}。",
    ),
    "narrow": Text(
        "In special cases it is then still wrong: something else is wrong as well, or your slip is another one."
        " One of them: twistwrench exercises case {case} --seed 0",
        "改后在一些特殊数据中仍然不对：还有别处出错，或者你的错因是另一处。"
        "其中一组：twistwrench exercises case {case} --seed 0",
    ),
    "earthbound": Text(
        "Gravity is 9.81 m/s² in your answer on every planet: `model.gravity` holds that of the robot's own.",
        "你的结果在任何星球上都用 9.81 m/s²；机器人所在星球的重力加速度由 `model.gravity` 给出。",
    ),
    "earthbound too": Text(
        "Besides, gravity is 9.81 m/s² in your answer on every planet: `model.gravity` holds that of the robot's own.",
        "此外，你的结果在任何星球上都用 9.81 m/s²；机器人所在星球的重力加速度由 `model.gravity` 给出。",
    ),
    "earthbound then": Text(
        "On other planets it is then still wrong: gravity is 9.81 m/s² in your answer, whatever `model.gravity` is.",
        "改后在别的星球上仍然不对：无论 `model.gravity` 是多少，你的结果都用 9.81 m/s²。",
    ),
    "whole then": Text(
        "Where arguments are whole numbers it is then still wrong: an array made of them, or after their pattern, holds"
        " whole numbers. Make arrays of floats: `np.array(x, float)`, `np.zeros(3)`.",
        "改后在参数为整数时仍然不对：由整数建立或按其样式建立的数组只能存放整数。"
        "请用浮点数组：`np.array(x, float)`、`np.zeros(3)`。",
    ),
    "earthbound in": Text(
        "In {name} gravity is 9.81 m/s² on every planet: `model.gravity` holds that of the robot's own.",
        "{name} 在任何星球上都用了 9.81 m/s²；机器人所在星球的重力加速度由 `model.gravity` 给出。",
    ),
    "but elsewhere": Text(
        "{found} On other planets it is wrong even then: is gravity taken from `model.gravity`?",
        "{found}在别的星球上即便如此仍然不对：重力加速度取自 `model.gravity` 吗？",
    ),
    "but for": Text(
        "{found} In special cases it is wrong even then, for one where this is put into the arguments of:"
        " twistwrench exercises case {case} --seed 0",
        "{found}在一些特殊数据中即便如此仍然不对，例如把它代入下面这组数据时："
        "twistwrench exercises case {case} --seed 0",
    ),
    "sign of result": Text("change the sign of all that is returned", "改变所有返回值的符号"),
    "halves of result": Text(
        "what is returned, `x`, has its two halves exchanged: `{right}` would be right",
        "返回的 `x` 前后两半互换了，正确的是 `{right}`",
    ),
    "halves of base": Text(
        "what is returned, `x`, has the two halves of its first six entries exchanged: `{right}` would be right",
        "返回的 `x` 前六个分量的前后两半互换了，正确的是 `{right}`",
    ),
    "halves of columns": Text(
        "the columns of what is returned, `x`, have their two halves exchanged: `{right}` would be right",
        "返回的 `x` 各列的前后两半互换了，正确的是 `{right}`",
    ),
    "inverse of result": Text(
        "what is returned, `x`, is the inverse of the right answer: `{right}` would be right",
        "返回的 `x` 是正确结果的逆，正确的是 `{right}`",
    ),
    "first six of result": Text(
        "the first six entries of what is returned, `x`, do not belong there: `{right}` would be right",
        "返回的 `x` 不应有前六个分量，正确的是 `{right}`",
    ),
    "in own line": Text("line {line}, {title}", "第 {line} 行，{title}"),
    "mended": Text(
        "With this change, and no other, {what} right in all {all} cases.",
        "只作这一改动，全部 {all} 组数据的{what}就都正确。",
    ),
    "mended each": Text(
        "Each of these changes makes its own result right, in all {all} cases.",
        "其中每处改动都使对应的结果在全部 {all} 组数据中正确。",
    ),
    "mended both": Text(
        "With these changes, and no other, {what} right in all {all} cases.",
        "只作这几处改动，全部 {all} 组数据的{what}就都正确。",
    ),
    "cure": Text("This would make it right: {title}.", "这样改就会正确：{title}。"),
    "cure in": Text("This would make {name} right: {title}.", "这样改，{name} 就会正确：{title}。"),
    "perhaps": Text("Your slip may be another one that has the same effect.", "你的错因也可能是另一处效果相同的错误。"),
    "either": Text("One of these changes would make it right:", "下列改动任取其一，就会正确："),
    "either way": Text(
        "With one of them alone {what} right in all {all} cases.",
        "单独作其中任一改动，全部 {all} 组数据的{what}都正确。",
    ),
    "either once": Text("With one of them alone {what} right.", "单独作其中任一改动，{what}就正确。"),
    "either both": Text(
        "With the changes of one of them, and no other, {what} right in all {all} cases.",
        "只作其中任一项的改动，全部 {all} 组数据的{what}就都正确。",
    ),
    "mended both once": Text("With these changes, and no other, {what} right.", "只作这几处改动，{what}就正确了。"),
    "mended once": Text("With this change, and no other, {what} right.", "只作这一改动，{what}就正确了。"),
    "numbers are": Text("the numbers are", "数值"),
    "is then": Text("{name} is", " {name} "),
    "both edits": Text("{first}; and {second}", "{first}；并且{second}"),
    "twice": Text("{title}, in two places", "{title}（两处都是）"),
    "both places": Text("{title}, in `{first}` and in `{second}`", "{title}（在 `{first}` 和 `{second}` 中）"),
    "one place": Text("{title}, in one of its places there", "{title}（该行中改一处即可）"),
    "in place": Text("{title}, in `{around}`", "{title}（在 `{around}` 中）"),
    "everywhere": Text("{title}, wherever it stands", "{title}（每一处都是）"),
}
"""A part of the phrases that messages are made of."""
