"""Sentences of what a wrong result is: another quantity, or nothing that can be compared."""

from .text import Text

__all__ = ["SAYINGS"]

SAYINGS = {
    # another quantity in place of the one that is asked for
    "another": Text("What you return is another quantity:", "你返回的是另一个量："),
    "known": Text("your {name}: {title}.", "你的 {name}：{title}。"),
    "turned sign": Text("{title}, with the other sign", "{title}，符号相反"),
    "transposed form": Text("{title}, transposed", "{title}，被转置"),
    "inverse form": Text("the inverse of {title}", "{title} 的逆"),
    "halves form": Text("{title}, its angular and linear halves exchanged", "{title}，其角、线两半互换"),
    "first six form": Text("the first six rows of {title}", "{title} 的前六行"),
    "first three form": Text("the first three rows of {title}", "{title} 的前三行"),
    "next three form": Text("rows 3 to 5 of {title}", "{title} 的第 3 至 5 行"),
    "joints form": Text("the rows from 6 on of {title}", "{title} 从第 6 行起的各行"),
    "first columns form": Text("the first six columns of {title}", "{title} 的前六列"),
    "right one": Text("the right {name}", "正确的 {name}"),
    "right block": Text("the right block", "正确的块"),
    "entries of": Text("the entries {entries} of {title}", "{title} 的元素 {entries}"),
    "argument itself": Text("the argument `{name}`", "参数 `{name}`"),
    "asked elsewhere": Text(
        "the {name} that the function `{function}` of exercise {id} returns",
        "练习 {id} 的函数 `{function}` 返回的 {name}",
    ),
    # what is kept from one call to the next
    "kept in": Text(
        "Called for the first time it is right with these arguments, too; after other calls it is not: `{name}` keeps"
        " something from one call to the next. Make it anew in each call; a default like `out=[]` is made only once.",
        "第一次调用时，用这些参数结果也正确；先调用过别的参数之后就不对了：`{name}` 把某些内容从一次调用留到了下一次。"
        "请在每次调用时重新建立；`out=[]` 这样的默认值只生成一次。",
    ),
    "kept by module": Text(
        "Called for the first time it is right with these arguments, too; after other calls it is not: it keeps"
        " something from one call to the next (a global variable, a default argument, a cache). Make it"
        " anew in each call.",
        "第一次调用时，用这些参数结果也正确；先调用过别的参数之后就不对了：它把某些内容从一次调用留到了下一次"
        "（全局变量、参数的默认值或缓存）。请在每次调用时重新建立。",
    ),
    # a second name for one array
    "second name": Text(
        "The slip: line {line}, `{text}` copies nothing: `{name}` and `{value}` are the same numbers in memory,"
        " and what is written into one of them changes both. Write `{name} = {cure}`.",
        "错因：第 {line} 行，`{text}` 并没有复制：`{name}` 与 `{value}` 是内存中的同一组数，写入其一，二者都变。"
        "请写 `{name} = {cure}`。",
    ),
    "views exchanged": Text(
        "The slip: line {line}, `{text}`: what stands on the right copies nothing, so `{second}` gets what the first"
        " assignment has just written. Write `.copy()` after both.",
        "错因：第 {line} 行，`{text}` 的右边并没有复制，所以 `{second}` 得到的是前一个赋值刚刚写入的内容。"
        "请在右边两项后都加上 `.copy()`。",
    ),
    "same appended": Text(
        "The slip: line {line}, `{text}` puts the same array into the list each time, and what is written into it later"
        " changes all entries. Append `{name}.copy()`, or make a new array in each round.",
        "错因：第 {line} 行，`{text}` 每次放进列表的都是同一个数组，之后写入它的内容会改变所有元素。"
        "请 append `{name}.copy()`，或每一轮新建一个数组。",
    ),
    "many names": Text(
        "The slip: line {line}, `{text}` makes one array, which has several names or stands in several places: what is"
        " written into one of them, or added to it, is in all. Make an array for each.",
        "错因：第 {line} 行，`{text}` 只建立了一个数组，却有几个名字或出现在几处：在一处写入或加上的，处处都有。"
        "请各建一个数组。",
    ),
    # what is not what is asked for, though the numbers are right
    "one way": Text(
        "The numbers are right, but the two results are the same to the last bit in all cases: compute each in its own"
        " way.",
        "数值正确，但两个结果在所有情形中逐位相同：请分别用各自的方法计算。",
    ),
    "patched": Text(
        "{file} changes `{name}`, which the check needs as it is: give what you write another name.",
        "{file} 改动了 `{name}`，而检查需要它保持原样：请换一个名称。",
    ),
    # what cannot be compared
    "none in some": Text(
        "In some cases it returned None: a way through the function that ends without `return`?",
        "在某些情形中返回了 None：函数中是不是有的路径没有 `return`？",
    ),
    "nan expected": Text("a number, where nan is expected", "给出了一个数，而应为 nan"),
    "nan lost": Text(
        "{name} is a number in a case where nan is expected: an entry that is nan is passed over.",
        "有的情形中 {name} 应为 nan，却给出了一个数：漏掉了为 nan 的元素。",
    ),
    "nothing": Text("nothing", "无"),
    "error differs": Text("{got}, and {right} is expected", "{got}，应为 {right}"),
    "no number": Text("not a finite number", "不是有限的数"),
    # what only the numbers show
    "opposite factor": Text(
        "too large by a factor of {factor:.4g}, and of the other sign", "是正确值的 {factor:.4g} 倍，且符号相反"
    ),
    "opposite divisor": Text(
        "too small by a factor of {factor:.4g}, and of the other sign", "只有正确值的 1/{factor:.4g}，且符号相反"
    ),
    "rows exchanged": Text("rows {first} and {second} are exchanged", "第 {first} 行与第 {second} 行互换了"),
    "columns exchanged": Text("columns {first} and {second} are exchanged", "第 {first} 列与第 {second} 列互换了"),
    "entries exchanged": Text("the entries {first} and {second} are exchanged", "元素 {first} 与 {second} 互换了"),
    "finer": Text(
        "With {finer} in place of {given} in line {line} the error is {factor:.0f} times smaller: what is computed is"
        " an approximation, and the exact value is asked for.",
        "把第 {line} 行的 {given} 换成 {finer}，误差缩小到 1/{factor:.0f}：算出的是近似值，而题目要求精确值。",
    ),
    "when small": Text(
        "In {name} terms up to order {power} in {what} are right, those of order {next} are not:"
        " made half as large, {what} leaves an error {times} times smaller.",
        "{name} 中关于 {what} 的项到 {power} 阶为止正确，{next} 阶项有错：把 {what} 减半，误差缩小到原来的 1/{times}。",
    ),
    "branch otherwise": Text(
        "do in all other cases what is done where `{wrong}` holds",
        "把 `{wrong}` 成立时所做的，改在其余所有情形中做",
    ),
    "the same": Text("It is the same as your {other}, and must not be.", "它与你的 {other} 相同，而二者不应相同。"),
    # two slips at once
    "two slips": Text(
        "Two slips at once would give just these numbers: {first}; and {second}.",
        "你的数值等于同时犯下两处错误的结果：{first}；并且 {second}。",
    ),
    "two changes": Text(
        "Perhaps two slips at once. One of them: {first}. With this change your numbers are those of the other:"
        " {second}.",
        "可能同时有两处错误。其一：{first}。作此改动之后，数值等于犯下另一个错误的结果：{second}。",
    ),
}
"""A part of the phrases that messages are made of."""
