"""The sentences that a message is made of."""

from __future__ import annotations

from .text import Text

__all__ = ["MESSAGES", "message"]

MESSAGES = {
    "head": Text("{id}  {name}: not yet right.", "{id}  {name}：还不对。"),
    "cases": Text("Wrong in {wrong} of {all} cases.", "{all} 组数据中错了 {wrong} 组。"),
    "where": Text(
        "Read {section}; ask for a hint: {command} hint {id}",
        "参阅{section}；需要提示：{command} hint {id}",
    ),
    "project": Text("the project at the end of the chapter", "章末的累积项目"),
    # what explains it: a slip, an edit of the student's code, an edit of a right solution
    "slip": Text("Your numbers fit this slip: {title}. {why}", "你的数值等于犯下这个错误的结果：{title}。{why}"),
    "slips": Text("Your numbers fit any of these slips:", "你的数值等于犯下以下任一错误的结果："),
    "one of the slips": Text("  - {title}. {why}", "  - {title}。{why}"),
    "own": Text("Line {line}: with {edit}, it is right{cases}.", "第 {line} 行：{edit}，{cases}就正确。"),
    "own one": Text("  - line {line}: {edit}", "  - 第 {line} 行：{edit}"),
    "own any": Text("Each of these changes alone makes it right{cases}:", "下列改动任取其一，{cases}就正确："),
    "own both": Text(
        "Two changes together make it right{cases}: line {a}, {first}; line {b}, {second}.",
        "同时作两处改动，{cases}就正确：第 {a} 行，{first}；第 {b} 行，{second}。",
    ),
    "own of slip": Text("Line {line}: {edit}.", "第 {line} 行：{edit}。"),
    "reference": Text(
        "Your numbers are those of a right solution that has {edit}. Look for what does the same in your code.",
        "你的数值等于把正确解法如此改动的结果：{edit}。请在自己的代码中找出效果相同的地方。",
    ),
    "in result": Text("In {name}: {finding}", "在 {name} 中：{finding}"),
    "slip of result": Text("{title}. {why}", "{title}。{why}"),
    "own of result": Text("line {line}, {edit} makes it right.", "第 {line} 行，{edit}，就正确。"),
    "reference of result": Text("that of a right solution that has {edit}.", "等于把正确解法如此改动的结果：{edit}。"),
    "exchanged": Text(
        "{first} and {second} are exchanged: return them in the other order.",
        "{first} 与 {second} 互换了：请按另一种顺序返回。",
    ),
    "edit replace": Text("`{after}` in place of `{before}`", "用 `{after}` 代替 `{before}`"),
    "edit replace all": Text(
        "`{after}` in place of `{before}`, in {n} places", "用 `{after}` 代替 `{before}`（共 {n} 处）"
    ),
    "edit in loop": Text("`{before}` in the loop, not before it", "把 `{before}` 放进循环之内"),
    "edit after loop": Text("`{before}` after the loop, not in it", "把 `{before}` 放到循环之后"),
    "edit sum": Text("`{before}` added up in the loop, from zero", "在循环中从零开始累加 `{before}`"),
    "edit separate": Text("an array for each name in `{before}`", "`{before}` 中每个名字各建一个数组"),
    "edit drop": Text("`{before}` left out", "去掉 `{before}`"),
    "in all": Text(" in all {n} cases", "全部 {n} 组数据"),
    "in one": Text("", ""),
    # what shows before any number is compared
    "none": Text("It returned None. Is the `return` missing?", "返回了 None。是不是漏了 `return`？"),
    "none sometimes": Text(
        "In some cases it returned None: a way through the function that ends without `return`?",
        "在某些情形中返回了 None：函数中是不是有的路径没有 `return`？",
    ),
    "count": Text(
        "It must return {n} things, in this order: {names}. It returned {got}.",
        "应按顺序返回 {n} 个量：{names}。实际返回 {got}。",
    ),
    "type": Text("{name} must be {what}, not {got}.", "{name} 应为{what}，而不是 {got}。"),
    "numbers": Text("numbers", "数值"),
    "truths": Text("True or False", "True 或 False"),
    "string": Text("a string", "字符串"),
    "shape": Text("{name} has the shape {got}; it must be {expected}.", "{name} 的形状是 {got}，应为 {expected}。"),
    "not finite": Text("{name} has entries that are not finite numbers.", "{name} 含有不是有限数的元素。"),
    "fixed size": Text(
        "{name} has the shape {shape} in all cases: the sizes of one of them are written into the function.",
        "在所有情形中 {name} 的形状都是 {shape}：函数里写死了其中一种尺寸。",
    ),
    "cut off": Text(
        "{name} has lost the digits after the point: it is written into an array of whole numbers."
        " Make that array of floats, as `np.zeros(n)` is.",
        "{name} 的小数部分丢失了：它被写进了整数数组。请用浮点数组，例如 `np.zeros(n)`。",
    ),
    "single precision": Text(
        "It is right to about 7 digits only: that is single precision, `float32`.",
        "只有约 7 位正确：这是单精度 `float32`。",
    ),
    # where it goes wrong
    "first line": Text(
        "Look at line {line}, `{text}`: what it uses occurs in a right solution, what it computes does not.",
        "请看第 {line} 行 `{text}`：它用到的值在正确解法中都有，它算出的值却没有。",
    ),
    "missing term": Text(
        "Look at line {line}: with {op} `{term}`, `{text}` would be a value of a right solution.",
        "请看第 {line} 行：`{text}` 再加上 {op} `{term}`，就是正确解法中的一个值。",
    ),
    "broken": Text(
        "This holds for every right answer, but not for yours: {text}", "正确答案都满足而你的不满足：{text}"
    ),
    # how a result differs
    "is": Text("{what}: {relation}", "{what}：{relation}"),
    "block": Text("{name}, {block}", "{name}，{block}"),
    "rest right": Text("the rest of {name} is right", "{name} 的其余部分正确"),
    "is zero": Text("zero, and must not be", "为零，不应为零"),
    "must be zero": Text("must be zero", "应为零"),
    "nan expected": Text("a number, where nan is expected", "给出了一个数，而应为 nan"),
    "sign": Text("the sign is wrong", "符号相反"),
    "signs": Text("the right numbers, some with the wrong sign", "数值正确，部分符号错误"),
    "transposed": Text("transposed", "被转置"),
    "transposed and sign": Text("transposed, and the sign is wrong", "被转置且符号相反"),
    "too large": Text("too large by a factor of {factor:.4g}", "是正确值的 {factor:.4g} 倍"),
    "too small": Text("too small by a factor of {factor:.4g}", "只有正确值的 1/{factor:.4g}"),
    "too large and sign": Text(
        "too large by a factor of {factor:.4g}, and of the other sign", "是正确值的 {factor:.4g} 倍，且符号相反"
    ),
    "too small and sign": Text(
        "too small by a factor of {factor:.4g}, and of the other sign", "只有正确值的 1/{factor:.4g}，且符号相反"
    ),
    "permuted": Text("the right numbers, in the wrong places", "数值正确，位置不对"),
    "diagonal only": Text("only the diagonal is right", "只有对角线正确"),
    "upper only": Text("only the upper triangle is right", "只有上三角正确"),
    "lower only": Text("only the lower triangle is right", "只有下三角正确"),
    "digits": Text("right to {n} digits only", "只有 {n} 位正确"),
    "entries": Text("wrong in {where}, right elsewhere", "错在 {where}，其余正确"),
    "some": Text("{wrong} of {all} numbers are wrong", "{all} 个数中有 {wrong} 个错误"),
    "different": Text("different numbers", "数值不同"),
    "truth": Text("is {got}, and must be {right}", "是 {got}，应为 {right}"),
    "error differs": Text("{got}, and {right} is expected", "{got}，应为 {right}"),
    "text differs": Text("{got}, where a different text is expected", "得到 {got}，应为另一段文字"),
    # what the judge and the folder say
    "stopped": Text(
        "It stopped with {error}",
        "运行出错：{error}",
    ),
    "at line": Text(
        "in {file}, line {line}:",
        "位于 {file} 第 {line} 行：",
    ),
    "changed": Text(
        "It changes its argument `{name}`. Work on a copy: the caller still needs it.",
        "它修改了参数 `{name}`。请在副本上运算，调用者还要用它。",
    ),
    "changed term": Text(
        "A sum or a difference changes one of its two terms, which is still needed. Make a new object with"
        " a new array: `a + b` is one; `a += b` changes the array of `a`, and `c = a` is only another name for it.",
        "求和或求差时改变了其中一个操作数，而它之后还要用。请新建一个对象和它的数组：`a + b` 会新建数组，`a"
        " += b` 改变的是 `a` 的数组，而 `c = a` 只是同一个对象的另一个名称。",
    ),
    "kept": Text(
        "Called again with the same arguments, it returns something else: it keeps something from one call"
        " to the next. What a call changes must be made in it; a default like `out=[]` is made only once,"
        " for all calls.",
        "用相同的参数再调用一次，返回的却不一样：它把某些内容从一次调用留到了下一次。"
        "会被修改的量要在函数内新建；`out=[]` 这样的默认值只生成一次，所有调用共用。",
    ),
    "kept in": Text(
        "Called for the first time it is right with these arguments, too; after other calls it is not:"
        " `{name}` keeps something from one call to the next. Make it anew in each call; a default like"
        " `out=[]` is made only once.",
        "第一次调用时，用这些参数结果也正确；先调用过别的参数之后就不对了：`{name}`"
        " 把某些内容从一次调用留到了下一次。请在每次调用时重新建立；`out=[]` 这样的默认值只生成一次。",
    ),
    "kept by module": Text(
        "Called for the first time it is right with these arguments, too; after other calls it is not: it"
        " keeps something from one call to the next (a global variable, a default argument, a cache). Make"
        " it anew in each call.",
        "第一次调用时，用这些参数结果也正确；先调用过别的参数之后就不对了："
        "它把某些内容从一次调用留到了下一次（全局变量、参数的默认值或缓存）。请在每次调用时重新建立。",
    ),
    "one array": Text(
        "The numbers are right, but two of the things that it returns are one and the same array: compute each.",
        "数值正确，但它返回的量中有两个是同一个数组：请分别计算。",
    ),
    "one way": Text(
        "The numbers are right, but the two results are the same to the last bit in all cases: compute each"
        " in its own way.",
        "数值正确，但两个结果在所有情形中逐位相同：请分别用各自的方法计算。",
    ),
    "returned before": Text(
        "It returns the same array as in an earlier call, with other arguments: it keeps something from one"
        " call to the next. Make what it returns anew in each call.",
        "参数不同，它返回的却是以前某次调用的同一个数组：它把某些内容从一次调用留到了下一次。返回的量每次都要新建。",
    ),
    "missing": Text(
        "There is no function {name} in {file} any more.",
        "{file} 中已没有函数 {name}。",
    ),
    "not a function": Text(
        "{name} in {file} is not a function any more.",
        "{file} 中的 {name} 已不是函数。",
    ),
    "endless": Text(
        "It did not finish in {seconds} s: a loop that never ends?",
        "{seconds} 秒内没有结束：是不是死循环？",
    ),
    "ended": Text(
        "It ended the whole Python process.",
        "它使整个 Python 进程终止了。",
    ),
    "ended in": Text(
        "{name} does so if it is given the number of a joint or frame that the model does not have: print the number.",
        "把模型中没有的关节或坐标系的编号交给 {name}，它就会这样：请打印这个编号。",
    ),
    "encoding": Text(
        "{file} is not written in UTF-8: save it as UTF-8 in your editor. ({error})",
        "{file} 不是 UTF-8 编码：请在编辑器中另存为 UTF-8。（{error}）",
    ),
    "file": Text(
        "{file} cannot be read: {error}",
        "无法读取 {file}：{error}",
    ),
    "file at line": Text(
        "{file}, line {line} cannot be read: {error}",
        "{file} 第 {line} 行无法读取：{error}",
    ),
    "no file": Text(
        "{file} is not there: `{command} start` brings it back.",
        "缺少 {file}：用 `{command} start` 可重新生成。",
    ),
    "patched": Text(
        "{file} changes `{name}`, which the check needs as it is: give what you write another name.",
        "{file} 改动了 `{name}`，而检查需要它保持原样：请换一个名称。",
    ),
    "needs": Text(
        "It needs the package {name}, which is not installed here; `pip install pin` brings Pinocchio.",
        "需要 {name}，此处没有安装；`pip install pin` 可安装 Pinocchio。",
    ),
    "words missing": Text(
        "The function is right. Now explain it in words: fill in {name}.",
        "函数已正确。请再用文字作答：填写 {name}。",
    ),
    "words short": Text(
        "{name} is very short: a sentence or two, please.",
        "{name} 太短：请写一两句话。",
    ),
    "code": Text(
        "code",
        "编程",
    ),
    "number": Text(
        "number",
        "计算",
    ),
    "explain": Text(
        "explain",
        "解释",
    ),
    "prove": Text(
        "prove",
        "证明",
    ),
}


def message(key: str, **given: object) -> Text:
    """Return a sentence with its braces filled."""
    return MESSAGES[key].fill(**given)
