"""Sentences of a change that makes a student's function right."""

from .text import Text

__all__ = ["MENDINGS"]

MENDINGS = {
    # what would make the student's own line right
    "repair sign": Text("the sign of `{wrong}` is wrong", "`{wrong}` 的符号错了"),
    "repair left out": Text("`{wrong}` does not belong there", "不应有 `{wrong}`"),
    "repair after loop": Text(
        "`{wrong}` must stand after the loop, not in it", "`{wrong}` 应放在循环之后，而不是循环内"
    ),
    "repair in loop": Text(
        "`{wrong}` must be made anew in each round, at the beginning of the loop",
        "`{wrong}` 每一轮都要在循环开头重新执行",
    ),
    "repair summed": Text(
        "`{wrong}` must be added up: += in place of =, from zero before the loop",
        "`{wrong}` 应当累加：用 += 而不是 =，循环前从零开始",
    ),
    "repair carried": Text(
        "`{wrong}` starts from the same `{right}` in each round: what the round before has computed must be carried on",
        "`{wrong}` 每一轮都从同一个 `{right}` 开始：应接着用上一轮算出的结果",
    ),
    "repair last": Text("`{wrong}` must not be a sum", "`{wrong}` 不应求和"),
    "repair transposed": Text("`{wrong}` must be `{right}`", "`{wrong}` 应为 `{right}`"),
    "repair exchanged": Text("`{wrong}` must be `{right}`", "`{wrong}` 应为 `{right}`"),
    "repair halves": Text("`{wrong}` and `{right}` are exchanged", "`{wrong}` 与 `{right}` 互换了"),
    "repair name": Text("`{wrong}` must be `{right}`", "`{wrong}` 应为 `{right}`"),
    "repair instead": Text("`{wrong}` must be `{right}`", "`{wrong}` 应为 `{right}`"),
    "repair inserted": Text("`{wrong}` must be `{right}`", "`{wrong}` 应为 `{right}`"),
    "repair index": Text("`{wrong}` must be `{right}`", "`{wrong}` 应为 `{right}`"),
    "repair number": Text("`{wrong}` must be `{right}`", "`{wrong}` 应为 `{right}`"),
    "must be zero": Text("`{name}` must be zero in `{around}`", "`{around}` 中的 `{name}` 应为零"),
    "repair missing": Text("`{right}` is missing after `{wrong}`", "`{wrong}` 之后缺少 `{right}`"),
    "repair argument": Text(
        "with `{right}` in place of the argument `{wrong}` the function is right",
        "把参数 `{wrong}` 换成 `{right}`，函数就正确了",
    ),
    "repair result": Text("return `{right}` where `{wrong}` is returned", "在返回 `{wrong}` 的地方返回 `{right}`"),
    "branch": Text("the branch for `{wrong}` must not be taken", "不应进入 `{wrong}` 的分支"),
    "branch always": Text(
        "what is done only where `{wrong}` holds must be done always", "只在 `{wrong}` 成立时才做的事应当总是做"
    ),
    "own code": Text("In your code this would make it right: {title}.", "在你的代码中，这样改就会正确：{title}。"),
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
        "With this change, and no other, it is right in all {all} cases.", "只作这一改动，全部 {all} 组数据就都正确。"
    ),
    "mended each": Text(
        "Each of these changes makes its own result right, in all {all} cases.",
        "其中每处改动都使对应的结果在全部 {all} 组数据中正确。",
    ),
    "mended both": Text(
        "With both changes, and no other, it is right in all {all} cases.",
        "只作这两处改动，全部 {all} 组数据就都正确。",
    ),
    "cure": Text("This would make it right: {title}.", "这样改就会正确：{title}。"),
    "cure in": Text("This would make {name} right: {title}.", "这样改，{name} 就会正确：{title}。"),
    "perhaps": Text("Your slip may be another one that has the same effect.", "你的错因也可能是另一处效果相同的错误。"),
    "either": Text("One of these changes would make it right:", "下列改动任取其一，就会正确："),
    "either way": Text(
        "With one of them alone it is right in all {all} cases.", "单独作其中任一改动，全部 {all} 组数据都正确。"
    ),
    "either once": Text("With one of them alone it is right.", "单独作其中任一改动就正确。"),
    "either both": Text(
        "With both changes of one of them, and no other, it is right in all {all} cases.",
        "只作其中任一项的两处改动，全部 {all} 组数据就都正确。",
    ),
    "not all": Text("Something else is wrong as well.", "还有别处也错了。"),
    "mended once": Text("With this change, and no other, it is right.", "只作这一改动，就正确了。"),
    "both edits": Text("{first}; and {second}", "{first}；并且{second}"),
    "twice": Text("{title}, in two places", "{title}（两处都是）"),
    "both places": Text("{title}, in `{first}` and in `{second}`", "{title}（在 `{first}` 和 `{second}` 中）"),
    "in place": Text("{title}, in `{around}`", "{title}（在 `{around}` 中）"),
    "everywhere": Text("{title}, wherever it stands", "{title}（每一处都是）"),
}
"""A part of the phrases that messages are made of."""
