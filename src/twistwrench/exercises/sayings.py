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
    "argument itself": Text("the argument `{name}`", "参数 `{name}`"),
    "asked elsewhere": Text(
        "the {name} that the function `{function}` of exercise {id} returns",
        "练习 {id} 的函数 `{function}` 返回的 {name}",
    ),
    # what cannot be compared
    "nan expected": Text("a number, where nan is expected", "给出了一个数，而应为 nan"),
    "nothing": Text("nothing", "无"),
    "error differs": Text("{got}, and {right} is expected", "{got}，应为 {right}"),
    "no number": Text("not a finite number", "不是有限的数"),
}
"""A part of the phrases that messages are made of."""
